# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes a texture atlas and a sewing pattern of a mesh and writes everything there is to see of them.

usage: python -m pymeshlab_dcharts.demo MESH OUTDIR        (needs numpy and Pillow)
"""

import contextlib
import importlib.metadata
import json
import math
import os
import pathlib
import platform
import re
import sys
import tempfile
import time

import numpy as np
import pymeshlab

from . import PLUGIN
from .pictures import Model, atlas_picture, charts_picture, checker_image

FILTER = "dcharts_texture_atlas"
TEXTURE = "checker.png"
PATTERN_FILTER = "dcharts_pattern"
PATTERN = {"material": "Fabric", "size": 300.0, "page": "A4"}  # a toy of 30 cm; the PDF is for an ordinary printer
PATTERN_FILES = ("pattern.svg", "pattern.pdf", "pattern.dxf")


class Stopwatch:
    """Seconds per step, in order."""

    def __init__(self):
        self.seconds = {}
        self._last = time.perf_counter()

    def step(self, name):
        now = time.perf_counter()
        self.seconds[name] = round(now - self._last, 4)
        self._last = now


def default_parameters(name):
    """The parameters of a filter with their defaults, as the plugin has them."""
    specs = json.loads((PLUGIN.parent / "filters.json").read_text(encoding="utf-8"))
    spec = next(s for s in specs if s["name"] == name)
    return {parameter["name"]: parameter["default"] for parameter in spec["parameters"]}


def mesh_facts(ms, path):
    """Size and topology, from pymeshlab's own measures."""
    mesh = ms.current_mesh()
    vertices, faces = mesh.vertex_matrix(), mesh.face_matrix()
    corners = vertices[faces]
    area = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1).sum() / 2
    facts = {
        "file": os.path.basename(path),
        "vertices": len(vertices),
        "faces": len(faces),
        "area": float(area),
        "size": np.ptp(vertices, axis=0).tolist(),
    }
    topology = ms.get_topological_measures()
    names = {
        "connected_components_number": "components",
        "genus": "genus",
        "number_holes": "boundary_loops",
        "boundary_edges": "boundary_edges",
        "non_two_manifold_edges": "non_manifold_edges",
        "non_two_manifold_vertices": "non_manifold_vertices",
    }
    facts.update({name: topology[key] for key, name in names.items() if topology.get(key, -1) >= 0})
    return facts


def versions():
    found = {name: importlib.metadata.version(name) for name in ("pymeshlab", "pymeshlab-dcharts", "numpy", "Pillow")}
    return {**found, "python": platform.python_version(), "system": platform.platform()}


def use_texture(material_file, texture):
    """Names the texture in every material of an .mtl file, in place of one that is named there."""
    text = re.sub(r"(?m)^\s*map_Kd .*\n", "", material_file.read_text(encoding="utf-8"))
    material_file.write_text(re.sub(r"(?m)^(newmtl .*)$", rf"\1\nmap_Kd {texture}", text), encoding="utf-8")


def save(ms, path, **options):
    try:
        ms.save_current_mesh(str(path), **options)
    except pymeshlab.PyMeshLabException as error:
        raise OSError(f"{path.name} could not be written") from error


def write_patterns(mesh_path, folder):
    """Writes the pattern's files and returns the filter's figures."""
    for name in PATTERN_FILES:
        ms = pymeshlab.MeshSet()
        ms.load_new_mesh(str(mesh_path))
        figures = getattr(ms, PATTERN_FILTER)(**PATTERN, output_file=str(folder / name))
    return figures


def summary(name, figures):
    parts = [f"{figures['charts']} charts"]
    for key, text in (("l2_stretch", "L2 stretch {:.4f}"), ("linf_stretch", "largest {:.3f}"), ("seam_length", "seams {:.2f}"),
                      ("packing_efficiency", "{:.0%} of the texture used")):
        if key in figures:
            parts.append(text.format(figures[key]))
    return f"{name}: " + ", ".join(parts)


