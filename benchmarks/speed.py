#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""How long it takes, in one command:

    python benchmarks/speed.py [--models DIR] [--only MODEL ...] [--no-xatlas] [--large] [--huge]

Needs the package (pip install .), numpy, scipy and xatlas. Every run is a process of its own: Texture Atlas without
parameters on 1 and on 2 threads, and xatlas with its defaults, on the models of the paper; Segment alone with 30 and with
300 charts. --large adds models of a million faces and more, made from these by subdivision, some with noise, and --huge one
of four million. Prints a table (Markdown) with cpu seconds, wall seconds, seconds per stage, the process's peak of memory
(with the host's), and the quality in the same row; then which bounds are missed, and exits with 1 when there are any. Atlases of
the paper's models are measured from outside by evaluate_atlas.py, those of the large ones by the filter itself."""

import argparse
import json
import os
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from common import MODELS_DIR, Bounds

import numpy as np
import pymeshlab

from meshes import noisy, save
from reference import GOALS, MODELS

THREADS = (1, 2)
SLOWEST = {"fandisk_9926": 3.0}  # times xatlas's cpu time
LARGE = (("bunny", 2, 0.0), ("horse", 3, 0.0), ("gargoyle", 3, 0.1), ("feline", 2, 0.05))  # times quartered, noise
HUGE = (("bunny", 3, 0.0),)
LARGE_SECONDS, LARGE_BYTES = 100.0, 3e9  # for a million faces
LEAST_GAIN = 1.6  # of two threads, from so many faces on:
MANY_FACES = 100000
MS_PER_ITERATION = 2.5  # of Lloyd, and 10,000 faces
STAGES = ("segment", "fill", "straighten", "merge", "cut", "parameterize", "measure")


def peak():
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024


def timed(work):
    cpu, wall = time.process_time(), time.perf_counter()
    result = work()
    return result, {"cpu": time.process_time() - cpu, "wall": time.perf_counter() - wall, "bytes": peak()}


def child_ours(mesh, out, parameters):
    import pymeshlab_dcharts  # noqa: F401 (adds the filters)

    ms = pymeshlab.MeshSet()
    ms.load_new_mesh(mesh)
    name = parameters.pop("filter", "dcharts_texture_atlas")
    figures, row = timed(lambda: ms.apply_filter(name, **parameters))
    ids = ms.current_mesh().face_scalar_array().round().astype(int)
    if out:
        ms.save_current_mesh(out, save_wedge_texcoord=True)
        np.save(out + ".npy", ids)
    plain = {k: float(v) for k, v in figures.items() if isinstance(v, (int, float))}
    return {**row, "figures": plain, "faces": len(ids)}


def child_xatlas(mesh, _out, _parameters):
    import xatlas

    ms = pymeshlab.MeshSet()
    ms.load_new_mesh(mesh)
    vertices, faces = ms.current_mesh().vertex_matrix(), ms.current_mesh().face_matrix()
    atlas = xatlas.Atlas()
    atlas.add_mesh(vertices.astype(np.float32), faces.astype(np.uint32))
    return {**timed(atlas.generate)[1], "figures": {"charts": atlas.chart_count}, "faces": len(faces)}


def run(kind, mesh, threads=1, out="", **parameters):
    """A process of its own: memory and threads are those of one run."""
    words = [sys.executable, __file__, "--child", kind, str(threads), str(mesh), str(out), json.dumps(parameters)]
    done = subprocess.run(words, stdout=subprocess.PIPE, text=True)
    if done.returncode:
        sys.exit(f"{kind} on {mesh} ended with {done.returncode}.")
    return json.loads(done.stdout.splitlines()[-1])


def subdivided(source, times, noise, folder):
    ms = pymeshlab.MeshSet()
    ms.load_new_mesh(str(source))
    ms.meshing_surface_subdivision_loop(iterations=times, threshold=pymeshlab.PercentageValue(0))
    vertices, faces = ms.current_mesh().vertex_matrix(), ms.current_mesh().face_matrix()
    if noise:
        vertices = noisy(vertices, faces, noise)
    return save(folder / f"{source.stem} x{4 ** times}{', noise' if noise else ''}.ply", vertices, faces)


COLUMNS = ("mesh", "faces", "", "charts", "L2", "Linf", "seam", "cpu s", "wall s", "wall s, 2 threads", " / ".join(STAGES) + " s",
           "us per face", "peak MB")


def show(cells):
    print("| " + " | ".join(str(cell or "") for cell in cells) + " |", flush=True)


def line(mesh, row, how, quality, second=None):
    figures = row["figures"]
    stages = " / ".join(f"{figures['seconds_' + s]:.2g}" for s in STAGES if "seconds_" + s in figures)
    charts, l2, linf, seam = quality
    cells = [mesh.stem, f"{row['faces']:,}", how, f"{charts:.0f}", l2 and f"{l2:.4f}", linf and f"{linf:.3f}",
             seam and f"{seam:.2f}", f"{row['cpu']:.2f}", f"{row['wall']:.2f}", second and f"{second['wall']:.2f}", stages,
             f"{1e6 * row['cpu'] / row['faces']:.0f}", f"{row['bytes'] / 1e6:.0f}"]
    show(cells)


def own_quality(figures):
    return [figures[key] for key in ("charts", "l2_stretch", "linf_stretch", "seam_length")]


def small(mesh, bounds, with_xatlas, folder):
    from atlases import Atlas

    out = folder / "atlas.obj"
    first, second = [run("ours", mesh, threads, out) for threads in THREADS]
    atlas = Atlas(out, mesh, np.load(f"{out}.npy"), first["cpu"])
    line(mesh, first, "ours", (atlas.charts, atlas.l2, atlas.linf, atlas.seam), second)
    bounds.check(f"{mesh.stem}: not sound: {', '.join(atlas.flaws)}", not atlas.flaws)
    most = GOALS[mesh.stem].automatic_charts
    bounds.check(f"{mesh.stem}: {atlas.charts} charts, more than {most}", atlas.charts <= most)
    if with_xatlas:
        peer = run("xatlas", mesh)
        line(mesh, peer, "xatlas", (peer["figures"]["charts"], None, None, None))
        ratio = first["cpu"] / peer["cpu"]
        bounds.check(f"{mesh.stem}: {ratio:.2f} times xatlas's cpu time", ratio <= SLOWEST.get(mesh.stem, 1.0))
    for charts in (30, 300):
        row = run("ours", mesh, filter="dcharts_segment", chart_count=charts)
        figures = row["figures"]
        ms = 1e3 * figures["seconds_segment"] / figures["iterations"] / (row["faces"] / 1e4)
        line(mesh, row, f"Segment, {charts}: {ms:.2f} ms per iteration and 10k faces", (figures["charts"], None, None, None))
        most_ms = MS_PER_ITERATION * (1.0 if charts == 30 else 1.5)
        bounds.check(f"{mesh.stem}: {ms:.2f} ms per iteration, {charts} charts", ms <= most_ms)


def large(mesh, bounds):
    first, second = [run("ours", mesh, threads) for threads in THREADS]
    line(mesh, first, "ours", own_quality(first["figures"]), second)
    millions = first["faces"] / 1e6
    gain = first["wall"] / second["wall"]
    bounds.check(f"{mesh.stem}: {first['cpu']:.0f} cpu s", first["cpu"] <= LARGE_SECONDS * millions)
    bounds.check(f"{mesh.stem}: {first['bytes'] / 1e9:.1f} GB", first["bytes"] <= LARGE_BYTES * max(1.0, millions))
    if first["faces"] >= MANY_FACES:
        bounds.check(f"{mesh.stem}: two threads are {gain:.2f} times as fast", gain >= LEAST_GAIN)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--models", type=Path, default=MODELS_DIR)
    parser.add_argument("--only", nargs="+", choices=MODELS, default=MODELS, metavar="MODEL")
    parser.add_argument("--no-xatlas", action="store_true")
    parser.add_argument("--no-small", action="store_true", help="leave out the models as they are")
    parser.add_argument("--large", action="store_true")
    parser.add_argument("--huge", action="store_true")
    options = parser.parse_args()
    bounds = Bounds()
    show(COLUMNS)
    show("---" for _ in COLUMNS)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        if not options.no_small:
            for model in options.only:
                small(options.models / f"{model}.ply", bounds, not options.no_xatlas, folder)
        for source, times, noise in LARGE * options.large + HUGE * options.huge:
            if source in options.only:
                large(subdivided(options.models / f"{source}.ply", times, noise, folder), bounds)
    return bounds.report()


if __name__ == "__main__":
    if sys.argv[1:2] == ["--child"]:
        work = {"ours": child_ours, "xatlas": child_xatlas}[sys.argv[2]]
        os.environ["OMP_NUM_THREADS"] = sys.argv[3]  # which is read when a filter begins; common.py has set it to 1
        print(json.dumps(work(sys.argv[4], sys.argv[5], json.loads(sys.argv[6]))))
    else:
        sys.exit(main())
