# SPDX-License-Identifier: GPL-3.0-or-later
"""selected_only in the hosts: all faces but the selected ones stay as they are, byte for byte."""
from xml.sax.saxutils import escape

import numpy as np
import pytest

from cases import STAGES
from mlx import one_filter
from paint import paint

pymeshlab = pytest.importorskip('pymeshlab')
pytest.importorskip('pymeshlab_dcharts')

ATLAS = 'dcharts_texture_atlas'
CONDITION = 'x0 + x1 + x2 > 0'
NOWHERE = 'x0 > 1e9'


def select(ms, condition=CONDITION):
    ms.compute_selection_by_condition_per_face(condselect=condition)


@pytest.fixture
def painted(plush):
    """The plush model with quality, colour and texcoords that no filter would write, half of it selected."""
    ms = pymeshlab.MeshSet()
    ms.load_new_mesh(str(plush))
    paint(ms)
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
    select(painted, NOWHERE)
    before = parts(painted)
    with pytest.raises(pymeshlab.PyMeshLabException, match='no face is selected.*Conditional Face Selection'):
        getattr(painted, name)(selected_only=True)
    after = parts(painted)
    assert all(before[part].tobytes() == after[part].tobytes() for part in before)


def test_meshlabserver(server, plush, tmp_path):
    """A file has no selection, so there is nothing selected unless the script selects something."""
    script = one_filter(tmp_path, 'D-Charts: Texture Atlas', selected_only=True)
    run, _ = server(script, plush)
    assert 'no face is selected' in run.stdout, run.stdout[-2000:]
    selecting = ('<filter name="Conditional Face Selection"><Param type="RichString" name="condSelect" '
                 f'value="({escape(CONDITION)})"/></filter>')
    script.write_text(script.read_text().replace('<FilterScript>', '<FilterScript>' + selecting))
    run, out = server(script, plush)
    assert 'no face is selected' not in run.stdout, run.stdout[-2000:]
    ms = pymeshlab.MeshSet()
    ms.load_new_mesh(str(plush))
    select(ms)
    selected = ms.current_mesh().face_selection_array().copy()
    ms.dcharts_texture_atlas(selected_only=True)
    expected = ms.current_mesh().face_scalar_array()
    ms.load_new_mesh(str(out))
    ids = ms.current_mesh().face_scalar_array()
    assert (ids[selected] == expected[selected]).all()
    assert len(np.unique(ids[~selected])) == 1
