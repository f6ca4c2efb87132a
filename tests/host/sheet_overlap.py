# SPDX-License-Identifier: GPL-3.0-or-later
"""What lies on what on the sheet of a pattern's SVG, computed exactly: the file's numbers have four decimals, so they
are whole numbers of 1e-4 mm, and so are all intermediate results."""
import re
import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass, field

import numpy as np

from pattern_files import SVG

UNIT = 10000  # per mm
ASCENT, DESCENT = 0.73, 0.22  # of the font size, above and below the baseline
NAME_LINES = r'Piece \d+|cut \d+( \+ \d+ mirrored)?|right side|outside'


@dataclass
class Group:
    """A piece, or what else is on the sheet. Lines are arrays of points; a closed one ends where it began."""
    name: str
    is_piece: bool
    lines: dict = field(default_factory=dict)  # layer -> [points]
    seams: list = field(default_factory=list)  # the seam of each line of lines['stitch']
    tab_folds: list = field(default_factory=list)
    labels: list = field(default_factory=list)  # (text, corners of its box, counterclockwise or clockwise)


def _integers(numbers):
    return np.rint(np.array(numbers, float) * UNIT).astype(np.int64)


def _points(path):
    points = _integers(re.findall(r'-?[\d.]+', path.get('d'))).reshape(-1, 2)
    return np.vstack([points, points[:1]]) if path.get('d').endswith('Z') else points


def _box(text):
    x, y = map(float, re.match(r'translate\(([-\d.]+),([-\d.]+)\)', text.get('transform')).groups())
    turn = re.search(r'rotate\(([-\d.]+)\)', text.get('transform'))
    angle = np.radians(float(turn[1])) if turn else 0.0
    size, half = float(text.get('font-size')), float(text.get('textLength')) / 2
    along, down = np.array([np.cos(angle), np.sin(angle)]), np.array([-np.sin(angle), np.cos(angle)])
    corners = [(x, y) + s * half * along + t * size * down for s, t in ((-1, DESCENT), (1, DESCENT), (1, -ASCENT), (-1, -ASCENT))]
    return _integers(corners)


def read_groups(path):
    root = ElementTree.parse(path).getroot()
    groups = []
    for node in root.findall(f'{SVG}g'):
        group = Group(node.get('id'), node.get('class') == 'piece')
        for layer in node.findall(f'{SVG}g'):
            paths = layer.findall(f'{SVG}path')
            group.lines[layer.get('class')] = [_points(p) for p in paths]
            if layer.get('class') == 'stitch':
                group.seams = [int(p.get('data-seam', 0)) for p in paths]
            if layer.get('class') == 'fold':
                ruling = [p.get('stroke-dasharray') is None for p in paths]
                tab = [not r and p.get('data-angle') is None for p, r in zip(paths, ruling)]
                lines = group.lines.pop('fold')
                group.lines['ruling'] = [line for line, r in zip(lines, ruling) if r]
                group.lines['fold'] = [line for line, r, t in zip(lines, ruling, tab) if not r and not t]
                group.tab_folds = [line for line, t in zip(lines, tab) if t]
            group.labels += [(t.text, _box(t)) for t in layer.findall(f'{SVG}text')]
        groups.append(group)
    return groups


def segments(lines):
    """#S by 4."""
    parts = [np.hstack([line[:-1], line[1:]]) for line in lines if len(line) > 1]
    return np.vstack(parts) if parts else np.empty((0, 4), np.int64)


