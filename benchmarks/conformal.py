#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Conformal flattening (ABF++) against libigl's LSCM and ARAP on the same charts, one thread, in one command:

    python benchmarks/conformal.py [--models DIR] [--tool FLATTEN_TOOL]

Needs numpy, scipy and libigl (pip install numpy scipy libigl) and the program flatten_tool
(cmake -DDCHARTS_BUILD_BENCHMARKS=ON). LSCM is pinned at two far vertices; ARAP starts from LSCM and makes 100
iterations. All are measured by the same lines: the mean squared difference of the corner angles (rad^2) over the triangles
whose area is more than rounding noise, L2 stretch, flipped triangles, cpu seconds. A mean over charts is weighted with their
faces. Exit code 1 when our angle error is above a peer's, or above 1e-6 on a developable chart, or a triangle is
flipped."""

import argparse
import sys
import tempfile
import time
from pathlib import Path

from common import MODELS_DIR, ROOT, Bounds
from flatten import ATLASES, cap, charts_of, flatten, grid_chart, hills, stretch

import igl
import numpy as np

ARAP_ITERATIONS = 100
DEVELOPABLE = 1e-6  # rad^2
NOISE = 1e-12  # rad^2: below it all are exact


def corner_angles(points):
    """Of triangles with corners points[:, 0..2]."""
    angles = []
    for k in range(3):
        a = points[:, (k + 1) % 3] - points[:, k]
        b = points[:, (k + 2) % 3] - points[:, k]
        angles.append(np.arctan2(np.linalg.norm(np.cross(a, b), axis=1), np.sum(a * b, 1)))
    return np.stack(angles, 1)


def angle_error(vertices, faces, uv):
    if uv is None:
        return np.inf
    p = vertices[faces]
    area = np.linalg.norm(np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), axis=1) / 2
    counts = area > 1e-14 * np.sum(np.ptp(vertices, axis=0) ** 2)
    flat = np.column_stack([uv, np.zeros(len(uv))])[faces]
    return np.mean((corner_angles(p[counts]) - corner_angles(flat[counts])) ** 2)


def timed(work, *arguments):
    start = time.process_time()
    try:
        uv = np.asarray(work(*arguments))[:, :2]
    except Exception as error:  # whatever the peer says
        print(f"    {work.__name__}: {error}")
        return None, time.process_time() - start
    return (uv if np.all(np.isfinite(uv)) else None), time.process_time() - start


def lscm(vertices, faces):
    first = int(np.argmax(np.linalg.norm(vertices - vertices[0], axis=1)))
    away = np.linalg.norm(vertices - vertices[first], axis=1)
    pins = np.array([first, int(np.argmax(away))], np.int64)
    places = np.array([[0.0, 0.0], [float(away.max()), 0.0]])
    return igl.lscm(np.ascontiguousarray(vertices), faces.astype(np.int64), pins, places)[0]


def arap(vertices, faces):
    start = lscm(vertices, faces)
    data = igl.ARAPData()
    data.max_iter = ARAP_ITERATIONS
    triangles = faces.astype(np.int64)
    # One vertex held: without it libigl's factorization may fail, the place being free.
    igl.arap_precomputation(np.ascontiguousarray(vertices), triangles, 2, np.zeros(1, np.int32), data)
    return igl.arap_solve(np.ascontiguousarray(start[:1]), data, np.ascontiguousarray(start))


def cylinder(x, y):
    x, y = x + 0.15 * np.sin(4 * x), y + 0.15 * np.sin(4 * y)
    return np.cos(2.5 * x), np.sin(2.5 * x), y


def cone(x, y):
    r = 1.3 + y + 0.15 * np.sin(4 * y)
    return r * np.cos(2.2 * x), r * np.sin(2.2 * x), 1.5 * r


def folded(x, y):
    return np.minimum(x, 0), y, np.maximum(x, 0)


def with_hole(chart):
    vertices, faces = chart
    centre = vertices[faces].mean(axis=1)
    faces = faces[np.hypot(centre[:, 0] - 0.1, centre[:, 1]) > 0.4]
    used, faces = np.unique(faces, return_inverse=True)
    return vertices[used], faces.reshape(-1, 3).astype(np.int32)


def compare(case, chart, ours, bounds, developable):
    """Prints one line; returns our angle error and L2 stretch and those of the peers."""
    vertices, faces = chart
    results = [("ABF++", ours), ("LSCM", timed(lscm, *chart)), ("ARAP", timed(arap, *chart))]
    line, figures = f"  {case:20} {len(faces):6} faces", []
    for name, (uv, seconds) in results:
        l2, _, flips = stretch(vertices, faces, uv)
        error = angle_error(vertices, faces, uv)
        figures.append((error, l2))
        line += f" | {name} {error:.3e} rad^2  L2 {l2:8.5f}  {seconds:7.4f} s  {flips} flips"
        if name == "ABF++":
            bounds.check(f"{case}: {flips} flips", flips == 0)
        else:
            bounds.check(f"{case}: angle error {figures[0][0]:.3e} above {name}'s {error:.3e}",
                         figures[0][0] <= max(error, NOISE))
    if developable:
        bounds.check(f"{case}: angle error {figures[0][0]:.3e} though developable", figures[0][0] <= DEVELOPABLE)
    print(line, flush=True)
    return figures


def run(cases, options, folder, bounds, developable=False):
    rows, weights = [], []
    all_ours = flatten(options.tool, folder, [chart for _, chart in cases], "conformal")
    for (case, chart), ours in zip(cases, all_ours):
        rows.append(compare(case, chart, ours, bounds, developable))
        weights.append(len(chart[1]))
    return rows, weights


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--models", type=Path, default=MODELS_DIR)
    options.add_argument("--tool", type=Path, default=ROOT / "build" / "benchmarks" / "flatten_tool")
    options = options.parse_args()
    if not options.tool.exists():
        sys.exit(f"{options.tool} is not there: configure with -DDCHARTS_BUILD_BENCHMARKS=ON and build it, "
                 "or give its place with --tool.")
    bounds = Bounds()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        print("developable charts")
        run([("cylinder", grid_chart(40, cylinder)), ("cone", grid_chart(40, cone)),
             ("folded sheet", grid_chart(40, folded)),
             ("plane with a hole", with_hole(grid_chart(40, lambda x, y: (x, y, 0 * x))))],
            options, folder, bounds, developable=True)
        print("curved charts")
        run([("hills", grid_chart(45, hills)), ("hemisphere", grid_chart(45, cap(np.pi / 2))),
             ("deep cap", grid_chart(45, cap(2.2)))], options, folder, bounds)
        for model, (seeds, _, _) in ATLASES.items() if options.models.is_dir() else ():
            charts = charts_of(options.models / f"{model}.ply", seeds, options.tool, folder)
            print(f"{model}: {len(charts)} charts")
            rows, weights = run([(f"{model} {i}", chart) for i, chart in enumerate(charts)], options, folder, bounds)
            for peer, figures in zip(("ABF++", "LSCM", "ARAP"), np.transpose(rows, (1, 2, 0))):
                means = [np.average(figure, weights=weights) for figure in figures]
                print(f"  all {peer}: {means[0]:.3e} rad^2, L2 {means[1]:.5f}")
        if not options.models.is_dir():
            print(f"{options.models} is not there: skipped the five models.")
    return bounds.report()


if __name__ == "__main__":
    sys.exit(main())
