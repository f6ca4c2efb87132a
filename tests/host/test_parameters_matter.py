# SPDX-License-Identifier: GPL-3.0-or-later
"""Every parameter of every filter changes what the filter makes: none is read and then forgotten."""
import functools
import pathlib
import tempfile

import pytest

from cases import FILTERS, STAGES

pymeshlab = pytest.importorskip('pymeshlab')
pytest.importorskip('pymeshlab_dcharts')

# parameter -> (another value than its default, what is given beside it both times)
PAPER, BY_REGION = {'material': 'Paper'}, {'merge_by': 'Boundary Region'}
BY_ERROR = {'dart_by': 'Fitting Error', 'max_stretch': 0.0}
OTHER = {
    'chart_count': (40, {}),
    'max_fitting_error': (0.02, {}),
    'fitting_weight': (9.0, {}),
    'compactness_weight': (0.0, {}),
    'straightness_weight': (0.0, {}),
    'max_iterations': (1, {}),
    'reassigned_percent': (100.0, {}),
    'seed_candidates': (500, {}),
    'seed_percent': (100.0, {}),
    'small_hole_percent': (100.0, {}),
    'keep_seams': (True, {}),
    'crease_angle': (20.0, {}),
    'selected_only': (True, {}),
    'target_charts': (30, {}),
    'max_stretch': (1.3, {}),
    'straighten_by': ('Shortest Path', {}),
    'merge_by': ('Boundary Region', {}),
    'seam_weight': (0.0, {'max_stretch': 0.0}),
    'merge_threshold': (0.0, BY_REGION),
    'dart_by': ('Fitting Error', {'max_stretch': 0.0}),
    'dart_fitting_error': (0.01, BY_ERROR),
    'max_dart_percent': (0.0, BY_ERROR),
    'cut_to_disk': (True, {}),
    'seam_layer': (True, {}),
    'method': ('Conformal (ABF++)', {}),
    'texture_size': (128, {}),
    'padding': (9, {}),
    'rotate': (False, {}),
    'density_by': ('Vertex Quality', {}),
    'material': ('Paper', {}),
    'units': ('inch', {'size': 30.0, 'seam_allowance': 1.0}),
    'size': (500.0, {}),
    'seam_allowance': (3.0, {}),
    'tab_width': (2.0, PAPER),
    'simplify_tolerance': (5.0, {}),
    'fold_angle': (100.0, PAPER),
    'merge_congruent': (True, {}),
    'print_texture': (True, {}),
    'page': ('A4', {}),
    'oversize': ('Split Piece', {'page': 'A4'}),
}
# the same, where a filter needs something else
OTHER_OF_FILTER = {
    ('dcharts_cut', 'target_charts'): (30, {'max_dart_percent': 0.0}),  # charts above max_stretch are parted or not
    ('dcharts_straighten', 'max_fitting_error'): (0.02, {'straighten_by': 'Shortest Path'}),
}
# By default the model ends as three charts, whatever it begins with.
OTHER_OF_FILTER |= {('dcharts_texture_atlas', name): (OTHER[name][0], {'max_stretch': 1.002})
                    for name in ('max_fitting_error', 'straighten_by')}
OTHER_OF_FILTER[('dcharts_texture_atlas', 'small_hole_percent')] = (100.0, {'max_stretch': 1.002, 'max_fitting_error': 0.02})
FROM_THE_START = ('dcharts_segment', 'dcharts_texture_atlas', 'dcharts_pattern')


@functools.cache
def model(around):
    """A wavy torus, a cube and a flat ring, which between them have something for every parameter to change."""
    ms = pymeshlab.MeshSet()
    ms.create_torus(hradius=3, vradius=1, hsubdiv=around, vsubdiv=around // 2)
    ms.compute_coord_by_function(x='x', y='y', z='z * (1 + 0.5 * sin(2 * x))', onselected=False)
    for make in (lambda: ms.create_cube(size=2), lambda: ms.create_annulus(internalradius=1, externalradius=2, sides=16)):
        make()
        ms.compute_coord_by_function(x=f'x + {5 * ms.mesh_number()}', y='y', z='z', onselected=False)
    ms.generate_by_merging_visible_meshes()
    ms.compute_scalar_by_function_per_vertex(q='1 + (x > 0)')
    ms.compute_color_by_function_per_vertex(x='127 + 100 * sin(x)', y='127', z='17', a='255')
    ms.compute_selection_by_condition_per_face(condselect='x0 > 0')
    ms.compute_scalar_by_function_per_face(q='(x0 > 0) + 2 * (z0 > 0)')
    ms.dcharts_parameterize()  # texcoords with seams, for keep_seams
    return ms


def prepared(name):
    """The model, with what the stages before have made of it."""
    ms = pymeshlab.MeshSet()
    ms.add_mesh(model(20 if name == 'dcharts_pattern' else 28).current_mesh())
    if name in FROM_THE_START:
        return ms
    ms.dcharts_segment(chart_count=20, max_fitting_error=0.02)  # with holes
    for stage in STAGES[1:STAGES.index(name)]:
        ms.apply_filter(stage, **({'max_stretch': 0.0, 'max_dart_percent': 0.0} if stage == 'dcharts_cut' else {}))
        if stage == 'dcharts_merge':  # one chart for each component, which is much too curved
            ms.compute_scalar_by_function_per_face(q='0')
    return ms


@functools.cache
def made(name, ending, parameters):
    """All that the filter makes, as something to compare."""
    ms, parameters = prepared(name), dict(parameters)
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / f'pattern.{ending}'
        if name == 'dcharts_pattern':
            parameters = {'size': 1000.0, 'output_file': str(file), **parameters}
        figures = ms.apply_filter(name, **parameters)
        written = file.read_bytes() if file.exists() else b''
    mesh, last = ms.mesh(0), ms.mesh(ms.mesh_number() - 1)
    return (sorted((figure, value) for figure, value in figures.items() if not figure.startswith('seconds')),
            mesh.has_face_scalar() and mesh.face_scalar_array().tobytes(),
            mesh.has_wedge_tex_coord() and mesh.wedge_tex_coord_matrix().tobytes(), ms.mesh_number(),
            last.vertex_matrix().tobytes(), written)


# Of Segment, max_stretch only tells which of two segmentations is taken: no mesh is known where that matters.
@pytest.mark.parametrize('name, parameter', [(name, parameter) for name, parameters in FILTERS.values()
                                             for parameter in parameters
                                             if parameter != 'output_file' and (name, parameter) != ('dcharts_segment', 'max_stretch')])
def test_it_changes_what_is_made(name, parameter):
    value, beside = OTHER_OF_FILTER.get((name, parameter), OTHER[parameter])
    beside = {key: given for key, given in beside.items() if key in dict(FILTERS.values())[name]}
    ending = 'pdf' if parameter in ('page', 'oversize', 'print_texture') else 'dxf'  # a DXF takes less time
    results = [made(name, ending, tuple(sorted(parameters.items()))) for parameters in (beside, {**beside, parameter: value})]
    assert results[0] != results[1]
