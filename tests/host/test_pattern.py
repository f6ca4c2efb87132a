# SPDX-License-Identifier: GPL-3.0-or-later
"""D-Charts: Pattern in pymeshlab: the layer, and the files as other programs read them."""
import os
import re

import numpy as np
import pytest
from scipy.spatial import cKDTree

from cases import is_sentence
from loading import load
from made_patterns import ENDINGS, MODELS, SIZE, made_pattern
from pattern_files import LEGEND, dxf_layers, dxf_pieces, length, outline_lengths, pdf_pages, svg_pieces, svg_texts
from sheet_overlap import doubled_allowances, read_groups

pymeshlab = pytest.importorskip('pymeshlab')
pytest.importorskip('pymeshlab_dcharts')

ALLOWANCE = 7.0  # mm, the default
ALL_MODELS = {**MODELS, 'cad_part': 'Paper'}
CLOSE = 0.01  # mm
STITCH = (0.22, 0.3)  # mm, line widths in the PDF


def area(mesh):
    corners = mesh.vertex_matrix()[mesh.face_matrix()]
    return np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1).sum() / 2


@pytest.fixture(scope='module', params=ALL_MODELS)
def made(request, model_file):
    """(model, material, MeshSet, {ending: file}) with the three files written."""
    material = ALL_MODELS[request.param]
    patterns = {ending: made_pattern(model_file(request.param), material, ending) for ending in ENDINGS}
    return request.param, material, patterns['svg'][0], {ending: file for ending, (_, file) in patterns.items()}


def test_layer(made):
    _, material, ms, _ = made
    assert ms.mesh_number() == 2 and ms.current_mesh_id() == 0
    model, pieces = ms.mesh(0), ms.mesh(1)
    assert abs(pieces.vertex_matrix()[:, 2]).max() == 0
    scale = SIZE / np.ptp(model.vertex_matrix(), axis=0).max()
    assert area(pieces) == pytest.approx(area(model) * scale**2, rel=0.05 if material == 'Fabric' else 0.03)
    # All triangles face the viewer, so pieces are not mirrored.
    corners = pieces.vertex_matrix()[pieces.face_matrix()][:, :, :2]
    a, b = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    assert (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0] > -1e-6).all()


def test_lengths_are_those_of_the_layer_in_every_file(made):
    _, material, ms, files = made
    expected = outline_lengths(ms.mesh(1))
    svg, dxf = svg_pieces(files['svg']), dxf_pieces(files['dxf'])
    assert set(svg) == set(dxf) == set(expected)
    sewn = 'stitch' if material == 'Fabric' else 'net'
    for piece, wanted in expected.items():
        assert sum(length(*line) for line in svg[piece][sewn]) == pytest.approx(wanted, abs=CLOSE)
        assert sum(length(*line) for line in dxf[piece]['14']) == pytest.approx(wanted, abs=CLOSE)
        cut = sum(length(*line) for line in svg[piece]['cut'])
        assert sum(length(*line) for line in dxf[piece]['1']) == pytest.approx(cut, abs=CLOSE)
    sheet = pdf_pages(files['pdf'])[-1]
    cut = sum(length(*line) for layers in svg.values() for line in layers['cut'])
    assert sum(length(points, closed) for width, points, closed in sheet if abs(width - 0.35) < 1e-3) == pytest.approx(
        cut + LEGEND, abs=CLOSE)
    if material == 'Fabric':
        assert sum(length(points, closed) for width, points, closed in sheet
                   if min(abs(width - w) for w in STITCH) < 1e-3) == pytest.approx(
                       sum(expected.values()) + 2 * LEGEND, abs=CLOSE)


def test_dxf_layers(made):
    _, material, _, files = made
    assert ({'1', '4', '7', '14'} if material == 'Fabric' else {'1', '8'}) <= dxf_layers(files['dxf'])


def test_notation(made):
    """Each piece has its name, quantity and side; each seam is named on both its sides, each match point twice."""
    _, material, _, files = made
    texts = svg_texts(files['svg'])
    pieces = {name: t for name, t in texts.items() if name.startswith('piece-')}
    for name, of_piece in pieces.items():
        assert f'Piece {name.removeprefix("piece-")}' in of_piece
        assert any(re.fullmatch(r'cut \d+( \+ \d+ mirrored)?', t) for t in of_piece)
        assert ('right side' if material == 'Fabric' else 'outside') in of_piece
    everywhere = [t for of_piece in pieces.values() for t in of_piece]
    seams = [t for t in everywhere if re.match(r'S\d+', t)]
    names = [re.match(r'S\d+', t)[0] for t in seams]
    for text, name in zip(seams, names):
        if not text.endswith('edge'):
            assert names.count(name) == 2, f'{text} is there {names.count(name)} times'
    if material == 'Fabric':
        assert sum('opening' in t for t in seams) == 2
    numbers = [t for t in everywhere if t.isdigit()]
    assert numbers and all(numbers.count(n) == 2 for n in numbers)
    table = [t for name, t in texts.items() if name.startswith('assembly')]
    assert set(names) <= {t for page in table for t in page}


