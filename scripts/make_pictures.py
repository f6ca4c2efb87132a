#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the pictures of docs/images anew, from the models of meshes/; those of MeshLab's window from the screenshots
that the tests leave; those in examples/dcharts.ipynb, with all that its cells give, by running it.

    python scripts/make_pictures.py [FOLDER] [--only NAME ...]
    python scripts/make_pictures.py [FOLDER] --screenshots out/screenshots
    python scripts/make_pictures.py --notebook

Needs the package with what its pictures need (pip install ".[notebook]"), and nbclient for the notebook. Takes about a
minute. FOLDER is docs/images when it is not given; NAME is a picture's name without .png. Prints each file with its size."""

import argparse
import base64
import functools
import io
import pathlib
import sys
import tempfile

import numpy as np
import pymeshlab
from PIL import Image

import pymeshlab_dcharts  # noqa: F401 (adds the filters)
from dump_stages import STAGES
from pymeshlab_dcharts import demo
from pymeshlab_dcharts.pictures import Model, atlas_picture, charts_picture
from pymeshlab_dcharts.show import show_pattern

ROOT = pathlib.Path(__file__).resolve().parents[1]
NOTEBOOK = ROOT / "examples" / "dcharts.ipynb"
STAGE_HEIGHT = 380
# Of a stage: model, which of its best views, width. The same views in each stage, so that one can compare.
STAGE_PANELS = (("plush", 0, 310), ("plush", 1, 350), ("cad_part", 0, 440))
LINE = 2.0  # width of seams in pixels
GALLERY = ("plush", "bishop", "cad_part", "torus", "cylinder")
FEW_FACES = {"plush": 300, "bishop": 220}  # of papercraft: each edge can become a fold
PATTERN_WIDTH = 900


def opened(name):
    ms = pymeshlab.MeshSet()
    ms.load_new_mesh(str(ROOT / "meshes" / f"{name}.ply"))
    return ms


def model_of(ms):
    mesh = ms.current_mesh()
    uvs = mesh.wedge_tex_coord_matrix() if mesh.has_wedge_tex_coord() else None
    return Model(mesh.vertex_matrix(), mesh.face_matrix(), mesh.face_scalar_array(), uvs,
                 mesh.face_color_matrix()[:, :3])


@functools.lru_cache(maxsize=None)
def stages_of(name):
    """The model after each stage."""
    ms, models = opened(name), {}
    for stage in STAGES:
        getattr(ms, "dcharts_" + stage)()
        models[stage] = model_of(ms)
    return models


def cuts_within_charts(model):
    """Which of the seams have the same chart on both sides: darts, and cuts that open a chart."""
    face, corner = model.seam_corners
    ends = np.sort(np.stack([model.faces[face, corner], model.faces[face, (corner + 1) % 3]], 1), axis=1)
    _, edge = np.unique(ends, axis=0, return_inverse=True)
    edge = edge.ravel()
    ids = model.chart_ids[face]
    low, high = np.full(edge.max() + 1, ids.max()), np.full(edge.max() + 1, ids.min())
    np.minimum.at(low, edge, ids)
    np.maximum.at(high, edge, ids)
    return ((low == high) & (np.bincount(edge) > 1))[edge]


def panel(model, view, width, height, marked=None):
    picture = model.draw(model.views[view], width, height, lambda seen: model.colors[seen.face], LINE, marked)
    return (np.clip(picture, 0, 1) * 255 + 0.5).astype(np.uint8)


def stage_picture(stage):
    parts = []
    for name, view, width in STAGE_PANELS:
        model = stages_of(name)[stage]
        parts.append(panel(model, view, width, STAGE_HEIGHT, cuts_within_charts(model) if stage == "cut" else None))
    return Image.fromarray(np.hstack(parts))


def atlas_of(name, size):
    return atlas_picture(stages_of(name)["parameterize"], "", cells=24, size=size)


