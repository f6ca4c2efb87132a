#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Flattening against libigl's SLIM on the same charts, one thread, in one command:

    python benchmarks/flatten.py [--models DIR] [--tool FLATTEN_TOOL] [--no-slim]

Needs numpy and libigl (pip install numpy libigl) and the program flatten_tool (cmake -DDCHARTS_BUILD_BENCHMARKS=ON).
SLIM makes 20 iterations of the symmetric Dirichlet energy from Tutte's embedding in a circle. Both results are measured
by the same lines here: L2 and Linf stretch with the UV area scaled to the surface area. Triangles whose area is rounding
noise (below 1e-14 of the squared bounding box diagonal) count for neither. Times are cpu seconds without reading and
writing; SLIM's hold its start and its set-up, as ours do. Exit code 1 when a bound is missed."""

import argparse
import sys
import tempfile
import time
from pathlib import Path

from common import MODELS_DIR, ROOT, Bounds, read_charts, run_tool, write_mesh

import igl
import numpy as np

ITERATIONS = 20
# Model: seeds that lead near the chart count of the reference, that count, bound on the cpu seconds.
ATLASES = {
    "fandisk_9926": (7, 4, 0.15),
    "horse": (12, 12, 0.3),
    "gargoyle": (10, 10, 0.35),
    "feline": (25, 25, 0.75),
    "bunny": (10, 10, 1.7),
}
ONE_CHART_MODELS = ("fandisk_9926", "horse", "gargoyle", "bunny")
LARGE_CHART_SECONDS = 8
MANY_FACES = 5000  # up to here a third of SLIM's time, above half of it


def read_flat(path):
    """Per chart: UVs or None, cpu seconds."""
    data, at, flat = path.read_bytes(), 0, []
    while at < len(data):
        ok, vertices = np.frombuffer(data, np.int32, 2, at)
        seconds = np.frombuffer(data, np.float64, 1, at + 8)[0]
        uv = np.frombuffer(data, np.float64, 2 * vertices, at + 16).reshape(-1, 2)
        at += 16 + uv.nbytes
        flat.append((uv if ok else None, seconds))
    return flat


def stretch(vertices, faces, uv):
    """L2 and Linf stretch, number of flipped triangles."""
    if uv is None:
        return np.inf, np.inf, len(faces)
    p, q = vertices[faces], uv[faces]
    e, f = p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]
    area = np.linalg.norm(np.cross(e, f), axis=1) / 2
    counts = area > 1e-14 * np.sum(np.ptp(vertices, axis=0) ** 2)
    a, b = q[:, 1] - q[:, 0], q[:, 2] - q[:, 0]
    determinant = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
    flipped = int(np.sum(~(determinant > 0)))
    if np.any(~(determinant[counts] > 0)):
        return np.inf, np.inf, flipped
    e, f, a, b, d, area = (x[counts] for x in (e, f, a, b, determinant, area))
    du = (e * b[:, 1:2] - f * a[:, 1:2]) / d[:, None]
    dv = (f * a[:, 0:1] - e * b[:, 0:1]) / d[:, None]
    uu, uw, ww = np.sum(du * du, 1), np.sum(du * dv, 1), np.sum(dv * dv, 1)
    mean = (uu + ww) / 2
    scale = np.sum(d / 2) / np.sum(area)
    l2 = np.sqrt(np.sum(area * mean) / np.sum(area) * scale)
    linf = np.sqrt(np.max(mean + np.hypot((uu - ww) / 2, uw)) * scale)
    return l2, linf, flipped


def longest_loop(vertices, faces):
    """The longest boundary loop, in order, and the other loops."""
    edges = np.vstack([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]).astype(np.int64)
    key = edges[:, 0] * len(vertices) + edges[:, 1]
    border = edges[~np.isin(edges[:, 1] * len(vertices) + edges[:, 0], key)]
    after, loops = dict(border.tolist()), []
    while after:
        loop = [next(iter(after))]
        while (v := after.pop(loop[-1])) != loop[0]:
            loop.append(v)
        loops.append(np.array(loop))
    lengths = [np.linalg.norm(vertices[loop] - vertices[np.roll(loop, -1)], axis=1).sum() for loop in loops]
    longest = int(np.argmax(lengths))
    return loops[longest], loops[:longest] + loops[longest + 1 :]


