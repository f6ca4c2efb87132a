# SPDX-License-Identifier: GPL-3.0-or-later
"""The plugin in pymeshlab, by way of the package pymeshlab_dcharts."""
import subprocess
import sys

import numpy as np
import pytest

from atlas_check import EVALUATOR, SHARED, evaluate, flaws
from cases import (BOOLEANS, CHOICES, EXAMPLES, FILES, FILTERS, OUT_OF_RANGE, PYTHON_NAMES, REFUSED_MESHES, STAGES, is_sentence,
                   shipped_meshes)
from loading import load
from mlx import read_script
from paint import paint

pymeshlab = pytest.importorskip('pymeshlab')
pytest.importorskip('pymeshlab_dcharts', reason='the package pymeshlab_dcharts is not installed')

MESHES = shipped_meshes()
MissingComponent = pymeshlab.pmeshlab.MissingComponentException
BY_PYTHON_NAME = {python: parameters for python, parameters in FILTERS.values()}
ATLAS = 'dcharts_texture_atlas'


def state(ms):
    """The bytes of everything Python can see of the current mesh, and the number of layers."""
    mesh = ms.current_mesh()
    seen = {'layers': ms.mesh_number(), 'current': ms.current_mesh_id(), 'name': mesh.label(),
            'textures': sorted(mesh.textures())}
    for part in ('vertex_matrix', 'face_matrix', 'vertex_normal_matrix', 'face_normal_matrix', 'vertex_color_matrix',
                 'vertex_scalar_array', 'vertex_selection_array', 'face_selection_array', 'face_scalar_array',
                 'face_color_matrix', 'wedge_tex_coord_matrix', 'transform_matrix'):
        try:
            seen[part] = getattr(mesh, part)().tobytes()
        except MissingComponent:
            seen[part] = None  # the mesh has no such thing
    try:
        seen['seams'] = mesh.face_custom_scalar_attribute_array('dcharts_seams').tobytes()
    except pymeshlab.PyMeshLabException:
        seen['seams'] = None
    return seen


def result(ms):
    """What the filters are for: chart ids, colours and texcoords."""
    seen = state(ms)
    return {part: seen[part] for part in ('face_scalar_array', 'face_color_matrix', 'wedge_tex_coord_matrix')}


@pytest.fixture
def painted(plush):
    """The plush model with quality, colour, texcoords and selection that no filter would write."""
    ms = load(plush)
    paint(ms)
    ms.compute_selection_by_condition_per_face(condselect='sin(fi) > 0.3')
    ms.current_mesh().add_face_custom_scalar_attribute(np.arange(ms.current_mesh().face_number()) % 8.0, 'dcharts_seams')
    assert None not in state(ms).values()
    return ms


@pytest.mark.parametrize('name', PYTHON_NAMES)
def test_filter_exists(name):
    assert name in pymeshlab.filter_list()
    documentation = getattr(pymeshlab.MeshSet, name).__doc__
    assert is_sentence(documentation.split('\n\n')[0])
    for parameter in BY_PYTHON_NAME[name]:
        assert parameter in documentation, f'{parameter} is not in the documentation of {name}'


@pytest.mark.parametrize('name', PYTHON_NAMES)
def test_parameters(name):
    ms = load(MESHES[0])
    assert sorted(ms.filter_parameter_values(name)) == sorted(BY_PYTHON_NAME[name])


def test_every_number_has_bad_values():
    for parameters in BY_PYTHON_NAME.values():
        assert set(parameters) <= set(OUT_OF_RANGE) | set(BOOLEANS) | set(CHOICES) | set(FILES)


