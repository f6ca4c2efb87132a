# SPDX-License-Identifier: GPL-3.0-or-later
"""Atlases of a mesh file, ours and xatlas's, measured from outside by evaluate_atlas.py. Needs the package
(pip install .), numpy, scipy and xatlas."""

import importlib.util
import sys
import tempfile
import time
from pathlib import Path

from common import ROOT

import numpy as np

sys.path.insert(0, str(ROOT / "tests" / "host"))
from atlas_check import EVALUATOR, evaluate, flaws  # noqa: E402 (of the tests)
from mlx import read_script  # noqa: E402

import pymeshlab  # noqa: E402
import pymeshlab_dcharts  # noqa: E402, F401 (adds the filters)

FILTER = "dcharts_texture_atlas"
SHARP = 30.0  # degrees between the normals of two faces: more is a crease

if not EVALUATOR.exists():
    sys.exit(f"{EVALUATOR} is not there: it measures the atlases.")
_module = importlib.util.spec_from_file_location("evaluate_atlas", EVALUATOR)
evaluator = importlib.util.module_from_spec(_module)
_module.loader.exec_module(evaluator)


def paper_parameters():
    """The paper's own settings, without its numbers of charts."""
    ((name, values),) = read_script(ROOT / "examples" / "paper.mlx")
    assert name == FILTER
    return values


class Atlas:
    """A measured atlas. `figures`: of evaluate_atlas.py; `flaws`: what makes it unsound, as words; `seconds`: cpu;
    `worst_chart`: the largest L2 stretch of a chart at its own scale; `faces` (#F by 3) and `uv` (#F by 3 by 2) as the
    evaluator sees them, vertices welded; `chart_ids`: per face."""

    def __init__(self, file, reference, chart_ids, seconds):
        self.seconds = seconds
        self.figures = evaluate(file, reference)
        self.flaws = flaws(self.figures)
        self.vertices, self.faces, _ = evaluator.read_mesh(str(reference))
        self.uv = evaluator.read_mesh(str(file))[2]
        self.chart_ids = chart_ids
        self.worst_chart = max(self._chart_stretch(chart) for chart in np.unique(chart_ids))

    charts = property(lambda self: self.figures["charts"])
    l2 = property(lambda self: self.figures["L2_stretch"])
    linf = property(lambda self: self.figures["Linf_stretch"])
    seam = property(lambda self: self.figures["seam_norm"])

    def _chart_stretch(self, chart):
        mine = self.chart_ids == chart
        figures = evaluator.evaluate(self.vertices, self.faces[mine], self.uv[mine], weld=False, overlap=False)
        return figures["L2_stretch"] or 1.0  # a chart without area has no figure

    def crease_share(self):
        """Which part of the seams' length lies on creases, and how long all creases are, over the root of the area."""
        corners = self.vertices[self.faces]
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
        start, end = self.faces.ravel(), np.roll(self.faces, -1, axis=1).ravel()
        key = np.minimum(start, end) * (self.faces.max() + 1) + np.maximum(start, end)
        order = np.argsort(key, kind="stable")
        _, first, count = np.unique(key[order], return_index=True, return_counts=True)
        a, b = order[first[count == 2]], order[first[count == 2] + 1]
        uv = self.uv.reshape(-1, 2)
        after = lambda h: h - h % 3 + (h + 1) % 3  # noqa: E731
        opposite = start[a] == end[b]
        at_start, at_end = np.where(opposite, after(b), b), np.where(opposite, b, after(b))
        seam = (uv[a] != uv[at_start]).any(1) | (uv[after(a)] != uv[at_end]).any(1)
        length = np.linalg.norm(self.vertices[start[a]] - self.vertices[end[a]], axis=1)
        sharp = (normals[a // 3] * normals[b // 3]).sum(1) < np.cos(np.radians(SHARP))
        return (length[seam & sharp].sum() / max(length[seam].sum(), 1e-300),
                length[sharp].sum() / np.sqrt(self.figures["area_3d"]))


def make(mesh, **parameters):
    """Our atlas of a mesh file."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "atlas.obj"
        ms = pymeshlab.MeshSet()
        ms.load_new_mesh(str(mesh))
        start = time.process_time()
        ms.apply_filter(FILTER, **parameters)
        seconds = time.process_time() - start
        ids = ms.current_mesh().face_scalar_array().round().astype(int)
        ms.save_current_mesh(str(file), save_wedge_texcoord=True)
        return Atlas(file, mesh, ids, seconds)


def make_by_xatlas(mesh):
    """The atlas of xatlas with its defaults."""
    import xatlas

    vertices, faces, _ = evaluator.read_mesh(str(mesh))
    start = time.process_time()
    atlas = xatlas.Atlas()
    atlas.add_mesh(vertices.astype(np.float32), faces.astype(np.uint32))
    atlas.generate()
    seconds = time.process_time() - start
    places, triangles, uv = atlas[0]
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "atlas.obj"
        xatlas.export(str(file), vertices[places], triangles, uv)
        ids = evaluator.components(len(places), triangles[:, [0, 1]].ravel(), triangles[:, [1, 2]].ravel())
        return Atlas(file, mesh, ids[triangles[:, 0]], seconds)
