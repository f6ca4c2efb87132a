# SPDX-License-Identifier: GPL-3.0-or-later
"""What the benchmarks share: places, one thread, bounds, and the files that the benchmark programs read and write.
Import it first: threads are counted when numpy and the peers are loaded."""

import os
import subprocess
from pathlib import Path

for variable in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "IGL_NUM_THREADS"):
    os.environ[variable] = "1"

import numpy as np  # noqa: E402

ROOT = Path(__file__).resolve().parent.parent
MODELS_DIR = ROOT.parent / "shared" / "meshes"


class Bounds:
    def __init__(self):
        self.missed = []

    def check(self, what, holds):
        if not holds:
            self.missed.append(what)
        return "yes" if holds else "NO"

    def report(self):
        """Prints what was missed; the exit code."""
        print(f"{len(self.missed)} bounds missed", *self.missed, sep="\n  ")
        return 1 if self.missed else 0


def run_tool(tool, *words):
    return subprocess.run([tool, *map(str, words)], check=True, stdout=subprocess.PIPE, text=True).stdout


def write_mesh(path, vertices, faces):
    with open(path, "wb") as out:
        out.write(np.array([len(vertices), len(faces)], np.int32).tobytes())
        out.write(np.ascontiguousarray(vertices, np.float64).tobytes())
        out.write(np.ascontiguousarray(faces, np.int32).tobytes())


def read_charts(path):
    data, at, charts = path.read_bytes(), 0, []
    while at < len(data):
        vertices, faces = np.frombuffer(data, np.int32, 2, at)
        at += 8
        points = np.frombuffer(data, np.float64, 3 * vertices, at).reshape(-1, 3)
        at += points.nbytes
        triangles = np.frombuffer(data, np.int32, 3 * faces, at).reshape(-1, 3)
        at += triangles.nbytes
        charts.append((points, triangles))
    return charts
