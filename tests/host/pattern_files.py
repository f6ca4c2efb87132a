# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads the files of a pattern as other programs do: what is cut and what is sewn, in mm."""
import re
import xml.etree.ElementTree as ElementTree
import zlib

import numpy as np

SVG = '{http://www.w3.org/2000/svg}'
MM_PER_POINT = 25.4 / 72
LEGEND = 14  # mm: the length of a sample of a kind of line in the legend


def length(points, closed=False):
    points = np.asarray(points)
    if closed:
        points = np.vstack([points, points[:1]])
    return float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())


def _svg_path(node):
    numbers = re.findall(r'-?[\d.]+', node.get('d'))
    return np.array(numbers, float).reshape(-1, 2)


def svg_pieces(path):
    """{piece number: {layer: [(points, closed)]}} of an SVG; y points downwards."""
    root = ElementTree.parse(path).getroot()
    width, height = (float(root.get(side).removesuffix('mm')) for side in ('width', 'height'))
    assert root.get('viewBox').split() == ['0', '0', root.get('width')[:-2], root.get('height')[:-2]], 'units are not mm'
    pieces = {}
    for group in root.findall(f"{SVG}g[@class='piece']"):
        layers = {}
        for layer in group.findall(f'{SVG}g'):
            layers[layer.get('class')] = [(_svg_path(p), p.get('d').endswith('Z')) for p in layer.findall(f'{SVG}path')]
        pieces[int(group.get('id').removeprefix('piece-'))] = layers
    for layers in pieces.values():
        for lines in layers.values():
            for points, _ in lines:
                assert points.min() >= 0 and points[:, 0].max() <= width and points[:, 1].max() <= height
    return pieces


def svg_texts(path):
    """All texts of an SVG, by the id of the group of a piece or of the sheet."""
    root = ElementTree.parse(path).getroot()
    return {group.get('id'): [t.text for t in group.iter(f'{SVG}text')] for group in root.findall(f'{SVG}g')}


def dxf_points(polyline):
    return np.array([v.dxf.location for v in polyline.vertices])[:, :2]


def dxf_lines(path):
    """(piece number, POLYLINE) of all lines in the pieces of a DXF, in the file's order."""
    import ezdxf
    document = ezdxf.readfile(path)
    assert document.dxfversion == 'AC1009'
    assert not document.audit().errors
    declared = {layer.dxf.name for layer in document.layers}
    inserted = [insert.dxf.name for insert in document.modelspace().query('INSERT')]
    for block in document.blocks:
        if not block.name.startswith('PIECE_'):
            continue
        assert inserted.count(block.name) == 1
        for entity in block:
            assert entity.dxf.layer in declared
            if entity.dxftype() == 'POLYLINE':
                yield int(block.name.removeprefix('PIECE_')), entity


def dxf_pieces(path):
    """{piece number: {layer: [(points, closed)]}} of a DXF."""
    pieces = {}
    for piece, line in dxf_lines(path):
        pieces.setdefault(piece, {}).setdefault(line.dxf.layer, []).append((dxf_points(line), line.is_closed))
    return pieces


def dxf_layers(path):
    import ezdxf
    return {layer.dxf.name for layer in ezdxf.readfile(path).layers}


def pdf_pages(path):
    """Per page of a PDF its strokes: [(line width, points, closed)], all in mm."""
    data = path.read_bytes()
    pages = []
    for match in re.finditer(rb'(?<!end)stream\r?\n', data):
        try:
            text = zlib.decompressobj().decompress(data[match.end():]).decode('latin-1')
        except zlib.error:
            continue
        if re.search(r'\d RG\n', text):  # not the pixels of a picture
            pages.append(_strokes(text))
    return pages


def _strokes(content):
    strokes, numbers, path, closed, width = [], [], [], False, 1.0
    for token in re.sub(r'\((?:\\.|[^\\)])*\)', '', content).split():
        if re.fullmatch(r'-?[\d.]+', token):
            numbers.append(float(token) * MM_PER_POINT)
            continue
        if token == 'w':
            width = numbers[-1]
        elif token == 'm':
            path, closed = [numbers[-2:]], False
        elif token == 'l':
            path.append(numbers[-2:])
        elif token == 'h':
            closed = True
        elif token == 'S':
            strokes.append((width, np.array(path), closed))
        numbers = []
    return strokes


def outline_lengths(mesh):
    """{piece number: length of its outline} of the layer of flat pieces."""
    corners, faces = mesh.vertex_matrix()[:, :2], mesh.face_matrix()
    lengths = {}
    for piece in np.unique(mesh.face_scalar_array()).astype(int):
        own = faces[mesh.face_scalar_array() == piece]
        edges = np.sort(np.vstack([own[:, [0, 1]], own[:, [1, 2]], own[:, [2, 0]]]), axis=1)
        edges, count = np.unique(edges, axis=0, return_counts=True)
        ends = corners[edges[count == 1]]
        lengths[piece + 1] = float(np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1).sum())
    return lengths