@pytest.mark.parametrize('mesh', MESHES, ids=lambda path: path.stem)
def test_stages_are_the_one_shot_filter(mesh, tmp_path):
    once, staged, resumed = load(mesh), load(mesh), load(mesh)
    once.apply_filter(ATLAS)
    for i, name in enumerate(STAGES):
        staged.apply_filter(name)
        resumed.apply_filter(name)
        saved = tmp_path / f'after_{name}.ply'
        resumed.save_current_mesh(str(saved))
        resumed = load(saved)
        if name in ('dcharts_fill', 'dcharts_merge'):
            assert (staged.current_mesh().face_scalar_array() >= 0).all(), f'unassigned faces after {name}'
    assert result(staged) == result(once)
    assert resumed.current_mesh().face_scalar_array().tobytes() == once.current_mesh().face_scalar_array().tobytes()
    assert result(resumed)['wedge_tex_coord_matrix'] == result(once)['wedge_tex_coord_matrix']


@pytest.mark.parametrize('name', ('gargoyle', 'fandisk_9926'))
def test_stages_of_models_are_the_one_shot_filter(model_file, name):
    """Whatever the one-shot filter knows from one stage in the next (gargoyle has a chart whose quick map is above its bound)."""
    once, staged = load(model_file(name)), load(model_file(name))
    seeds = {'chart_count': 12}
    once.apply_filter(ATLAS, **seeds)
    for stage in STAGES:
        staged.apply_filter(stage, **(seeds if stage == STAGES[0] else {}))
    assert result(staged) == result(once)


@pytest.mark.parametrize('mesh', MESHES, ids=lambda path: path.stem)
def test_result(mesh):
    ms = load(mesh)
    before = state(ms)
    figures = ms.apply_filter(ATLAS)
    after = state(ms)
    for part in ('layers', 'current', 'name', 'vertex_matrix', 'face_matrix', 'vertex_normal_matrix',
                 'vertex_color_matrix', 'vertex_scalar_array', 'vertex_selection_array', 'face_selection_array'):
        assert after[part] == before[part], f'{part} changed'
    charts = ms.current_mesh().face_scalar_array()
    texcoords = ms.current_mesh().wedge_tex_coord_matrix()
    assert np.array_equal(np.unique(charts), np.arange(figures['charts'])), 'chart ids are not 0..n-1'
    assert np.isfinite(texcoords).all() and texcoords.min() >= 0 and texcoords.max() <= 1
    assert figures['flipped_faces'] == 0 and figures['overlapping_faces'] == 0
    assert figures['unassigned_faces'] == 0
    assert 1 - 1e-9 <= figures['l2_stretch'] <= figures['linf_stretch'] < np.inf
    assert 0 <= figures['l2_shear'] < 1 and 0 < figures['packing_efficiency'] <= 1 and figures['seam_length'] >= 0
    assert figures['seconds'] >= 0


@pytest.mark.parametrize('mesh', MESHES, ids=lambda path: path.stem)
def test_measure_agrees_and_changes_nothing(mesh):
    ms = load(mesh)
    figures = ms.apply_filter(ATLAS)
    before = state(ms)
    measured = ms.dcharts_measure()
    assert state(ms) == before
    assert measured['charts'] == figures['charts']
    for name in ('l2_stretch', 'linf_stretch', 'l2_shear', 'seam_length', 'packing_efficiency'):
        assert measured[name] == pytest.approx(figures[name], rel=1e-5, abs=1e-7), name


def atlas_meshes():
    return MESHES + (sorted((SHARED / 'meshes').glob('*.ply')) if SHARED.exists() else [])


@pytest.mark.parametrize('mesh', atlas_meshes(), ids=lambda path: f'{path.parent.parent.name}-{path.stem}')
def test_atlas_is_sound(mesh, tmp_path):
    if not EVALUATOR.exists():
        pytest.skip('the evaluator, ../shared/tools/evaluate_atlas.py, is not beside this checkout')
    ms = load(mesh)
    figures = ms.apply_filter(ATLAS)
    atlas = tmp_path / 'atlas.ply'
    ms.save_current_mesh(str(atlas))
    outside = evaluate(atlas, mesh)
    assert flaws(outside) == []
    assert outside['charts'] == figures['charts']
    assert outside['L2_stretch'] == pytest.approx(figures['l2_stretch'], rel=1e-4)


def test_same_bytes_again(plush):
    first, second = load(plush), load(plush)
    first.apply_filter(ATLAS)
    second.apply_filter(ATLAS)
    assert result(first) == result(second)


