# SPDX-License-Identifier: GPL-3.0-or-later
"""Looks at results from outside: reads PLY files without a host, and measures atlases with the evaluator."""
import json
import pathlib
import struct
import subprocess
import sys
from dataclasses import dataclass

import numpy as np

from cases import ROOT

SHARED = ROOT.parent / 'shared'
EVALUATOR = SHARED / 'tools' / 'evaluate_atlas.py'

_NUMPY = {'char': 'i1', 'uchar': 'u1', 'short': 'i2', 'ushort': 'u2', 'int': 'i4', 'uint': 'u4', 'float': 'f4',
          'double': 'f8', 'int8': 'i1', 'uint8': 'u1', 'int16': 'i2', 'uint16': 'u2', 'int32': 'i4', 'uint32': 'u4',
          'float32': 'f4', 'float64': 'f8'}
_STRUCT = {'i1': 'b', 'u1': 'B', 'i2': 'h', 'u2': 'H', 'i4': 'i', 'u4': 'I', 'f4': 'f', 'f8': 'd'}


@dataclass
class Faces:
    """The faces of a PLY file; what it does not have is None."""
    face_vertices: np.ndarray  # #F by 3
    quality: np.ndarray  # #F
    colors: np.ndarray  # #F by 3
    texcoords: np.ndarray  # #F by 6


def ply_layers(path):
    """Reads the faces of a binary little-endian PLY of triangles, as MeshLab writes it."""
    data = pathlib.Path(path).read_bytes()
    head, body = data.split(b'end_header\n', 1)
    elements = []
    for line in head.decode().splitlines():
        words = line.split()
        if words[0] == 'element':
            elements.append((words[1], int(words[2]), []))
        elif words[0] == 'property':
            elements[-1][2].append(words[1:])
    assert b'binary_little_endian' in head, 'not a binary PLY'
    offset = 0
    for name, count, properties in elements:
        if name != 'face':
            assert all(p[0] != 'list' for p in properties), f'a list in {name}'
            offset += count * sum(np.dtype(_NUMPY[p[0]]).itemsize for p in properties)
            continue
        columns = {p[-1]: [] for p in properties}
        for _ in range(count):
            for p in properties:
                if p[0] == 'list':
                    size = struct.unpack_from('<' + _STRUCT[_NUMPY[p[1]]], body, offset)[0]
                    offset += np.dtype(_NUMPY[p[1]]).itemsize
                    kind = _NUMPY[p[2]]
                    columns[p[-1]].append(struct.unpack_from(f'<{size}{_STRUCT[kind]}', body, offset))
                    offset += size * np.dtype(kind).itemsize
                else:
                    kind = _NUMPY[p[0]]
                    columns[p[-1]].append(struct.unpack_from('<' + _STRUCT[kind], body, offset)[0])
                    offset += np.dtype(kind).itemsize
        colors = [columns.get(c) for c in ('red', 'green', 'blue')]
        optional = lambda values: None if values is None else np.array(values)  # noqa: E731
        return Faces(np.array(columns['vertex_indices']), optional(columns.get('quality')),
                     None if None in colors else np.array(colors).T, optional(columns.get('texcoord')))
    raise AssertionError(f'no faces in {path}')


def evaluate(atlas, reference):
    """The evaluator's figures of an atlas file (OBJ or PLY) of the mesh file `reference`."""
    run = subprocess.run([sys.executable, str(EVALUATOR), str(atlas), '--ref', str(reference), '--per-chart'],
                         capture_output=True, text=True, timeout=600)
    assert run.returncode == 0 and run.stdout, run.stderr[-2000:]
    return json.loads(run.stdout)


def flaws(figures):
    """What makes an atlas unsound, as words; empty when it is sound."""
    found = []
    if figures.get('ref') != 'used':
        found.append(f"reference mesh: {figures.get('ref')}")
    if figures['flipped_triangles']:
        found.append(f"{figures['flipped_triangles']} flipped faces")
    if figures.get('degenerate_uv'):
        found.append(f"{figures['degenerate_uv']} faces without area in the texture")
    if (figures.get('overlap_fraction') or 0) >= 1e-9:
        found.append(f"overlap {figures['overlap_fraction']}")
    for chart in figures['chart_list']:
        if chart['boundary_loops'] < 1 or chart['euler'] + chart['boundary_loops'] != 2:
            found.append(f"a chart with {chart['boundary_loops']} boundary loops and Euler number {chart['euler']}")
    return found