def slim(vertices, faces):
    """UVs or None, cpu seconds."""
    loop, holes = longest_loop(vertices, faces)
    # Holes are filled by fans for the start only.
    filled, count = [faces], len(vertices)
    for hole in holes:
        filled.append(np.column_stack([np.roll(hole, -1), hole, np.full(len(hole), count)]))
        count += 1
    start = time.process_time()
    try:
        circle = igl.map_vertices_to_circle(np.asfortranarray(vertices), loop.astype(np.int32))
        every = np.vstack(filled)
        corners = np.array([[0, 1], [1, 2], [2, 0]])
        pairs = np.unique(np.sort(every[:, corners].reshape(-1, 2), axis=1), axis=0)
        uv = tutte(count, pairs, loop, circle)[: len(vertices)]
        area = np.linalg.norm(np.cross(vertices[faces[:, 1]] - vertices[faces[:, 0]],
                                       vertices[faces[:, 2]] - vertices[faces[:, 0]]), axis=1).sum() / 2
        uv *= np.sqrt(area / np.pi)
        data = igl.slim_precompute(np.asfortranarray(vertices), np.asfortranarray(faces), np.asfortranarray(uv),
                                   igl.MappingEnergyType.SYMMETRIC_DIRICHLET, np.zeros(0, np.int32),
                                   np.zeros((0, 2), order="F"), 0.0)
        uv = np.asarray(igl.slim_solve(data, ITERATIONS))[:, :2]
    except Exception as error:  # whatever the peer says
        print(f"    SLIM: {error}")
        return None, time.process_time() - start
    return (uv if np.all(np.isfinite(uv)) else None), time.process_time() - start


def tutte(count, pairs, loop, circle):
    from scipy.sparse import coo_matrix, diags
    from scipy.sparse.linalg import spsolve

    rows = np.concatenate([pairs[:, 0], pairs[:, 1]])
    columns = np.concatenate([pairs[:, 1], pairs[:, 0]])
    graph = coo_matrix((np.ones(len(rows)), (rows, columns)), shape=(count, count)).tocsr()
    laplacian = (diags(np.asarray(graph.sum(axis=1)).ravel()) - graph).tocsc()
    inner = np.setdiff1d(np.arange(count), loop)
    uv = np.zeros((count, 2))
    uv[loop] = circle
    if len(inner):
        system = laplacian[inner][:, inner].tocsc()
        uv[inner] = spsolve(system, -(laplacian[inner][:, loop] @ circle), permc_spec="MMD_AT_PLUS_A")
    return uv


def grid_chart(quads, surface):
    """A square grid of quads, alternately cut, mapped by surface(x, y) with x and y in [-1, 1]."""
    x, y = np.meshgrid(np.linspace(-1, 1, quads + 1), np.linspace(-1, 1, quads + 1), indexing="ij")
    vertices = np.stack(surface(x.ravel(), y.ravel()), axis=1)
    i, j = np.meshgrid(np.arange(quads), np.arange(quads), indexing="ij")
    a = (i * (quads + 1) + j).ravel()
    b, c, d = a + quads + 1, a + quads + 2, a + 1
    even = ((i + j) % 2 == 0).ravel()[:, None]
    one = np.where(even, np.stack([a, b, d], 1), np.stack([a, b, c], 1))
    two = np.where(even, np.stack([b, c, d], 1), np.stack([a, c, d], 1))
    return vertices, np.vstack([one, two]).astype(np.int32)


def cap(opening):
    """A unit sphere from its pole down to the angle `opening`."""

    def surface(a, b):
        u, v = a * np.sqrt(1 - b * b / 2), b * np.sqrt(1 - a * a / 2)
        r = np.hypot(u, v)
        sine = np.where(r > 0, np.sin(r * opening) / np.where(r > 0, r, 1), opening)
        return u * sine, v * sine, np.cos(r * opening)

    return surface


def hills(x, y):
    return x, y, 0.25 * np.sin(4 * x) * np.cos(3 * y) + 0.03 * np.sin(17 * x + 5 * y)