def test_seams_have_equal_sides(made):
    """By the SVG alone: the two sides of a seam are as long as each other, but for the ease."""
    _, material, _, files = made
    text = files['svg'].read_text()
    sides = {}
    for path, seam, _ in re.findall(r'<path d="M([^"]*)"[^>]* data-seam="(\d+)" data-side="(\d+)"/>', text):
        points = np.array(re.findall(r'-?[\d.]+', path), float).reshape(-1, 2)
        sides.setdefault(seam, []).append(length(points))
    assert len(sides) > 3
    for lengths in sides.values():
        assert max(lengths) - min(lengths) <= (0.01 if material == 'Fabric' else 0.001) * max(lengths) + CLOSE


def test_there_is_room_for_the_allowance(made):
    """Pieces do not come so near to themselves that allowances lie on each other."""
    _, material, _, files = made
    if material == 'Fabric':
        assert doubled_allowances(read_groups(files['svg']), ALLOWANCE) == []


def noisy(path):
    """A mesh with its vertices off their places by up to 5 % of the mean edge."""
    ms = load(path)
    corners, faces = ms.current_mesh().vertex_matrix(), ms.current_mesh().face_matrix()
    edge = np.linalg.norm(corners[faces[:, 0]] - corners[faces[:, 1]], axis=1).mean()
    noise = np.random.default_rng(3).uniform(-0.05, 0.05, corners.shape) * edge
    ms = pymeshlab.MeshSet()
    ms.add_mesh(pymeshlab.Mesh(corners + noise, faces))
    return ms