def test_seam_layer_is_one_more_layer(plush):
    plain, ms = load(plush), load(plush)
    plain.apply_filter(ATLAS)
    ms.apply_filter(ATLAS, seam_layer=True)
    assert result(ms) == result(plain)
    assert ms.mesh_number() == 2 and ms.current_mesh_id() == plain.current_mesh_id()
    seams = ms.mesh(1)
    assert seams.edge_number() > 0 and seams.face_number() == 0


# --- wrong input

KEPT_ALIVE = []  # after apply_filter failed, pymeshlab itself still uses the MeshSet's log: see pymeshlab_dcharts/_load.py


def refusal(ms, name, **parameters):
    """The sentence with which the filter refuses; the mesh must be what it was."""
    KEPT_ALIVE.append(ms)
    before = state(ms)
    with pytest.raises(pymeshlab.PyMeshLabException) as refused:
        ms.apply_filter(name, **parameters)
    assert state(ms) == before, 'the mesh changed'
    assert is_sentence(str(refused.value)), str(refused.value)
    return str(refused.value)


@pytest.mark.parametrize('name', PYTHON_NAMES)
def test_no_mesh(name):
    with pytest.raises(pymeshlab.PyMeshLabException) as refused:  # pymeshlab's own sentence
        pymeshlab.MeshSet().apply_filter(name)
    assert is_sentence(str(refused.value))


def refused(kind):
    """A MeshSet with such a mesh."""
    if kind == 'empty mesh':  # pymeshlab loads none: delete all there is
        ms = load(MESHES[0])
        ms.set_selection_all()
        ms.meshing_remove_selected_vertices_and_faces()
        assert ms.current_mesh().vertex_number() == 0
    else:  # not from a file: pymeshlab mends some of these when it loads them
        vertices, faces = REFUSED_MESHES[kind]
        matrices = {'vertex_matrix': np.array([line.split() for line in vertices], float)}
        if faces:
            matrices['face_matrix'] = np.array([line.split()[1:] for line in faces], int)
        ms = pymeshlab.MeshSet()
        ms.add_mesh(pymeshlab.Mesh(**matrices))
    return ms


@pytest.mark.parametrize('name', PYTHON_NAMES)
@pytest.mark.parametrize('kind', REFUSED_MESHES)
def test_refused_mesh(name, kind):
    refusal(refused(kind), name)


# kind of mesh -> the filters that its refusal names, and how Python calls them
CONDITION = 'x * 0 + y * 0 + z * 0 != 0'  # holds for infinite numbers and for those that are none
MENDING = {
    'NaN coordinate': (('Conditional Vertex Selection', 'compute_selection_by_condition_per_vertex', {'condselect': CONDITION}),
                       ('Delete Selected Vertices', 'meshing_remove_selected_vertices', {})),
    'point cloud': (('Surface Reconstruction: Ball Pivoting', 'generate_surface_reconstruction_ball_pivoting', {}),),
    'zero area': (('Remove Zero Area Faces', 'meshing_remove_null_faces', {}),),
}
MENDING['infinite coordinate'] = MENDING['NaN coordinate']


@pytest.mark.parametrize('kind', MENDING)
def test_the_filters_that_a_refusal_names_mend_the_mesh(kind):
    ms = refused(kind)
    sentence = refusal(ms, ATLAS)
    for named, python_name, parameters in MENDING[kind]:
        assert f'"{named}"' in sentence
        ms.apply_filter(python_name, **parameters)
    if kind == 'zero area':
        assert ms.current_mesh().face_number() == 0
    else:
        assert ms.apply_filter(ATLAS)['charts'] > 0


@pytest.mark.parametrize('name, parameter, value',
                         [(name, parameter, value) for name, parameters in BY_PYTHON_NAME.items()
                          for parameter in parameters for value in OUT_OF_RANGE.get(parameter, ())])
def test_out_of_range(painted, name, parameter, value):
    assert parameter in refusal(painted, name, **{parameter: value})