def gallery_picture(name, size=360):
    """The charts from two sides, then the atlas and the model that wears it."""
    model = stages_of(name)["parameterize"]
    charts = [panel(model, view, size, size) for view in (0, 1)]
    atlas = atlas_of(name, size)
    page = Image.new("RGB", (2 * size + atlas.width, atlas.height), "white")
    for k, part in enumerate(charts):
        page.paste(Image.fromarray(part), (k * size, (atlas.height - size) // 2))
    page.paste(atlas, (2 * size, 0))
    return page


def pattern_picture(name, material, size):
    """The sheet of a pattern of the model, `size` mm large. Small, so that labels are large beside the pieces."""
    ms = opened(name)
    if material == "Paper" and name in FEW_FACES:
        ms.meshing_decimation_quadric_edge_collapse(targetfacenum=FEW_FACES[name])
    with tempfile.TemporaryDirectory() as folder:
        svg = pathlib.Path(folder) / f"{name}.svg"  # its name stands on the sheet
        ms.dcharts_pattern(material=material, size=size, output_file=str(svg))
        png = io.BytesIO()
        show_pattern(svg, width=PATTERN_WIDTH / 100).savefig(png, format="png", dpi=200)
    return Image.open(png).convert("RGB").reduce(2)  # twice as large before: small letters stay sharp


def demo_picture(draw):
    """charts.png or atlas.png as the demo draws it."""
    ms = opened("plush")
    title = demo.summary("plush", ms.dcharts_texture_atlas())
    return draw(model_of(ms), title)


PICTURES = {
    "charts": functools.partial(demo_picture, charts_picture),  # of the README
    "atlas": functools.partial(demo_picture, atlas_picture),
    **{f"stage_{k}_{stage}": functools.partial(stage_picture, stage) for k, stage in enumerate(STAGES[:5], 1)},
    "stage_6_parameterize": lambda: atlas_of("plush", 480),
    **{f"gallery_{name}": functools.partial(gallery_picture, name) for name in GALLERY},
    "pattern_plush_fabric": functools.partial(pattern_picture, "plush", "Fabric", 200),
    "pattern_plush_paper": functools.partial(pattern_picture, "plush", "Paper", 200),
    "pattern_bishop_paper": functools.partial(pattern_picture, "bishop", "Paper", 200),
    "pattern_cad_part_paper": functools.partial(pattern_picture, "cad_part", "Paper", 150),
    "pattern_torus_fabric": functools.partial(pattern_picture, "torus", "Fabric", 150),
    "pattern_cylinder_paper": functools.partial(pattern_picture, "cylinder", "Paper", 120),
}


# From the test of MeshLab 2020.09's window, tests/host/test_gui_2020.py, which calls them "2020 window NAME".
WINDOWS = ("segment", "cut", "uv", "pattern")
WINDOW_SIZE = (800, 562)


def window_picture(folder, name):
    return Image.open(folder / f"2020 window {name}.png").convert("RGB").resize(WINDOW_SIZE, Image.Resampling.LANCZOS)


def smaller(picture, drawing):
    """With a palette of 256 colours: less than half the size. Shades are dithered, else one would see steps."""
    picture = picture.convert("RGB")
    method = Image.Quantize.MAXCOVERAGE if drawing else Image.Quantize.MEDIANCUT
    small = picture.quantize(256, method, kmeans=5, dither=Image.Dither.NONE)
    if not drawing:
        small = picture.quantize(palette=small, dither=Image.Dither.FLOYDSTEINBERG)
    return small


def save(picture, path):
    smaller(picture, path.name.startswith("pattern_")).save(path, optimize=True)


def smaller_output(data):
    """Of a cell's output: its picture with a palette, and no word of how large the figure was."""
    if "image/png" not in data:
        return
    picture = Image.open(io.BytesIO(base64.b64decode(data["image/png"]))).convert("RGB")
    drawing = (np.asarray(picture).min(2) > 250).mean() > 0.75  # mostly paper
    png = io.BytesIO()
    smaller(picture, drawing).save(png, format="png", optimize=True)
    data["image/png"] = base64.b64encode(png.getvalue()).decode()
    data["text/plain"] = "<Figure>"


def make_notebook():
    """Runs the notebook in a folder of its own, and keeps what its cells give."""
    import nbformat
    from nbclient import NotebookClient

    notebook = nbformat.read(NOTEBOOK, 4)
    kept = dict(notebook.metadata)
    with tempfile.TemporaryDirectory() as folder:
        (pathlib.Path(folder) / "meshes").symlink_to(ROOT / "meshes")
        NotebookClient(notebook, timeout=900, resources={"metadata": {"path": folder}}).execute()
    notebook.metadata = nbformat.from_dict(kept)
    for cell in notebook.cells:
        cell.metadata = nbformat.from_dict({})  # no times
        for output in cell.get("outputs", []):
            smaller_output(output.get("data", {}))
    nbformat.write(notebook, NOTEBOOK)
    print(f"{NOTEBOOK}: {NOTEBOOK.stat().st_size / 1024:.0f} KB")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", nargs="?", type=pathlib.Path, default=ROOT / "docs" / "images", metavar="FOLDER")
    parser.add_argument("--only", nargs="+", choices=PICTURES, default=PICTURES, metavar="NAME",
                        help=", ".join(PICTURES))
    parser.add_argument("--screenshots", type=pathlib.Path, metavar="FOLDER", help="make only those of the window, from these")
    parser.add_argument("--notebook", action="store_true", help="run examples/dcharts.ipynb instead, and keep its output")
    options = parser.parse_args()
    if options.notebook:
        make_notebook()
        return 0
    pictures = {name: PICTURES[name] for name in options.only}
    if options.screenshots:
        pictures = {f"window_{name}": functools.partial(window_picture, options.screenshots, name) for name in WINDOWS}
    try:
        options.folder.mkdir(parents=True, exist_ok=True)
        for name, made in pictures.items():
            path = options.folder / f"{name}.png"
            save(made(), path)
            print(f"{path}: {path.stat().st_size / 1024:.0f} KB", flush=True)
    except OSError as error:
        print(f"The pictures can't be written: {error}.", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
