# SPDX-License-Identifier: GPL-3.0-or-later
"""The notebook runs from its first cell to its last, and its pictures show something."""
import base64
import io
import os
import pathlib

import nbformat
import numpy as np
import pymeshlab
import pytest
from nbclient import NotebookClient
from PIL import Image

from pymeshlab_dcharts.show import show_atlas, show_charts, show_pattern

ROOT = pathlib.Path(__file__).parents[2]


@pytest.fixture(scope="module")
def executed(tmp_path_factory):
    folder = tmp_path_factory.mktemp("notebook")
    (folder / "meshes").symlink_to(ROOT / "meshes")
    notebook = nbformat.read(ROOT / "examples" / "dcharts.ipynb", 4)
    NotebookClient(notebook, timeout=900, resources={"metadata": {"path": str(folder)}}).execute()
    return notebook, folder / "out" / "notebook"


def pictures(notebook):
    outputs = [output for cell in notebook.cells for output in cell.get("outputs", [])]
    return [base64.b64decode(o.data["image/png"]) for o in outputs if "image/png" in o.get("data", {})]


def texts(notebook):
    """What cells print or give, but for pictures."""
    outputs = [output for cell in notebook.cells for output in cell.get("outputs", [])]
    return [o.get("text") or o["data"]["text/plain"] for o in outputs if "image/png" not in o.get("data", {})]


def test_the_shipped_one_is_current(executed):
    """Else: python scripts/make_pictures.py --notebook"""
    shipped = nbformat.read(ROOT / "examples" / "dcharts.ipynb", 4)
    assert texts(shipped) == texts(executed[0])
    for k, pair in enumerate(zip(pictures(shipped), pictures(executed[0]))):
        there, here = (Image.open(io.BytesIO(png)).convert("L") for png in pair)
        assert there.size == here.size, k
        # Shades are dithered in the shipped ones.
        there, here = (np.asarray(p.reduce(4), float) for p in (there, here))
        assert (np.abs(there - here) > 12).mean() < 0.002, k


def test_it_runs_and_every_picture_shows_something(executed):
    notebook, _ = executed
    shown = pictures(notebook)
    assert len(shown) == sum("show_" in line for c in notebook.cells if c.cell_type == "code"
                             for line in c.source.splitlines()[-1:])
    for k, png in enumerate(shown):
        picture = Image.open(io.BytesIO(png)).convert("L")
        assert np.asarray(picture).std() > 10, k
        if "DCHARTS_SCREENSHOTS" in os.environ:
            folder = pathlib.Path(os.environ["DCHARTS_SCREENSHOTS"]) / "notebook"
            folder.mkdir(parents=True, exist_ok=True)
            (folder / f"{k + 1}.png").write_bytes(png)


def test_it_writes_a_textured_model_and_patterns(executed):
    _, folder = executed
    assert "bear.png" in (folder / "bear.obj.mtl").read_text()
    assert np.asarray(Image.open(folder / "bear.png").convert("RGB")).std() > 10
    for pattern in ("bear.pdf", "cylinder.pdf"):
        assert (folder / pattern).read_bytes().startswith(b"%PDF")
    assert (folder / "bear.svg").read_text().count('class="piece"') >= 4


def test_the_shipped_one_has_its_pictures_and_no_path_of_anyones_machine():
    text = (ROOT / "examples" / "dcharts.ipynb").read_text()
    assert len(pictures(nbformat.reads(text, 4))) >= 8
    assert not any(folder in text for folder in ("/home/", "/tmp/", "/root/", "/Users/", str(ROOT)))


def test_what_can_not_be_shown_is_said(tmp_path):
    ms = pymeshlab.MeshSet()
    ms.load_new_mesh(str(ROOT / "meshes" / "cylinder.ply"))
    assert show_charts(ms).get_size_inches()[0] == 10  # without charts: all grey
    with pytest.raises(ValueError, match="dcharts_texture_atlas"):
        show_atlas(ms)
    other = tmp_path / "other.svg"
    for text in ("no svg", '<svg xmlns="http://www.w3.org/2000/svg"/>'):
        other.write_text(text)
        with pytest.raises(ValueError, match="no SVG that dcharts_pattern wrote"):
            show_pattern(other)
    points = pymeshlab.MeshSet()
    points.add_mesh(pymeshlab.Mesh(np.eye(3)))
    with pytest.raises(ValueError, match="no faces"):
        show_charts(points)
