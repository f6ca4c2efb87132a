# SPDX-License-Identifier: GPL-3.0-or-later
"""Layers with a matrix, tiny, huge and far-away meshes, and the fewest faces, as pymeshlab hands them over."""
import numpy as np
import pytest

from cases import ROOT, is_sentence

pymeshlab = pytest.importorskip('pymeshlab')
pytest.importorskip('pymeshlab_dcharts')

ATLAS = 'dcharts_texture_atlas'
TORUS = ROOT / 'meshes' / 'torus.ply'
STRETCHED = np.diag([3.0, 1.0, 0.5, 1.0])
TURNED_AND_LARGER = np.array([[0.0, -2.0, 0.0, 5.0], [2.0, 0.0, 0.0, -7.0], [0.0, 0.0, 2.0, 1.0], [0.0, 0.0, 0.0, 1.0]])
KEPT_ALIVE = []  # see test_pymeshlab.py


def load(matrix=None, freeze=False):
    ms = pymeshlab.MeshSet()
    ms.load_new_mesh(str(TORUS))
    if matrix is not None:
        ms.set_matrix(transformmatrix=matrix, freeze=freeze)
    return ms


def result(ms):
    mesh = ms.current_mesh()
    return mesh.face_scalar_array().tobytes(), mesh.wedge_tex_coord_matrix().tobytes(), mesh.face_color_matrix().tobytes()


def without_seconds(figures):
    return {name: value for name, value in figures.items() if not name.startswith('seconds')}


# --- layers with a matrix: what is seen counts

@pytest.mark.parametrize('matrix', [STRETCHED, TURNED_AND_LARGER], ids=['stretched', 'turned and larger'])
def test_a_matrix_counts_as_if_it_were_applied(matrix):
    ms, frozen = load(matrix), load(matrix, freeze=True)
    vertices = ms.current_mesh().vertex_matrix().copy()
    figures = ms.apply_filter(ATLAS)
    assert without_seconds(figures) == without_seconds(frozen.apply_filter(ATLAS))
    assert result(ms) == result(frozen)
    assert np.array_equal(ms.current_mesh().vertex_matrix(), vertices)
    assert np.array_equal(ms.current_mesh().transform_matrix(), matrix)


def test_measure_sees_the_stretch_of_a_matrix():
    ms = load()
    plain = ms.apply_filter(ATLAS)
    ms.set_matrix(transformmatrix=TURNED_AND_LARGER, freeze=False)
    assert ms.dcharts_measure()['l2_stretch'] == pytest.approx(plain['l2_stretch'], rel=1e-9)
    ms.set_matrix(transformmatrix=STRETCHED, freeze=False)
    assert ms.dcharts_measure()['l2_stretch'] > 1.2 * plain['l2_stretch']


def test_a_pattern_is_as_large_as_what_is_seen():
    widths = []
    for matrix in (np.diag([50.0, 50.0, 50.0, 1.0]), np.diag([100.0, 100.0, 100.0, 1.0])):
        ms = load(matrix)
        ms.dcharts_pattern()
        widths.append(np.ptp(ms.mesh(1).vertex_matrix(), axis=0).max())
    assert widths[1] > 1.5 * widths[0]


def test_the_seam_layer_lies_on_what_is_seen():
    ms = load(STRETCHED)
    ms.apply_filter(ATLAS, seam_layer=True)
    mesh, seams = ms.mesh(0), ms.mesh(1)
    corners = {p.tobytes() for p in np.float32(mesh.transformed_vertex_matrix())}
    points = np.float32(seams.transformed_vertex_matrix())
    assert len(points) > 0 and all(p.tobytes() in corners for p in points)


@pytest.mark.parametrize('matrix, word', [(np.diag([0.0, 0.0, 0.0, 1.0]), 'area'), (np.diag([np.nan, 1.0, 1.0, 1.0]), 'not a number')])
def test_a_matrix_that_leaves_nothing(matrix, word):
    ms = load(matrix)
    KEPT_ALIVE.append(ms)
    with pytest.raises(pymeshlab.PyMeshLabException) as error:
        ms.apply_filter(ATLAS)
    assert word in str(error.value) and is_sentence(str(error.value))


# --- sizes and places

@pytest.mark.parametrize('scale, offset', [(1e-20, 0.0), (1e20, 0.0), (1.0, 1e6), (1e-3, 1.0)])
def test_sizes_and_places(scale, offset):
    """The atlas is sound, and where nothing is lost by rounding its charts are those of the ordinary size."""
    plain, ms = load(), pymeshlab.MeshSet()
    mesh = plain.current_mesh()
    ms.add_mesh(pymeshlab.Mesh(vertex_matrix=mesh.vertex_matrix() * scale + offset, face_matrix=mesh.face_matrix()))
    expected, figures = plain.apply_filter(ATLAS), ms.apply_filter(ATLAS)
    assert figures['flipped_faces'] == figures['overlapping_faces'] == figures['unassigned_faces'] == 0
    assert figures['l2_stretch'] == pytest.approx(expected['l2_stretch'], rel=0.01)
    uv = ms.current_mesh().wedge_tex_coord_matrix()
    assert np.isfinite(uv).all() and uv.min() >= 0 and uv.max() <= 1
    if offset == 0:
        assert np.array_equal(ms.current_mesh().face_scalar_array(), plain.current_mesh().face_scalar_array())


# --- the fewest faces

@pytest.mark.parametrize('faces', [1, 2])
def test_one_or_two_faces(faces):
    ms = pymeshlab.MeshSet()
    ms.add_mesh(pymeshlab.Mesh(vertex_matrix=np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])[:faces + 2],
                               face_matrix=np.array([[0, 1, 2], [0, 2, 3]])[:faces]))
    figures = ms.apply_filter(ATLAS)
    assert figures['charts'] == 1 and figures['l2_stretch'] == pytest.approx(1, abs=1e-6)
    assert ms.dcharts_pattern(size=100.0)['charts'] == 1