def outline_points(corners):
    """`corners`: n by 3 by 2, the triangles of a flat piece; points along its outline, a millimetre apart."""
    points, faces = np.unique(corners.reshape(-1, 2), axis=0, return_inverse=True)
    faces = faces.reshape(-1, 3)
    edges = np.vstack([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    _, first, uses = np.unique(np.sort(edges, axis=1), axis=0, return_index=True, return_counts=True)
    along = []
    for p, q in points[edges[first[uses == 1]]]:
        steps = np.linspace(0, 1, 2 + int(np.linalg.norm(q - p)))[:, None]
        along.append(p + steps * (q - p))
    return np.vstack(along)


def is_its_own_image(corners):
    """Whether a line mirrors the piece onto itself, but for 3 % of its width. Such a line is a principal axis."""
    points = outline_points(corners)
    points -= points.mean(axis=0)
    width = np.ptp(points, axis=0).max()
    for axis in np.linalg.eigh(np.cov(points.T))[1].T:
        image = points - 2 * np.outer(points @ axis, axis)
        if cKDTree(points).query(image)[0].max() < 0.03 * width:
            return True
    return False


# The bear's back goes round the tail: a seam opens it, on one side only.
@pytest.mark.parametrize('name, share', [('plush', 0.4), ('bishop', 0.95)])
def test_symmetric_models_have_mirrored_pairs(tmp_path, model_file, name, share):
    """Drawn once, also in the layer; the numbers to cut are those of all pieces. Pieces that the mirror goes through have no
    partner: they are their own image."""
    ms, file = noisy(model_file(name)), tmp_path / 'pairs.svg'
    count = ms.dcharts_pattern(size=SIZE, merge_congruent=True, output_file=str(file))['charts']
    texts = svg_texts(file)
    copies = {}
    for piece, of_piece in texts.items():
        if piece.startswith('piece-'):
            quantity = next(t for t in of_piece if t.startswith('cut '))
            copies[int(piece.removeprefix('piece-'))] = [int(n) for n in re.findall(r'\d+', quantity)]
    assert sum(map(sum, copies.values())) == count > len(copies)
    assert any(f'{count} pieces' in t for t in texts['assembly'])
    pieces = ms.mesh(1)
    corners = pieces.vertex_matrix()[pieces.face_matrix()]
    areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) / 2
    area = {piece: areas[pieces.face_scalar_array() + 1 == piece].sum() for piece in copies}
    whole = sum(area[piece] * sum(numbers) for piece, numbers in copies.items())
    symmetric = 0
    for piece, numbers in copies.items():
        if len(numbers) == 2 or is_its_own_image(corners[pieces.face_scalar_array() + 1 == piece][:, :, :2]):
            symmetric += area[piece] * sum(numbers)
    assert any(len(numbers) == 2 for numbers in copies.values())
    assert symmetric > share * whole, f'{symmetric / whole:.2f}: {copies}'


def page_sizes(path):
    boxes = re.findall(rb'/MediaBox\s*\[\s*([-\d. ]+)\]', path.read_bytes())
    return [[float(x) * 25.4 / 72 for x in box.split()[2:]] for box in boxes]


@pytest.mark.parametrize('page, size', [('A4', (210, 297)), ('A3', (297, 420)), ('A0', (841, 1189)),
                                        ('Letter', (215.9, 279.4))])
def test_pages(tmp_path, plush, page, size):
    ms, file = load(plush), tmp_path / 'pages.pdf'
    ms.dcharts_pattern(size=SIZE, page=page, output_file=str(file))
    sizes = page_sizes(file)
    assert len(sizes) >= 2
    for found in sizes:
        assert sorted(found) == pytest.approx(sorted(size), abs=0.2)
    # Nothing is drawn where printers do not print.
    for strokes in pdf_pages(file):
        for _, points, _ in strokes:
            assert len(points) >= 2


def test_a_large_piece_is_tiled(tmp_path, plush):
    """Every page has a scale bar of 50 mm (its ends are ticks), and neighbouring tiles show the same marks."""
    ms, file = load(plush), tmp_path / 'tiles.pdf'
    ms.dcharts_pattern(size=400.0, target_charts=6, page='A4', output_file=str(file))
    pages = pdf_pages(file)
    diamonds = [[points for width, points, closed in strokes if closed and len(points) == 4 and length(points, True) < 25]
                for strokes in pages]
    tiled = [d for d in diamonds if d]
    assert len(tiled) >= 2, 'nothing is tiled'
    bars = [any(len(points) == 2 and abs(length(points) - 50) < 1e-3 for _, points, _ in strokes) for strokes in pages]
    assert sum(bars) >= len(tiled)


def test_texture_is_printed(tmp_path, plush):
    ms, plain, colored = load(plush), tmp_path / 'plain.svg', tmp_path / 'colored.svg'
    ms.compute_color_by_function_per_vertex(x='127 + 100 * sin(x)', y='127 + 100 * cos(y)', z='17', a='255')
    ms.dcharts_pattern(size=SIZE, output_file=str(plain))
    ms.dcharts_pattern(size=SIZE, print_texture=True, output_file=str(colored))
    assert colored.read_text().count('-clip-1"') == len(svg_pieces(colored)) > 0  # a picture for each
    assert plain.read_text().count('-clip-1"') == 0


def test_inch(tmp_path, plush):
    sizes = []
    for values in ({'size': 254.0}, {'size': 10.0, 'units': 'inch'}):
        ms = load(plush)
        ms.dcharts_pattern(**values)
        sizes.append(area(ms.mesh(1)))
    assert sizes[0] == pytest.approx(sizes[1], rel=1e-5)


KEPT_ALIVE = []  # see test_pymeshlab.py


def refusal(ms, **parameters):
    KEPT_ALIVE.append(ms)
    with pytest.raises(pymeshlab.PyMeshLabException) as refused:
        ms.dcharts_pattern(**parameters)
    assert is_sentence(str(refused.value)), str(refused.value)
    assert ms.mesh_number() == 1
    return str(refused.value)


@pytest.mark.parametrize('name', ['pattern.txt', 'pattern', 'svg', 'no such folder/pattern.svg'])
def test_file_that_cannot_be(tmp_path, plush, name):
    assert 'output_file' in refusal(load(plush), size=SIZE, output_file=str(tmp_path / name))
    assert os.listdir(tmp_path) == []


def test_file_that_cannot_be_written(tmp_path, plush):
    """A folder of that name is in the way: root may write anything else. No half-written file is left."""
    (tmp_path / 'taken.svg').mkdir()
    assert 'taken.svg' in refusal(load(plush), size=SIZE, output_file=str(tmp_path / 'taken.svg'))
    assert os.listdir(tmp_path) == ['taken.svg'] and os.listdir(tmp_path / 'taken.svg') == []


def test_an_older_file_stays_when_the_pattern_is_refused(tmp_path, plush):
    file = tmp_path / 'old.svg'
    file.write_text('old')
    refusal(load(plush), seam_allowance=-1.0, output_file=str(file))
    assert file.read_text() == 'old'
