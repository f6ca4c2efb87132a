# SPDX-License-Identifier: GPL-3.0-or-later
"""Sews the pieces of a pattern together, from the written SVG or DXF alone.

A seam is found as a person finds it: the stretch of a piece's stitch line (of its net, for paper) that has the
seam's number, and the match points on it, which say which end goes to which."""
import re
import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass, field

import numpy as np

from pattern_files import SVG, dxf_lines, dxf_points

ROUNDING = 2e-4  # mm: numbers in the file have four decimals


@dataclass
class Side:
    """One side of a seam: a stretch of the outline of `piece`."""
    piece: int
    points: np.ndarray
    matches: dict = field(default_factory=dict)  # number of a match point -> arc length from the stretch's start

    @property
    def arcs(self):
        return np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(self.points, axis=0), axis=1))])

    @property
    def closed(self):
        return len(self.points) > 2 and np.array_equal(self.points[0], self.points[-1])

    def arc_at(self, point):
        """(arc length, distance) of the place on this stretch that is nearest to a point."""
        start, way = self.points[:-1], np.diff(self.points, axis=0)
        t = np.clip(((point - start) * way).sum(axis=1) / (way**2).sum(axis=1), 0, 1)
        distance = np.linalg.norm(start + t[:, None] * way - point, axis=1)
        k = distance.argmin()
        return self.arcs[k] + t[k] * np.linalg.norm(way[k]), distance[k]


@dataclass
class SeamRow:
    """A line of the seam table."""
    order: int
    pieces: tuple
    length: float  # mm
    ease: float  # share of the length
    kind: str


def _points(path):
    return np.array(re.findall(r'-?[\d.]+', path.get('d')), float).reshape(-1, 2)


def _svg_lines(path):
    """(piece, points, {name: number}) of each line of a seam."""
    root = ElementTree.parse(path).getroot()
    for group in root.findall(f"{SVG}g[@class='piece']"):
        for line in group.iter(f'{SVG}path'):
            data = {name: int(line.get(f'data-{name}')) for name in ('seam', 'side', 'match') if line.get(f'data-{name}')}
            if data:
                yield int(group.get('id').removeprefix('piece-')), _points(line), data


def _dxf_lines(path):
    """The same of a DXF."""
    for piece, line in dxf_lines(path):
        if line.has_xdata('DCHARTS'):
            values = [value for code, value in line.get_xdata('DCHARTS') if code != 1001]
            data = {name: number for name, number in zip(values[::2], values[1::2]) if name != 'angle'}
            if data:
                yield piece, dxf_points(line), data


def read_sides(path):
    """{seam number: [Side]} of an SVG or a DXF, each side with its match points."""
    sides, notches = {}, {}
    for piece, points, data in (_dxf_lines if path.suffix == '.dxf' else _svg_lines)(path):
        key = data['seam'], data['side']
        if 'match' in data:
            notches.setdefault((key, data['match']), []).append(points)
        else:
            assert key not in sides, f'side {key} is there twice'
            sides[key] = Side(piece, points)
    for (key, number), lines in notches.items():
        sides[key].matches[number] = _arc_of_notch(sides[key], lines)
    seams = {}
    for seam, _ in sorted(sides):
        seams[seam] = [side for key, side in sorted(sides.items()) if key[0] == seam]
    return seams


def _arc_of_notch(side, lines):
    """A notch is one line across the stitch line, or two with the point between them; further lines are at the edge
    of the fabric. On paper the lines begin at the edge of the net."""
    arcs = []
    for ends in lines:
        arc, distance = min((side.arc_at(p) for p in (ends[0], ends.mean(axis=0))), key=lambda found: found[1])
        if distance < 0.3:
            arcs.append(arc)
    assert 1 <= len(arcs) <= 2, f'{len(arcs)} lines of a notch are at the stitch line'
    if side.closed and max(arcs) - min(arcs) > side.arcs[-1] / 2:  # around the start
        arcs = [arc - side.arcs[-1] if arc > side.arcs[-1] / 2 else arc for arc in arcs]
    return float(np.mean(arcs))


def _svg_table_texts(path):
    """(x where it begins, height, text, page) of the texts on the assembly pages."""
    root = ElementTree.parse(path).getroot()
    for group in root.findall(f'{SVG}g'):
        if not group.get('id').startswith('assembly'):
            continue
        for text in group.iter(f'{SVG}text'):
            x, y = map(float, re.match(r'translate\(([-\d.]+),([-\d.]+)\)', text.get('transform')).groups())
            yield x - float(text.get('textLength')) / 2, y, text.text, group.get('id')


