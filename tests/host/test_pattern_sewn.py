# SPDX-License-Identifier: GPL-3.0-or-later
"""Pieces sewn back to the model they are of, by the written SVG or the written DXF alone."""
import numpy as np
import pytest

from made_patterns import MODELS, SIZE, made_pattern
from pattern_files import outline_lengths
from sewing import ROUNDING, Sewn, read_seam_table, read_sides

pymeshlab = pytest.importorskip('pymeshlab')
pytest.importorskip('pymeshlab_dcharts')

ALL_MODELS = {**MODELS, 'torus': 'Fabric', 'cad_part': 'Paper', 'cylinder': 'Paper'}
MOST_EASE = {'Fabric': 0.01, 'Paper': 0.001}
BORDER = {'Fabric': 0.05, 'Paper': 0.002}  # of the border's length: simplified by up to 2 mm, it loses teeth


def euler_and_border(mesh):
    """Vertices - edges + faces, and the length of the edges with one face."""
    faces, corners = mesh.face_matrix(), mesh.vertex_matrix()
    edges = np.sort(np.vstack([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
    edges, count = np.unique(edges, axis=0, return_counts=True)
    ends = corners[edges[count == 1]]
    return len(np.unique(faces)) - len(edges) + len(faces), np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1).sum()


@pytest.fixture(scope='module', params=[(name, ending) for name in ALL_MODELS for ending in ('svg', 'dxf')],
                ids=lambda of: '-'.join(of))
def sewn(request, model_file, tmp_path_factory):
    """(name, material, MeshSet, Sewn, seam table). A DXF has been read and written by another program."""
    name, ending = request.param
    ms, file = made_pattern(model_file(name), ALL_MODELS[name], ending)
    if ending == 'dxf':
        ezdxf = pytest.importorskip('ezdxf')
        saved = tmp_path_factory.mktemp(name) / 'saved.dxf'
        ezdxf.readfile(file).saveas(saved)
        file = saved
    return name, ALL_MODELS[name], ms, Sewn(read_sides(file)), read_seam_table(file)


def test_every_seam_closes(sewn):
    """Sides differ in length, and match points in their place, by less than is promised; the table says by how much."""
    _, material, _, pieces, table = sewn
    assert set(table) == set(pieces.seams)
    for number, sides in pieces.seams.items():
        row = table[number]
        assert len(sides) == (1 if row.kind == 'edge' else 2)
        assert {side.piece for side in sides} == set(row.pieces)
        length, matches = pieces.mismatch(number)
        assert max(length, matches) < MOST_EASE[material] + ROUNDING * len(sides[0].points) / row.length, f'S{number}'
        spread = max(s.arcs[-1] for s in sides) - min(s.arcs[-1] for s in sides)
        printed = row.ease * row.length
        assert spread == pytest.approx(printed, abs=0.00005 * row.length + 0.05 * row.ease + 100 * ROUNDING), f'S{number}'


def test_every_point_of_the_outlines_is_in_a_seam(sewn):
    """The stretches of a piece make whole outlines: those of the layer. The model's border is the seams with one side."""
    name, material, ms, pieces, _ = sewn
    loops = pieces.loops()
    expected = outline_lengths(ms.mesh(1))
    assert set(loops) == set(expected)
    for piece, of_piece in loops.items():
        perimeter = sum(np.linalg.norm(np.roll(loop, -1, axis=0) - loop, axis=1).sum() for loop in of_piece)
        assert perimeter == pytest.approx(expected[piece], abs=0.01)
    points = sum(len(loop) for of_piece in loops.values() for loop in of_piece)
    assert points == ms.mesh(1).vertex_number()
    _, border = euler_and_border(ms.mesh(0))
    scale = SIZE / np.ptp(ms.mesh(0).vertex_matrix(), axis=0).max()
    edges = sum(sides[0].arcs[-1] for sides in pieces.seams.values() if len(sides) == 1)
    assert edges == pytest.approx(border * scale, rel=BORDER[material])


def test_it_is_the_model_again(sewn):
    _, _, ms, pieces, _ = sewn
    assert pieces.euler() == euler_and_border(ms.mesh(0))[0]


def test_pieces_split_for_pages_are_sewn_back(tmp_path, plush):
    """Straight seams across pieces larger than a page join what they parted."""
    ms = pymeshlab.MeshSet()
    ms.load_new_mesh(str(plush))
    whole, split = (ms.dcharts_pattern(size=600.0, page='A4', oversize=oversize, output_file=str(tmp_path / 'pattern.svg'))
                    for oversize in ('Tile', 'Split Piece'))
    pieces = Sewn(read_sides(tmp_path / 'pattern.svg'))
    assert len(pieces.loops()) == split['charts'] > 1.5 * whole['charts']
    assert pieces.euler() == euler_and_border(ms.mesh(0))[0]
    for number in pieces.seams:
        assert max(pieces.mismatch(number)) < MOST_EASE['Fabric']