def plain(value):
    """Numbers that JSON can hold: infinity as text."""
    return value if not isinstance(value, float) or math.isfinite(value) else str(value)


def write_all(mesh_path, folder):
    """Writes all files to `folder` and returns the contents of report.json and a title."""
    watch = Stopwatch()
    ms = pymeshlab.MeshSet()
    ms.load_new_mesh(str(mesh_path))
    watch.step("load")
    figures = getattr(ms, FILTER)()
    watch.step("texture_atlas")

    mesh = ms.current_mesh()
    model = Model(mesh.vertex_matrix(), mesh.face_matrix(), mesh.face_scalar_array(), mesh.wedge_tex_coord_matrix(),
                  mesh.face_color_matrix()[:, :3])
    save(ms, folder / "segmented.ply", save_face_quality=True, save_face_color=True)
    # MeshLab writes one material per face colour; an atlas is one material with one texture.
    ms.compute_color_by_function_per_face(r="255", g="255", b="255", a="255")
    save(ms, folder / "atlas.obj", save_wedge_texcoord=True, save_textures=False)
    checker_image().save(folder / TEXTURE)
    use_texture(folder / "atlas.obj.mtl", TEXTURE)
    watch.step("write")

    title = summary(mesh_path.stem, figures)
    charts_picture(model, title).save(folder / "charts.png")
    atlas_picture(model, title).save(folder / "atlas.png")
    watch.step("pictures")

    pattern_figures = write_patterns(mesh_path, folder)
    watch.step("patterns")

    stages = {key[len("seconds_") :]: value for key, value in figures.items() if key.startswith("seconds_")}
    report = {
        "mesh": mesh_facts(ms, mesh_path),
        "filter": FILTER,
        "parameters": default_parameters(FILTER),
        "figures": {key: plain(value) for key, value in figures.items() if not key.startswith("seconds_")},
        "seconds_per_stage": stages,
        "pattern": {
            "filter": PATTERN_FILTER,
            "parameters": {**default_parameters(PATTERN_FILTER), **PATTERN},
            "figures": {key: plain(value) for key, value in pattern_figures.items() if not key.startswith("seconds_")},
        },
        "seconds": watch.seconds,
        "versions": versions(),
    }
    (folder / "report.json").write_text(json.dumps(report, indent=2) + "\n", encoding="utf-8")
    return report, title


def run(mesh_path, folder):
    """Writes all files to `folder`, or none and what is there stays. Returns the contents of report.json and a title."""
    mesh_path, folder = pathlib.Path(mesh_path), pathlib.Path(folder)
    missing = [f for f in (folder, *folder.parents) if not f.exists()]
    try:
        folder.mkdir(parents=True, exist_ok=True)
        # MeshLab does not say when a file was cut off by a full disk, but the pictures after it do.
        with tempfile.TemporaryDirectory(prefix=".new-", dir=folder) as aside:
            result = write_all(mesh_path, pathlib.Path(aside))
            for path in sorted(pathlib.Path(aside).iterdir(), key=lambda p: p.name == "report.json"):
                path.replace(folder / path.name)
        return result
    except BaseException:
        for made in missing:
            with contextlib.suppress(OSError):  # not there, or not empty
                made.rmdir()
        raise


def main(arguments):
    if len(arguments) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    mesh_path, folder = arguments
    try:
        _, title = run(mesh_path, folder)
    except pymeshlab.PyMeshLabException as error:
        print(f"{mesh_path}: {error}", file=sys.stderr)
        print("If the file can't be read, open it in MeshLab and export it as .ply; if the mesh was refused, mend it as said above.",
              file=sys.stderr)
        return 1
    except OSError as error:
        print(f"{error}. Check that {folder} can be written to and that there is space on the disk.", file=sys.stderr)
        return 1
    print(title)
    for path in sorted(pathlib.Path(folder).iterdir()):
        print(f"  {path}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