def shape_cases():
    yield "hills", grid_chart(22, hills)
    yield "hemisphere", grid_chart(22, cap(np.pi / 2))
    yield "hills", grid_chart(45, hills)
    yield "hemisphere", grid_chart(100, cap(np.pi / 2))
    yield "deep cap", grid_chart(100, cap(2.2))
    yield "hills", grid_chart(187, hills)
    yield "hemisphere", grid_chart(187, cap(np.pi / 2))


def split_in_four(vertices, faces):
    edges, which = np.unique(np.sort(faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1), axis=0, return_inverse=True)
    middle = which.reshape(-1, 3) + len(vertices)
    a, b, c = faces.T
    ab, bc, ca = middle.T
    four = [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
    return (np.vstack([vertices, vertices[edges].mean(axis=1)]),
            np.vstack([np.column_stack(corners) for corners in four]).astype(np.int32))


def cut_once(vertices, faces):
    """A chart out of a whole surface without handles: opened along one path between two vertices far from each other,
    or, when it has holes, from the largest of them to the vertex farthest away."""
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import dijkstra

    edges = np.unique(np.sort(faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1), axis=0)
    lengths = np.linalg.norm(vertices[edges[:, 0]] - vertices[edges[:, 1]], axis=1)
    graph = coo_matrix((lengths, (edges[:, 0], edges[:, 1])), shape=(len(vertices),) * 2).tocsr()
    sides = np.vstack([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]).astype(np.int64)
    closed = np.isin(sides[:, 1] * len(vertices) + sides[:, 0], sides[:, 0] * len(vertices) + sides[:, 1]).all()
    if closed:
        start = [int(np.argmax(dijkstra(graph, directed=False, indices=0)))]
    else:
        start = longest_loop(vertices, faces)[0]
    distance, before, _ = dijkstra(graph, directed=False, indices=start, min_only=True, return_predecessors=True)
    path = [int(np.argmax(distance))]
    while before[path[-1]] >= 0:
        path.append(int(before[path[-1]]))

    # Fans of triangles that hang together around a vertex of the path without crossing it get a vertex each.
    crossed = {frozenset(step) for step in zip(path, path[1:])}
    of_vertex = {v: [] for v in path}
    for t, face in enumerate(faces.tolist()):
        for v in face:
            if v in of_vertex:
                of_vertex[v].append(t)
    points, opened = [vertices], faces.copy()
    count = len(vertices)
    for v in path:
        fans = {t: t for t in of_vertex[v]}

        def root(t):
            while fans[t] != t:
                t = fans[t]
            return t

        across = {}
        for t in of_vertex[v]:
            for w in faces[t].tolist():
                if w != v and frozenset((v, w)) not in crossed:
                    fans[root(t)] = root(across.setdefault(w, t))
        for number, fan in enumerate(sorted({root(t) for t in fans})):
            if number == 0:
                continue
            for t in of_vertex[v]:
                if root(t) == fan:
                    opened[t][faces[t] == v] = count
            points.append(vertices[v : v + 1])
            count += 1
    return np.vstack(points), opened


def flatten(tool, folder, charts, method="flatten"):
    source, out = folder / "in.charts", folder / "out.uv"
    with open(source, "wb") as joined:
        for vertices, faces in charts:
            write_mesh(folder / "one", vertices, faces)
            joined.write((folder / "one").read_bytes())
    run_tool(tool, method, source, out)
    return read_flat(out)


def compare(name, chart, ours, bounds, with_slim):
    vertices, faces = chart
    uv, seconds = ours
    l2, linf, flips = stretch(vertices, faces, uv)
    line = f"  {name:22} {len(faces):6} faces  L2 {l2:.5f}  Linf {linf:8.4f}  {seconds:7.4f} s  {flips} flips"
    bounds.check(f"{name}, {len(faces)} faces: flips", flips == 0)
    if with_slim:
        slim_uv, slim_seconds = slim(vertices, faces)
        slim_l2, slim_linf, slim_flips = stretch(vertices, faces, slim_uv)
        share = 1 / 3 if len(faces) <= MANY_FACES else 1 / 2
        where = f"{name}, {len(faces)} faces"
        tiny = 1e-7  # what is isometric is so for both
        verdicts = [
            bounds.check(f"{where}: L2 {l2:.7f} above SLIM's {slim_l2:.7f}", l2 <= slim_l2 + tiny),
            bounds.check(f"{where}: Linf {linf:.5f} not below SLIM's {slim_linf:.5f}",
                         linf < slim_linf or linf - 1 < tiny),
            bounds.check(f"{where}: {seconds / slim_seconds:.2f} of SLIM's time", seconds <= share * slim_seconds),
        ]
        line += (f" | SLIM {slim_l2:.5f} {slim_linf:8.4f} {slim_seconds:7.4f} s {slim_flips} flips"
                 f" | time ratio {seconds / slim_seconds:.2f} | L2, Linf, time hold: {' '.join(verdicts)}")
    print(line, flush=True)
    return l2, linf


def atlas(name, models, tool, folder, bounds, with_slim, by_target):
    seeds, wanted, limit = ATLASES[name]
    if by_target:
        charts, origin = charts_of(models / f"{name}.ply", wanted, tool, folder, "target"), f"target_charts {wanted}"
    else:
        charts, origin = charts_of(models / f"{name}.ply", seeds, tool, folder), f"the paper's stages from {seeds} seeds"
    flat = flatten(tool, folder, charts)
    print(f"{name}: {len(charts)} charts (reference {wanted}), by {origin}")
    squares, total_area, worst = 0.0, 0.0, 0.0
    for i, (chart, ours) in enumerate(zip(charts, flat)):
        l2, linf = compare(f"{name} {i}", chart, ours, bounds, with_slim)
        p = chart[0][chart[1]]
        area = np.linalg.norm(np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), axis=1).sum() / 2
        squares += l2 * l2 * area
        total_area += area
        worst = max(worst, linf)
    seconds = sum(s for _, s in flat)
    holds = bounds.check(f"{name}: {seconds:.3f} s in all", seconds < limit)
    print(f"  all: L2 {np.sqrt(squares / total_area):.5f}  Linf {worst:.4f}  {seconds:.3f} s, bound {limit} s: {holds}")


