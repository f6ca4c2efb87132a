#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Packing against xatlas's packer on the same flat charts, one thread, in one command:

    python benchmarks/packing.py [--models DIR] [--tool PACKING_TOOL] [--no-xatlas]

Needs numpy, libigl and xatlas (pip install numpy libigl xatlas) and the program packing_tool
(cmake -DDCHARTS_BUILD_BENCHMARKS=ON). The charts are those of our atlases, as flattened; xatlas gets them by add_uv_mesh
and packs them by brute force (more than 500 charts, which would take minutes: by its random placement) with rotation,
at the same resolution and padding and without its extra texel for bilinear filtering. Its atlas need not be square: both are
judged by their UV area over the bounding square of what they use, since a texture is square here. The closest distance
of two charts is measured by rasterizing, at 4 x 4 samples per texel. Times are cpu seconds of the packing alone. Exit
code 1 when a bound is missed."""

import argparse
import sys
import tempfile
import time
from pathlib import Path

from common import MODELS_DIR, ROOT, Bounds, read_charts, run_tool, write_mesh

import igl
import numpy as np

SIZE, PADDING = 1024, 2  # texels
SAMPLES = 4  # per texel, along each side
MOST_BY_FORCE = 500  # charts
RATIO = 1.05  # of xatlas's efficiency
# Name, file, seeds (0 = as many as it takes), charts wanted, least efficiency, most cpu seconds
ATLASES = (
    ("fandisk_9926", "fandisk_9926.ply", 0, 3, 0, 0.5),
    ("horse", "horse.ply", 0, 12, 0.60, 0.5),
    ("gargoyle", "gargoyle.ply", 0, 10, 0.60, 0.5),
    ("feline", "feline.ply", 0, 25, 0.60, 0.5),
    ("bunny", "bunny.ply", 0, 10, 0.60, 0.5),
    # The organic model with 30 charts is the horse; the other two are there to see how much depends on the charts.
    ("horse, 30", "horse.ply", 0, 30, 0.75, 0.5),
    ("bunny, 30", "bunny.ply", 0, 30, 0.60, 0.5),
    ("gargoyle, 30", "gargoyle.ply", 0, 30, 0.60, 0.5),
)


def polygons(count):
    """Random star-shaped polygons of very different sizes, as fans."""
    random, charts = np.random.default_rng(1), []
    for _ in range(count):
        corners = random.integers(5, 25)
        angle = (np.arange(corners) + 0.8 * random.random(corners)) / corners * 2 * np.pi
        radius = (0.5 + random.random(corners)) * np.exp(0.6 * random.normal())
        rim = np.column_stack([radius * np.cos(angle), radius * np.sin(angle), 0 * angle])
        k = np.arange(corners)
        charts.append((np.vstack([rim, np.zeros(3)]), np.column_stack([k, (k + 1) % corners, 0 * k + corners])))
    return charts


def border_edges(faces):
    edges = np.vstack([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]).astype(np.int64)
    count = faces.max() + 1
    return edges[~np.isin(edges[:, 1] * count + edges[:, 0], edges[:, 0] * count + edges[:, 1])]


def samples_inside(points, faces):
    """Rows and columns of the samples inside a flat chart; points in samples, sample (0, 0) is at (0.5, 0.5)."""
    a, b = points[border_edges(faces)].transpose(1, 0, 2)
    low, high = np.minimum(a[:, 1], b[:, 1]), np.maximum(a[:, 1], b[:, 1])
    first, after = np.ceil(low - 0.5).astype(int), np.ceil(high - 0.5).astype(int)
    edge = np.repeat(np.arange(len(a)), after - first)
    row = np.arange(len(edge)) - np.repeat(np.cumsum(after - first) - (after - first), after - first) + first[edge]
    t = (row + 0.5 - a[edge, 1]) / (b[edge, 1] - a[edge, 1])
    x = a[edge, 0] + t * (b[edge, 0] - a[edge, 0])
    order = np.lexsort((x, row))
    row, x = row[order][::2], np.ceil(x[order] - 0.5).astype(int)
    start, length = x[::2], x[1::2] - x[::2]
    offset = np.arange(length.sum()) - np.repeat(np.cumsum(length) - length, length)
    return np.repeat(row, length), np.repeat(start, length) + offset


def closest(charts, samples):
    """The least distance in texels of two charts, each (points in samples, faces); 0 when they share a sample."""
    owner = np.zeros((samples, samples), np.int32)
    for k, (points, faces) in enumerate(charts):
        row, column = samples_inside(points, faces)
        if np.any(owner[row, column]):
            return 0.0
        owner[row, column] = k + 1
    rim = np.zeros(owner.shape, bool)
    rim[1:] |= owner[1:] != owner[:-1]
    rim[:-1] |= owner[1:] != owner[:-1]
    rim[:, 1:] |= owner[:, 1:] != owner[:, :-1]
    rim[:, :-1] |= owner[:, 1:] != owner[:, :-1]
    row, column = np.nonzero(rim & (owner > 0))
    reach = (PADDING + 4) * SAMPLES
    steps = [(y, x) for y in range(reach + 1) for x in range(-reach, reach + 1) if y > 0 or x > 0]
    for y, x in sorted(steps, key=lambda step: np.hypot(*step)):
        other = owner[np.clip(row + y, 0, samples - 1), np.clip(column + x, 0, samples - 1)]
        if np.any((other > 0) & (other != owner[row, column])):
            return np.hypot(y, x) / SAMPLES
    return reach / SAMPLES


def judge(charts, texels):
    """Efficiency, closest distance in texels. `texels`: side of the texture, points in [0, 1]."""
    area, low, high = 0, np.full(2, np.inf), np.full(2, -np.inf)
    for points, faces in charts:
        p = points[faces]
        e, f = p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]
        area += np.abs(e[:, 0] * f[:, 1] - e[:, 1] * f[:, 0]).sum() / 2
        low, high = np.minimum(low, points.min(0)), np.maximum(high, points.max(0))
    samples = int(np.ceil(texels * SAMPLES)) + 1
    return area / (high - low).max() ** 2, closest([(SAMPLES * texels * p, f) for p, f in charts], samples)


def xatlas_packing(charts):
    import xatlas

    # It takes what shares a point for one chart: so side by side, in rows.
    step, columns = 1.1 * max(np.ptp(points, axis=0).max() for points, _ in charts), int(np.ceil(len(charts) ** 0.5))
    uv, faces, at = [], [], 0
    for k, (points, triangles) in enumerate(charts):
        uv.append(points - points.min(0) + step * np.array(divmod(k, columns)))
        faces.append(triangles + at)
        at += len(points)
    uv = np.vstack(uv)
    uv = uv * 1000 / np.ptp(uv, axis=0).max()  # its tolerances are absolute
    atlas = xatlas.Atlas()
    atlas.add_uv_mesh(uv.astype(np.float32), np.vstack(faces).astype(np.uint32))
    options = xatlas.PackOptions()
    options.bruteForce, options.rotate_charts, options.bilinear = len(charts) <= MOST_BY_FORCE, True, False
    options.padding, options.resolution = PADDING, SIZE
    start = time.process_time()
    atlas.generate(pack_options=options)
    seconds = time.process_time() - start
    if atlas.atlas_count != 1:
        sys.exit(f"xatlas made {atlas.atlas_count} textures.")
    mapping, triangles, packed = atlas[0]
    side = max(atlas.width, atlas.height)
    packed, ends, placed = packed * [atlas.width / side, atlas.height / side], 0, []
    for _, chart in charts:
        used, numbers = np.unique(triangles[ends : ends + len(chart)], return_inverse=True)
        placed.append((packed[used], numbers.reshape(-1, 3)))
        ends += len(chart)
    return placed, side, seconds


def compare(name, charts, options, folder, bounds, least, most_seconds):
    with open(folder / "flat", "wb") as joined:
        for points, faces in charts:
            write_mesh(folder / "one", points, faces)
            joined.write((folder / "one").read_bytes())
    words = run_tool(options.tool, "pack", folder / "flat", folder / "packed", SIZE, PADDING).split()
    seconds, padding = map(float, words)
    efficiency, distance = judge([(p[:, :2], f) for p, f in read_charts(folder / "packed")], SIZE)
    bounds.check(f"{name}: padding {padding}", padding == PADDING)
    bounds.check(f"{name}: charts {distance:.2f} texels apart", distance >= PADDING)
    bounds.check(f"{name}: efficiency {efficiency:.3f} below {least}", efficiency >= least)
    bounds.check(f"{name}: {seconds:.2f} s, bound {most_seconds} s", seconds < most_seconds)
    line = f"  {name:18} {len(charts):5} charts  {efficiency:.3f}  {distance:5.2f} texels  {seconds:6.2f} s"
    if not options.no_xatlas:
        placed, texels, peer_seconds = xatlas_packing([(p[:, :2], f) for p, f in charts])
        peer, peer_distance = judge(placed, texels)
        sound = peer_distance > 0
        if sound:
            bounds.check(f"{name}: {efficiency / peer:.3f} of xatlas's efficiency", efficiency >= RATIO * peer)
        line += (f" | xatlas {peer:.3f}  {peer_distance:5.2f} texels  {peer_seconds:6.2f} s, texture of {texels}"
                 f" | {f'ratio {efficiency / peer:.3f}' if sound else 'its charts overlap: not compared'}")
    print(line, flush=True)


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--models", type=Path, default=MODELS_DIR)
    options.add_argument("--tool", type=Path, default=ROOT / "build" / "benchmarks" / "packing_tool")
    options.add_argument("--no-xatlas", action="store_true", help="our figures only")
    options = options.parse_args()
    if not options.tool.exists():
        sys.exit(f"{options.tool} is not there: configure with -DDCHARTS_BUILD_BENCHMARKS=ON and build it, "
                 "or give its place with --tool.")
    bounds = Bounds()
    print("efficiency (UV area / bounding square), closest charts, cpu seconds")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for case, file, seeds, wanted, least, seconds in ATLASES:
            if not (options.models / file).exists():
                print(f"  {options.models / file} is not there: skipped.")
                continue
            vertices, faces = igl.read_triangle_mesh(str(options.models / file))[:2]
            write_mesh(folder / "mesh", vertices, faces)
            run_tool(options.tool, "charts", folder / "mesh", folder / "charts", seeds, wanted)
            compare(case, read_charts(folder / "charts"), options, folder, bounds, least, seconds)
        compare("polygons", polygons(3000), options, folder, bounds, 0, 10)
    return bounds.report()


if __name__ == "__main__":
    sys.exit(main())
