#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a change does beyond chance, in one command:

    python benchmarks/draws.py [--large] [--models DIR] [--only MODEL ...] [--save FILE] [--against FILE]

Charts come together by a long row of decisions, and a vertex that moves by a hair may turn one: a single model tells
little. So Texture Atlas without parameters is run on several draws of each model: as it is, with noise too small to be
seen (three draws), with noise of 5 % of an edge, and with four times the faces. With --large each model is quartered until
it has 90,000 faces or more, and taken as it is then and with two draws of the least noise. Prints a row for each and the sums
of charts, seams and cpu seconds on one thread; --save writes them as JSON, and --against compares them with those that were
saved before the change. Figures are the filter's own. Has no bounds. Needs the package (pip install .) and numpy."""

import argparse
import json
import tempfile
import time
from pathlib import Path

from common import MODELS_DIR, ROOT

import pymeshlab
import pymeshlab_dcharts  # noqa: F401 (adds the filters)

from meshes import noisy, quartered, save
from reference import MODELS

OURS = ("plush", "torus", "cad_part")
HAIR, HAIRS = 0.002, 3  # noise of the mean edge, draws of it
NOISE = 0.05
LARGE, LARGE_HAIRS = 90000, 2  # faces, draws


def draws(vertices, faces):
    yield "", vertices, faces
    for seed in range(HAIRS):
        yield f"hair {seed}", noisy(vertices, faces, HAIR, seed), faces
    yield "noise", noisy(vertices, faces, NOISE), faces
    yield "4x", *quartered(vertices, faces)


def large_draws(vertices, faces):
    while len(faces) < LARGE:
        vertices, faces = quartered(vertices, faces)
    yield "large", vertices, faces
    for seed in range(LARGE_HAIRS):
        yield f"large, hair {seed}", noisy(vertices, faces, HAIR, seed), faces


def run(mesh):
    ms = pymeshlab.MeshSet()
    ms.load_new_mesh(str(mesh))
    before = time.process_time()
    figures = ms.dcharts_texture_atlas()
    return {"charts": figures["charts"], "l2": figures["l2_stretch"], "linf": figures["linf_stretch"],
            "seam": figures["seam_length"], "cpu": time.process_time() - before}


def line(row):
    return f"{row['charts']:4} {row['l2']:.4f} {row['linf']:6.3f} {row['seam']:7.2f} {row['cpu']:7.2f}"


def sums(rows):
    charts, seam, cpu = (sum(row[key] for row in rows) for key in ("charts", "seam", "cpu"))
    return f"{charts:4} {'':13} {seam:7.1f} {cpu:7.1f}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--large", action="store_true")
    parser.add_argument("--models", type=Path, default=MODELS_DIR, metavar="DIR")
    parser.add_argument("--only", nargs="+", metavar="MODEL")
    parser.add_argument("--save", type=Path, metavar="FILE")
    parser.add_argument("--against", type=Path, metavar="FILE")
    options = parser.parse_args()
    before = json.loads(options.against.read_text()) if options.against else {}
    paths = [ROOT / "meshes" / f"{name}.ply" for name in OURS]
    paths += [options.models / f"{name}.ply" for name in (*MODELS, "spot")]
    paths = [path for path in paths if path.exists() and (not options.only or path.stem in options.only)]
    print(f"{'':24} charts, L2, Linf, seam, cpu s" + (" | before" if before else ""))
    rows = {}
    with tempfile.TemporaryDirectory() as folder:
        for path in paths:
            ms = pymeshlab.MeshSet()
            ms.load_new_mesh(str(path))
            mesh = ms.current_mesh()
            for draw, vertices, faces in (large_draws if options.large else draws)(mesh.vertex_matrix(), mesh.face_matrix()):
                name = f"{path.stem} {draw}".strip()
                rows[name] = run(save(Path(folder) / "draw.ply", vertices, faces) if draw else path)
                print(f"{name:24} {line(rows[name])}" + (f" | {line(before[name])}" if name in before else ""), flush=True)
    both = [name for name in rows if name in before]
    print(f"{f'{len(rows)} draws':24} {sums(rows.values())}")
    if both:
        print(f"{f'the {len(both)} of both':24} {sums([rows[name] for name in both])} | {sums([before[name] for name in both])}")
    if options.save:
        options.save.write_text(json.dumps(rows, indent=1))


if __name__ == "__main__":
    main()