def _dxf_table_texts(path):
    """The same of what is not in pieces, from the first table's head to the right."""
    import ezdxf
    texts = ezdxf.readfile(path).modelspace().query('TEXT')
    left = min(text.dxf.insert.x for text in texts if text.dxf.text == 'order')
    for text in texts:
        if text.dxf.insert.x >= left:
            yield text.dxf.insert.x, text.dxf.insert.y, text.dxf.text.replace('%%%', '%'), ''


def read_seam_table(path):
    """{seam number: SeamRow} of the seam table in an SVG or a DXF."""
    rows, cells = {}, {}
    for x, y, text, page in (_dxf_table_texts if path.suffix == '.dxf' else _svg_table_texts)(path):
        cells.setdefault((page, round(y, 1)), []).append((x, text))
    for row in cells.values():
        row = [text for _, text in sorted(row)]
        # Two columns of the table may stand beside each other.
        starts = [i for i, text in enumerate(row) if re.fullmatch(r'S\d+', text)]
        for i, end in zip(starts, starts[1:] + [len(row) + 1]):
            order = row[i - 1] if i > 0 and row[i - 1].isdigit() else '0'
            pieces, length, ease, *rest = row[i + 1:end]
            rows[int(row[i][1:])] = SeamRow(int(order), tuple(map(int, pieces.split(' to '))), float(length),
                                            float(ease.removesuffix(' %')) / 100,
                                            next((t for t in rest if t in ('dart', 'edge', 'opening')), ''))
    return rows


def runs_backwards(a, b):
    """Does side b run against side a? By their match points; None where these leave it open."""
    numbers = sorted(set(a.matches) & set(b.matches), key=lambda n: a.matches[n])
    if a.closed and b.closed:
        order = [b.matches[n] for n in numbers]
        turns = sum(order[i] < order[i - 1] for i in range(len(order)))  # once around: one step down, or all but one
        return None if len(order) < 3 else turns > 1
    alike = [abs(a.matches[n] / a.arcs[-1] - b.matches[n] / b.arcs[-1]) for n in numbers]
    turned = [abs(a.matches[n] / a.arcs[-1] - 1 + b.matches[n] / b.arcs[-1]) for n in numbers]
    if not numbers or abs(sum(alike) - sum(turned)) < 0.1:
        return None
    return sum(turned) < sum(alike)


class Sewn:
    """The pieces with all seams closed."""

    def __init__(self, seams):
        self.seams = seams
        self.parent = {}
        self.backwards = {}  # (seam, side) -> does it run against the seam's first side?
        for sides in seams.values():
            for side in sides:
                for p in side.points:
                    self.parent.setdefault((side.piece, *p), (side.piece, *p))
        for number, sides in seams.items():
            for k, side in enumerate(sides[1:], 1):
                assert len(side.points) == len(sides[0].points), f'S{number}: another number of points on each side'
                back = runs_backwards(sides[0], side)
                assert back is not None, f'S{number} could be sewn in backwards'
                self.backwards[number, k] = back
                for p, q in zip(sides[0].points, side.points[::-1] if back else side.points):
                    self.parent[self._find((side.piece, *q))] = self._find((sides[0].piece, *p))

    def _find(self, point):
        while self.parent[point] != point:
            self.parent[point] = self.parent[self.parent[point]]
            point = self.parent[point]
        return point

    def mismatch(self, number):
        """(of the whole seam's length, at its match points), each as a share of the longer side."""
        lengths = [side.arcs[-1] for side in self.seams[number]]
        longest = max(lengths)
        first = self.seams[number][0]
        off = [0.0]
        for k, side in enumerate(self.seams[number][1:], 1):
            for n, arc in first.matches.items():
                there = side.arcs[-1] - side.matches[n] if self.backwards[number, k] else side.matches[n]
                apart = abs(arc - there)
                off.append(min(apart, abs(apart - longest)) if first.closed and side.closed else apart)
        return (longest - min(lengths)) / longest, max(off) / longest

    def loops(self):
        """{piece: [loop]}: the stretches of each piece, chained to closed outlines."""
        loops = {}
        by_start = {}
        for number, sides in self.seams.items():
            for k, side in enumerate(sides):
                by_start.setdefault((side.piece, *side.points[0]), []).append((number, k))
        while by_start:
            start = key = next(iter(by_start))
            loop = []
            while True:
                assert key in by_start, f'the outline of piece {key[0]} has a gap at {key[1:]}'
                number, k = by_start[key].pop()
                if not by_start[key]:
                    del by_start[key]
                points = self.seams[number][k].points
                loop.append(points[:-1])
                key = (start[0], *points[-1])
                if key == start:
                    break
            loops.setdefault(start[0], []).append(np.vstack(loop))
        return loops

    def euler(self):
        """Vertices - edges + faces of the closed surface."""
        vertices = len({self._find(point) for point in self.parent})
        edges = sum(len(sides[0].points) - 1 for sides in self.seams.values())
        return vertices - edges + sum(2 - len(loops) for loops in self.loops().values())
