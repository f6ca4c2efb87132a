# SPDX-License-Identifier: GPL-3.0-or-later
"""selected_only in the hosts: all faces but the selected ones stay as they are, byte for byte."""
import numpy as np
import pytest

from cases import EXAMPLES, STAGES
from mlx import write_script

pymeshlab = pytest.importorskip('pymeshlab')
pytest.importorskip('pymeshlab_dcharts')

ATLAS = 'dcharts_texture_atlas'
SELECTION = 'x > 0'


def select(ms, condition=SELECTION):
    ms.compute_selection_by_condition_per_face(condselect=condition.replace('x', '(x0 + x1 + x2)'))


@pytest.fixture
def painted(plush):
    """The plush model with quality, colour and texcoords that no filter would write, half of it selected."""
    ms = pymeshlab.MeshSet()
    ms.load_new_mesh(str(plush))
    ms.compute_texcoord_parametrization_triangle_trivial_per_wedge(sidedim=0)
    ms.compute_scalar_by_function_per_face(q='fi * 0.37 - 5')
    ms.compute_color_by_function_per_face(r='127 + 100 * sin(fi)', g='127 + 100 * cos(fi)', b='17', a='255')
    select(ms)
    return ms


def parts(ms):
    """What may change, one row for each face."""
    mesh = ms.current_mesh()
    uv = mesh.wedge_tex_coord_matrix().reshape(mesh.face_number(), 6)
    return {'quality': mesh.face_scalar_array().copy(), 'colour': mesh.face_color_matrix().copy(), 'texcoords': uv.copy()}


def test_others_stay_byte_for_byte(painted):
    selected = painted.current_mesh().face_selection_array().copy()
    assert 100 < selected.sum() < len(selected) - 100
    before = parts(painted)
    figures = painted.dcharts_texture_atlas(selected_only=True)
    after = parts(painted)
    for name in before:
        assert before[name][~selected].tobytes() == after[name][~selected].tobytes(), name
    ids = after['quality'][selected]
    assert len(set(ids)) == figures['charts']
    assert not set(ids) & set(before['quality'][~selected]), 'a number that another face has'
    assert after['texcoords'][selected].min() >= 0 and after['texcoords'][selected].max() <= 1
    assert figures['flipped_faces'] == figures['overlapping_faces'] == 0
    assert (painted.current_mesh().face_selection_array() == selected).all()


def test_stages_do_the_same(painted):
    selected = painted.current_mesh().face_selection_array().copy()
    before = parts(painted)
    for stage in STAGES:
        getattr(painted, stage)(selected_only=True)
        now = parts(painted)
        for name in before:
            assert before[name][~selected].tobytes() == now[name][~selected].tobytes(), f'{name} after {stage}'
    atlas = pymeshlab.MeshSet()
    atlas.add_mesh(painted.current_mesh())
    atlas.dcharts_texture_atlas(selected_only=True)
    # The stages began with odd values in the face quality, which Segment replaces.
    once = parts(atlas)
    for name in once:
        assert once[name].tobytes() == now[name].tobytes(), name


@pytest.mark.parametrize('name', [ATLAS, *STAGES])
def test_nothing_selected(painted, name):
    select(painted, 'x > 1e9')
    before = parts(painted)
    with pytest.raises(pymeshlab.PyMeshLabException, match='no face is selected.*Conditional Face Selection'):
        getattr(painted, name)(selected_only=True)
    after = parts(painted)
    assert all(before[part].tobytes() == after[part].tobytes() for part in before)


def test_meshlabserver(meshlab_2020, screen, plush, tmp_path):
    """A file has no selection, so there is nothing selected unless the script selects something."""
    script = tmp_path / 'selected.mlx'
    one = write_script(tmp_path / 'one.mlx', 'D-Charts: Texture Atlas', EXAMPLES / 'texture_atlas.mlx', selected_only='true')
    selecting = ('<filter name="Conditional Face Selection"><Param type="RichString" name="condSelect" '
                 'value="((x0 + x1 + x2) &gt; 0)"/></filter>')
    script.write_text(one.read_text().replace('<FilterScript>', '<FilterScript>' + selecting))
    for used, selects in ((script, True), (one, False)):
        out = tmp_path / f'{used.stem}.ply'
        run = meshlab_2020.server(screen, '-i', plush, '-o', out, '-m', 'fq', 'fc', 'wt', '-s', used, folder=tmp_path)
        assert ('no face is selected' in run.stdout) != selects, run.stdout[-2000:]
    ms = pymeshlab.MeshSet()
    ms.load_new_mesh(str(plush))
    select(ms)
    selected = ms.current_mesh().face_selection_array().copy()
    ms.dcharts_texture_atlas(selected_only=True)
    expected = ms.current_mesh().face_scalar_array()
    ms.load_new_mesh(str(tmp_path / 'selected.ply'))
    ids = ms.current_mesh().face_scalar_array()
    assert (ids[selected] == expected[selected]).all()
    assert len(np.unique(ids[~selected])) == 1