def charts_of(path, number, tool, folder, how="charts"):
    """The charts of a model: by the paper's stages from a number of seeds, or with how="target" that many charts."""
    vertices, faces = igl.read_triangle_mesh(str(path))[:2]
    write_mesh(folder / "mesh", vertices, faces)
    run_tool(tool, how, folder / "mesh", folder / "charts", number)
    return read_charts(folder / "charts")


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--models", type=Path, default=MODELS_DIR)
    options.add_argument("--tool", type=Path, default=ROOT / "build" / "benchmarks" / "flatten_tool")
    options.add_argument("--no-slim", action="store_true", help="our figures only")
    options = options.parse_args()
    if not options.tool.exists():
        sys.exit(f"{options.tool} is not there: configure with -DDCHARTS_BUILD_BENCHMARKS=ON and build it, "
                 "or give its place with --tool.")
    bounds = Bounds()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        if options.models.is_dir():
            for by_target in (False, True):
                for model in ATLASES:
                    atlas(model, options.models, options.tool, folder, bounds, not options.no_slim, by_target)
        else:
            print(f"{options.models} is not there: skipped the five models and the charts made of them.")
        print("one-chart cases")
        cases = list(shape_cases())
        if options.models.is_dir():
            for model in ONE_CHART_MODELS:
                charts = charts_of(options.models / f"{model}.ply", 1, options.tool, folder)
                cases += [(f"{model} from one seed", chart) for chart in charts]
            horse = igl.read_triangle_mesh(str(options.models / "horse.ply"))[:2]
            cases.append(("horse in four, one cut", cut_once(*split_in_four(*horse))))
            cases.append(("bunny, one cut", cut_once(*igl.read_triangle_mesh(str(options.models / "bunny.ply"))[:2])))
        for (case, chart), ours in zip(cases, flatten(options.tool, folder, [chart for _, chart in cases])):
            compare(case, chart, ours, bounds, not options.no_slim)
            if len(chart[1]) > 60000:
                seconds = ours[1]
                holds = bounds.check(f"{case}: {seconds:.2f} s", seconds < LARGE_CHART_SECONDS)
                print(f"    under {LARGE_CHART_SECONDS} s: {holds}")
    return bounds.report()


if __name__ == "__main__":
    sys.exit(main())