@pytest.mark.parametrize('parameter', [p for p in CHOICES if p in BY_PYTHON_NAME[ATLAS]])
def test_choices(parameter, plush):
    """Each choice has its own result, the first is the default, any other is refused."""
    results = []

    def model():
        ms = load(plush)
        ms.compute_scalar_by_function_per_vertex(q='1 + (x > 0)')  # for density_by
        return ms

    for choice in CHOICES[parameter]:
        ms = model()
        figures = ms.apply_filter(ATLAS, **{parameter: choice})
        assert figures['flipped_faces'] == 0 and figures['overlapping_faces'] == 0
        results.append(result(ms)['wedge_tex_coord_matrix'])
    assert len(set(results)) == len(results)
    ms = model()
    ms.apply_filter(ATLAS)
    assert result(ms)['wedge_tex_coord_matrix'] == results[0]
    for wrong in ('', 'Spectral'):
        with pytest.raises(pymeshlab.pmeshlab.InvalidEnumException):
            load(plush).apply_filter(ATLAS, **{parameter: wrong})


@pytest.mark.parametrize('count', [7, 12])
def test_target_charts(plush, count):
    """Exactly as many charts as asked for, at once and staged."""
    ms, staged = load(plush), load(plush)
    figures = ms.apply_filter(ATLAS, target_charts=count)
    assert figures['charts'] == count and figures['overlapping_faces'] == 0 and figures['flipped_faces'] == 0
    for name in STAGES:
        takes_it = 'target_charts' in BY_PYTHON_NAME[name]
        staged.apply_filter(name, **({'target_charts': count} if takes_it else {}))
    assert result(staged) == result(ms)


def l2_of_charts(mesh):
    """The L2 stretch of each chart, with the chart's area in the texture scaled to its area on the surface."""
    points, uv = mesh.vertex_matrix()[mesh.face_matrix()], mesh.wedge_tex_coord_matrix().reshape(-1, 3, 2)
    charts = mesh.face_scalar_array().astype(int)
    a, b, p, q = uv[:, 1] - uv[:, 0], uv[:, 2] - uv[:, 0], points[:, 1] - points[:, 0], points[:, 2] - points[:, 0]
    twice_uv_area = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
    area = np.linalg.norm(np.cross(p, q), axis=1) / 2
    by_u = (p * b[:, 1:] - q * a[:, 1:]) / twice_uv_area[:, None]
    by_v = (q * a[:, :1] - p * b[:, :1]) / twice_uv_area[:, None]
    stretch = ((by_u**2).sum(axis=1) + (by_v**2).sum(axis=1)) / 2  # the mean of the squared singular values
    chart_area = np.bincount(charts, area)
    return np.sqrt(np.bincount(charts, area * stretch) * np.bincount(charts, twice_uv_area / 2)) / chart_area


@pytest.mark.parametrize('mesh', MESHES, ids=lambda path: path.stem)
@pytest.mark.parametrize('bound', [None, 1.003, 1.1])
def test_max_stretch_bounds_every_chart(mesh, bound):
    ms = load(mesh)
    ms.apply_filter(ATLAS, **({'max_stretch': bound} if bound else {}))
    stretch = l2_of_charts(ms.current_mesh())
    assert (stretch > 1 - 1e-6).all()
    assert stretch.max() <= (bound or 1.01) + 1e-5  # the texture's grid adds a little


def test_graph_cut_makes_shorter_borders(plush):
    """Than no straightening, and than the paper's way, on a model with many charts; the charts stay as many."""
    lengths = {}
    for choice in CHOICES['straighten_by']:
        ms = load(plush)
        ms.dcharts_segment(chart_count=30)
        before = ms.dcharts_fill()
        after = ms.dcharts_straighten(straighten_by=choice)
        assert after['charts'] == before['charts']
        assert after['seam_length'] < 0.9 * before['seam_length']
        lengths[choice] = after['seam_length']
    assert lengths['Graph Cut'] < lengths['Shortest Path']


