# SPDX-License-Identifier: GPL-3.0-or-later
"""The pictures show what they should."""
import numpy as np
import pytest

from pymeshlab_dcharts.pictures import Model, atlas_picture, chart_colors, charts_picture, checker_image
from pymeshlab_dcharts.pictures import raster
from pymeshlab_dcharts.pictures.raster import rasterize, stamp_lines
from pymeshlab_dcharts.pictures.views import guess_up

NOTHING = -1


def cube(n=4):
    """A cube of n by n cells a side with shared vertices, a chart per side, and texture coordinates of a three by two table."""
    index, vertices, faces, ids, uvs = {}, [], [], [], []

    def vertex(p):
        return index.setdefault(tuple(p), len(index))

    for side in range(6):
        axis, far = side // 2, side % 2
        for i in range(n):
            for j in range(n):
                cell = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
                if not far:
                    cell.reverse()
                corners = [np.roll([far * n, *c], axis) for c in cell]
                uv = [(np.array(c) / n * 0.8 + 0.1 + [side % 3, side // 3]) / 3 for c in cell]
                for triangle in ([0, 1, 2], [0, 2, 3]):
                    faces.append([vertex(corners[k]) for k in triangle])
                    uvs.append([uv[k] for k in triangle])
                    ids.append(side)
    return np.array(list(index), float), np.array(faces), np.array(ids), np.array(uvs)


@pytest.mark.parametrize("order", [[0, 1], [1, 0]])
def test_nearer_triangle_hides_the_other(order):
    points = np.array([[0, 0], [20, 0], [0, 20], [0, 0], [10, 0], [0, 10]], float)
    depths = np.array([2, 2, 2, 1, 1, 1], float)
    faces = np.array([[0, 1, 2], [3, 4, 5]])[order]
    seen = rasterize(points, depths, faces, 20, 20)
    face, depth = seen.spread(seen.face, NOTHING), seen.spread(seen.depth, np.inf)
    assert face[2, 2] == order.index(1)
    assert face[12, 2] == order.index(0)
    assert face[19, 19] == NOTHING
    assert depth[2, 2] == 1 and depth[12, 2] == 2 and np.isinf(depth[19, 19])


def test_nearer_triangle_hides_the_other_in_a_later_run(monkeypatch):
    monkeypatch.setattr(raster, "CANDIDATES_AT_ONCE", 1)
    for order in ([0, 1], [1, 0]):
        test_nearer_triangle_hides_the_other(order)


def test_a_square_is_covered_without_gaps_and_interpolates():
    points = np.array([[1, 2], [31, 2], [31, 22], [1, 22]], float)
    faces = np.array([[0, 1, 2], [0, 3, 2]])  # one of them clockwise
    seen = rasterize(points, np.zeros(4), faces, 40, 30)
    assert len(seen.pixel) == 30 * 20
    place = seen.interpolate(points[faces])
    assert np.allclose(place[:, 0], seen.pixel % 40 + 0.5, atol=1e-4)
    assert np.allclose(place[:, 1], seen.pixel // 40 + 0.5, atol=1e-4)


def test_triangles_without_area_and_outside_are_left_out():
    points = np.array([[1, 1], [5, 5], [9, 9], [-50, -50], [-40, -50], [-50, -40]], float)
    seen = rasterize(points, np.zeros(6), np.array([[0, 1, 2], [0, 0, 0], [3, 4, 5]]), 10, 10)
    assert len(seen.pixel) == 0
    assert len(rasterize(points, np.zeros(6), np.zeros((0, 3), int), 10, 10).pixel) == 0


def test_lines_are_drawn_where_visible():
    mask = np.zeros((20, 20), bool)
    stamp_lines(mask, np.array([[2.5, 10.5]]), np.array([[17.5, 10.5]]), 1)
    assert mask[10, 2:18].all() and mask[9, 5] and not mask[8].any() and not mask[:, 19].any()
    hidden = np.zeros((20, 20), bool)
    stamp_lines(hidden, np.array([[2.5, 10.5]]), np.array([[17.5, 10.5]]), 1, lambda x, y, segment, t: x < 10)
    assert hidden[10, 5] and not hidden[10, 12]


def test_seams_are_borders_of_charts_and_slits_in_the_texture():
    n = 4
    vertices, faces, ids, uvs = cube(n)
    face, _ = Model(vertices, faces, ids).seam_corners
    assert len(face) == 12 * n * 2
    one = np.zeros_like(ids)
    assert len(Model(vertices, faces, one).seam_corners[0]) == 0
    assert len(Model(vertices, faces, one, uvs).seam_corners[0]) == 12 * n * 2
    assert len(Model(vertices, faces[1:], one[1:]).seam_corners[0]) == 3  # the rim of a hole


def test_three_views_show_all_sides_of_a_cube():
    vertices, faces, ids, _ = cube()
    model = Model(vertices, faces, ids)
    seen_sides = set()
    for view in model.views:
        assert np.allclose(view @ view.T, np.eye(3)) and np.linalg.det(view) > 0
        outward = np.array([(-1 if side % 2 == 0 else 1) * np.eye(3)[side // 2] for side in range(6)])
        seen_sides |= set(np.flatnonzero(outward @ view[2] > 0.15))
    assert seen_sides == set(range(6))


def test_up_is_away_from_what_the_model_stands_on():
    rng = np.random.default_rng(1)
    height = rng.random(4000)
    around = rng.random(4000) * 2 * np.pi
    tent = np.stack([(1 - height) * np.cos(around), (1 - height) * np.sin(around), height], 1)
    assert guess_up(tent).tolist() == [0, 0, 1]
    assert guess_up(tent[:, [0, 2, 1]]).tolist() == [0, 1, 0]


def hues(image, colors):
    """Which of the colours are seen, whatever the light."""
    pixels = np.asarray(image).reshape(-1, 3) / 255.0
    direction = pixels / np.maximum(np.linalg.norm(pixels, axis=1, keepdims=True), 1e-9)
    wanted = colors / np.linalg.norm(colors, axis=1, keepdims=True)
    return [(direction @ w > 0.9999).sum() > 50 for w in wanted]


def test_pictures_show_every_chart():
    vertices, faces, ids, uvs = cube()
    colors = np.array([[1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 0], [0, 1, 1], [1, 0, 1]], float)
    model = Model(vertices, faces, ids, uvs, colors[ids])
    assert all(hues(charts_picture(model, "cube", size=120), colors))
    atlas = atlas_picture(model, "cube", size=240)
    assert all(hues(atlas.crop((0, 74, 264, 314)), colors))


def test_unassigned_faces_are_grey_and_charts_differ():
    assert len({tuple(c) for c in chart_colors(40).round(6)}) == 40
    vertices, faces, ids, _ = cube()
    model = Model(vertices, faces, np.where(ids == 0, -1, ids))
    assert np.ptp(model.colors[0]) == 0 and np.ptp(model.colors[-1]) > 0


def test_checker_fields_have_two_colours_and_the_right_size():
    checker = np.asarray(checker_image(64, 8))
    assert len(np.unique(checker.reshape(-1, 3), axis=0)) == 2
    assert (checker[:8, :8] == checker[0, 0]).all() and (checker[0, 8] != checker[0, 0]).any()