def _side(a, b, p):
    """Sign: on which side of the line from a to b the point p is."""
    return np.sign((b[:, 0] - a[:, 0]) * (p[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (p[:, 0] - a[:, 0]))


def touching(s, t):
    """Pairs (i, j): segment s[i] and segment t[j] have a point in common."""
    found = []
    low = np.minimum(t[:, :2], t[:, 2:]), np.maximum(t[:, :2], t[:, 2:])
    block = max(1, 4_000_000 // max(1, len(t)))
    for begin in range(0, len(s), block):
        part = s[begin:begin + block]
        near = np.ones((len(part), len(t)), bool)
        for d in (0, 1):
            near &= np.minimum(part[:, d], part[:, d + 2])[:, None] <= low[1][None, :, d]
            near &= np.maximum(part[:, d], part[:, d + 2])[:, None] >= low[0][None, :, d]
        i, j = np.nonzero(near)
        a, b, c, d = part[i, :2], part[i, 2:], t[j, :2], t[j, 2:]
        # Boxes touch, and neither segment is wholly on one side of the other's line.
        hit = (_side(a, b, c) * _side(a, b, d) <= 0) & (_side(c, d, a) * _side(c, d, b) <= 0)
        found.append(np.column_stack([i[hit] + begin, j[hit]]))
    return np.vstack(found) if found else np.empty((0, 2), int)


def inside(point, loops):
    """Is a point within closed loops, even-odd?"""
    edges = segments(loops)
    a, b = edges[:, :2], edges[:, 2:]
    crosses = (a[:, 1] > point[1]) != (b[:, 1] > point[1])
    a, b = a[crosses], b[crosses]
    side = _side(a, b, np.broadcast_to(point, a.shape))
    return bool(np.count_nonzero(np.where(b[:, 1] > a[:, 1], side > 0, side < 0)) % 2)


def _closed(corners):
    return np.vstack([corners, corners[:1]])


def _loops_touch(loop, other):
    """Do the areas of two closed lines have anything in common?"""
    return len(touching(segments([loop]), segments([other]))) > 0 or inside(loop[0], [other]) or inside(other[0], [loop])


def crossing_cuts(groups):
    """Sentences: cut lines that touch another, or themselves, and pieces within others."""
    pieces = [g for g in groups if g.is_piece]
    loops = [(g.name, line) for g in pieces for line in g.lines['cut']]
    edges = segments([line for _, line in loops])
    owner = np.repeat(np.arange(len(loops)), [len(line) - 1 for _, line in loops])
    first = np.cumsum([0] + [len(line) - 1 for _, line in loops])
    flaws = set()
    for i, j in touching(edges, edges):
        if i >= j:
            continue
        a, b = owner[i], owner[j]
        count = first[a + 1] - first[a]
        if a == b and (j - i == 1 or j - i == count - 1):  # neighbours share a point
            continue
        flaws.add(f'{loops[a][0]}: its cut line touches ' + ('itself' if a == b else f'one of {loops[b][0]}'))
    for g in pieces:
        for other in pieces:
            if other is not g and inside(g.lines['cut'][0][0], other.lines['cut']):
                flaws.add(f'{g.name} lies on {other.name}')
    return sorted(flaws)


def nets_beyond_cuts(groups, allowance):
    """Sentences: stitch lines that are not within the cut line by the allowance (mm), and cut lines that are far away:
    corners down to 60 degrees keep their full mitre."""
    flaws = []
    for g in groups:
        if not g.is_piece:
            continue
        cut, sewn = segments(g.lines['cut']), segments(g.lines['stitch'])
        if len(touching(sewn, cut)) or not inside(sewn[0, :2], g.lines['cut']):
            flaws.append(f'{g.name}: its stitch line is beyond the cut line')
        nearest = min(_distance(p, cut) for p in sewn[:, :2])
        if nearest < (allowance - 0.01) * UNIT:
            flaws.append(f'{g.name}: its allowance is {nearest / UNIT:.3f} mm')
        farthest = max(_distance(p, sewn) for p in cut[:, :2])
        if farthest > (2 * allowance + 0.05) * UNIT:
            flaws.append(f'{g.name}: its cut line is {farthest / UNIT:.3f} mm from the stitch line')
    return flaws


def doubled_allowances(groups, allowance):
    """Sentences: where a piece comes so near to itself that there is no room for the allowance (mm). At a corner of
    the outline that is so, and within a dart."""
    flaws = []
    local = 10 * allowance * UNIT  # along the outline
    for g in groups:
        if not g.is_piece:
            continue
        for loop, seams in _chained(g.lines['stitch'], g.seams):
            edges = segments([loop]).astype(float)
            lengths = np.linalg.norm(edges[:, 2:] - edges[:, :2], axis=1)
            start = np.concatenate([[0], np.cumsum(lengths)[:-1]])
            whole = lengths.sum()
            for k, point in enumerate(loop[:-1]):
                along = np.abs(start + lengths / 2 - start[k])
                far = np.minimum(along, whole - along) - lengths / 2 > local
                others = far & (np.array(seams) != seams[k]) & (np.array(seams) != seams[k - 1])
                if others.any() and _distance(point, edges[others]) < allowance * UNIT:
                    inwards = edges[others]
                    other = np.array(seams)[others][np.argmin([_distance(point, e[None]) for e in inwards])]
                    flaws.append(f'{g.name}: S{seams[k]} and S{other} are nearer than the allowance at {point / UNIT}')
    return flaws


def _chained(lines, seams):
    """Closed loops of stretches that follow each other: [(points, the seam of each edge)]."""
    left = list(zip(lines, seams))
    while left:
        line, seam = left.pop(0)
        loop, of_edges = [line], [seam] * (len(line) - 1)
        while not np.array_equal(loop[-1][-1], loop[0][0]):
            k = next(i for i, (other, _) in enumerate(left) if np.array_equal(other[0], loop[-1][-1]))
            line, seam = left.pop(k)
            loop.append(line[1:])
            of_edges += [seam] * (len(line) - 1)
        yield np.vstack(loop), of_edges


def _distance(point, edges):
    a, way = edges[:, :2].astype(float), (edges[:, 2:] - edges[:, :2]).astype(float)
    t = np.clip(((point - a) * way).sum(axis=1) / np.maximum((way**2).sum(axis=1), 1e-300), 0, 1)
    return np.linalg.norm(a + t[:, None] * way - point, axis=1).min()


def _with_points_on_it(loop, points, close):
    """A closed loop, with those points put in that lie on it between its corners."""
    result = []
    for a, b in zip(loop, np.roll(loop, -1, axis=0)):
        way = (b - a).astype(float)
        between = [p for p in points if min(np.abs(p - a).max(), np.abs(p - b).max()) >= close and
                   _distance(p, np.array([[*a, *b]])) < close]
        result += [a] + sorted(between, key=lambda p: (p - a) @ way)
    return np.array(result)


def merged_tabs(groups):
    """Sentences: tabs of a piece that run into each other or into the piece. Where the cut line leaves the net there
    must be one tab, from fold end to fold end."""
    flaws = []
    close = 0.002 * UNIT
    for g in groups:
        if not g.is_piece:
            continue
        net = segments(g.lines['net'])
        tabs = 0
        for loop in g.lines['cut']:
            loop = _with_points_on_it(loop[:-1], [end for fold in g.tab_folds for end in fold[[0, -1]]], close)
            on_net = np.array([_distance(p, net) < close for p in loop])
            if not on_net.any():
                flaws.append(f'{g.name}: a cut line has nothing of the net')
                continue
            start = int(np.argmax(on_net))
            loop, on_net = np.roll(loop, -start, axis=0), np.roll(on_net, -start)
            loop, on_net = np.vstack([loop, loop[:1]]), np.append(on_net, True)
            stays = np.nonzero(on_net)[0]
            for i, j in zip(stays, stays[1:]):
                if j - i == 1 and _distance((loop[i] + loop[j]) / 2, net) < close:
                    continue
                ends = [f for f in g.tab_folds if min(
                    np.abs(f[[0, -1]] - loop[[i, j]]).max(), np.abs(f[[-1, 0]] - loop[[i, j]]).max()) < close]
                tabs += 1
                if len(ends) != 1:
                    flaws.append(f'{g.name}: {len(ends)} tabs between {loop[i] / UNIT} and {loop[j] / UNIT}')
        if tabs != len(g.tab_folds):
            flaws.append(f'{g.name}: {len(g.tab_folds)} tabs have folds, but {tabs} are at the cut line')
    return flaws


def covered_labels(groups):
    """Sentences: labels that touch a line or another label."""
    flaws = []
    names, boxes = [], []
    for g in groups:
        names += [f'{g.name}: "{text}"' for text, _ in g.labels]
        boxes += [_closed(box) for _, box in g.labels]
    lines, owners = [], []
    for g in groups:
        for layer, of_layer in g.lines.items():
            lines += of_layer
            owners += [f'a line "{layer}" of {g.name}'] * sum(len(line) - 1 for line in of_layer)
        lines += g.tab_folds
        owners += [f'a tab of {g.name}'] * sum(len(line) - 1 for line in g.tab_folds)
    of_lines, of_boxes = segments(lines), segments(boxes)
    flaws += [f'{names[i // 4]} is on {owners[j]}' for i, j in touching(of_boxes, of_lines)]
    for k, box in enumerate(boxes):  # lines within a box
        x, y = of_lines[:, 0], of_lines[:, 1]
        for j in np.nonzero((x > box[:, 0].min()) & (x < box[:, 0].max()) & (y > box[:, 1].min()) & (y < box[:, 1].max()))[0]:
            if inside(of_lines[j, :2], [box]):
                flaws.append(f'{names[k]} is on {owners[j]}')
    low, high = np.array([b.min(axis=0) for b in boxes]), np.array([b.max(axis=0) for b in boxes])
    near = (low[:, None] <= high[None]).all(axis=2) & (high[:, None] >= low[None]).all(axis=2)
    for i, j in zip(*np.nonzero(np.triu(near, 1))):
        if _loops_touch(boxes[i], boxes[j]):
            flaws.append(f'{names[i]} is on {names[j]}')
    return sorted(set(flaws))


def _label_of(text, box, group):
    """The corners of the label that a text is of: a piece's name has three lines."""
    if not re.fullmatch(NAME_LINES, text):
        return box
    name = np.vstack([b for t, b in group.labels if re.fullmatch(NAME_LINES, t)])
    (left, top), (right, bottom) = name.min(axis=0), name.max(axis=0)
    return np.array([(left, top), (right, top), (right, bottom), (left, bottom)])


def stray_labels(groups):
    """Sentences: labels that are neither in their piece nor led to it, or that lie on another piece."""
    flaws = []
    pieces = [g for g in groups if g.is_piece]
    for g in pieces:
        leaders = g.lines.get('leader', [])
        edge = segments(g.lines['cut'])
        for text, box in g.labels:
            middle = (box[0] + box[2]) // 2
            if inside(middle, g.lines['cut']):
                continue
            ends = [(line[i], line[-1 - i]) for line in leaders for i in (0, -1)]
            if not any(_distance(near, segments([_closed(_label_of(text, box, g))])) < 0.6 * UNIT and
                       (inside(far, g.lines['cut']) or _distance(far, edge) < 1.5 * UNIT) for near, far in ends):
                flaws.append(f'{g.name}: "{text}" is not in the piece, and no line leads from it')
            flaws += [f'{g.name}: "{text}" is on {other.name}'
                      for other in pieces if other is not g and inside(middle, other.lines['cut'])]
    return flaws