def test_conformal_keeps_angles(plush):
    """Less shear than the least stretch, by the plugin's own figure; staged and at once the same."""
    shear = {}
    for choice in CHOICES['method']:
        ms = load(plush)
        shear[choice] = ms.dcharts_texture_atlas(method=choice)['l2_shear']
        staged = load(plush)
        for name in STAGES[:-1]:
            staged.apply_filter(name)
        staged.dcharts_parameterize(method=choice)
        assert result(staged) == result(ms)
    assert shear['Conformal (ABF++)'] < shear['Stretch-minimizing']


def test_density_follows_vertex_quality(plush):
    """Texels per length of a chart are in proportion to the mean quality of its vertices; staged and at once the same."""
    ms = load(plush)
    ms.compute_scalar_by_function_per_vertex(q='1 + 3 * (y > 0)')
    quality = ms.current_mesh().vertex_scalar_array()
    assert set(quality) == {1, 4}
    ms.apply_filter(ATLAS, density_by='Vertex Quality')
    staged = load(plush)
    staged.compute_scalar_by_function_per_vertex(q='1 + 3 * (y > 0)')
    for name in STAGES[:-1]:
        staged.apply_filter(name)
    staged.dcharts_parameterize(density_by='Vertex Quality')
    assert result(staged) == result(ms)

    mesh = ms.current_mesh()
    assert np.array_equal(mesh.vertex_scalar_array(), quality)
    faces, charts = mesh.face_matrix(), mesh.face_scalar_array().astype(int)
    points, uv = mesh.vertex_matrix()[faces], mesh.wedge_tex_coord_matrix().reshape(-1, 3, 2)
    area = np.linalg.norm(np.cross(points[:, 1] - points[:, 0], points[:, 2] - points[:, 0]), axis=1) / 2
    a, b = uv[:, 1] - uv[:, 0], uv[:, 2] - uv[:, 0]
    uv_area = (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]) / 2
    chart_area = np.bincount(charts, area)
    density = np.sqrt(np.bincount(charts, uv_area) / chart_area)
    wanted = np.bincount(charts, area * quality[faces].mean(axis=1)) / chart_area
    assert wanted.max() > 1.5 * wanted.min()
    assert np.ptp(density / wanted) < 0.05 * (density / wanted).mean()


@pytest.mark.parametrize('parameter', [p for p, values in OUT_OF_RANGE.items() if isinstance(values[0], float)])
@pytest.mark.parametrize('value', [float('nan'), float('inf')])
def test_not_a_number(painted, parameter, value):
    name = next(name for name, parameters in BY_PYTHON_NAME.items() if parameter in parameters)
    assert parameter in refusal(painted, name, **{parameter: value})


def test_work_goes_on_after_a_refusal(plush):
    """In a process of its own: it would end with a segmentation fault."""
    code = """
import sys, pymeshlab, pymeshlab_dcharts
for i in range(30):
    ms = pymeshlab.MeshSet()
    ms.load_new_mesh(sys.argv[1])
    try:
        ms.dcharts_segment(chart_count=-1)
        sys.exit('not refused')
    except pymeshlab.PyMeshLabException:
        pass
"""
    run = subprocess.run([sys.executable, '-c', code, str(plush)], capture_output=True, text=True, timeout=300)
    assert run.returncode == 0, run.stderr


@pytest.mark.parametrize('script', sorted(path.name for path in EXAMPLES.glob('*.mlx')))
def test_shipped_scripts_run_as_they_are(script, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)  # pattern.mlx writes a file
    mesh, by_name = EXAMPLES.parent / 'meshes' / 'cad_part.ply', tmp_path / 'by_name'
    ms = load(mesh)
    ms.load_filter_script(str(EXAMPLES / script))
    ms.apply_filter_script()
    files = {path.name: path.read_bytes() for path in tmp_path.iterdir()}
    assert list(files) == (['pattern.pdf'] if script == 'pattern.mlx' else [])
    by_name.mkdir()
    monkeypatch.chdir(by_name)
    other = load(mesh)
    for name, values in read_script(EXAMPLES / script):
        other.apply_filter(name, **values)
    assert state(ms) == state(other) and files == {path.name: path.read_bytes() for path in by_name.iterdir()}
