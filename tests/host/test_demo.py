# SPDX-License-Identifier: GPL-3.0-or-later
"""The demo writes what it says, and says what to do when it can't."""
import json
import pathlib

import numpy as np
import pytest
from PIL import Image

from loading import load
from pattern_files import dxf_pieces, svg_pieces
from pymeshlab_dcharts import demo

MESH = pathlib.Path(__file__).parents[2] / "meshes" / "cylinder.ply"


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("demo") / "new" / "cylinder"
    assert demo.main([str(MESH), str(folder)]) == 0
    return folder


def test_report_holds_figures_parameters_seconds_and_versions(folder):
    report = json.loads((folder / "report.json").read_text())
    assert report["mesh"]["faces"] == 1440 and report["mesh"]["boundary_loops"] == 2
    assert report["figures"]["unassigned_faces"] == 0 and report["figures"]["flipped_faces"] == 0
    assert report["parameters"]["texture_size"] == 1024 and report["parameters"]["max_fitting_error"] == 0.2
    assert {"segment", "fill", "straighten", "merge", "cut", "parameterize"} <= set(report["seconds_per_stage"])
    assert all(seconds >= 0 for seconds in report["seconds"].values())
    assert report["versions"]["pymeshlab"].startswith("2025.7")


def test_atlas_is_the_mesh_with_one_textured_material(folder):
    text = (folder / "atlas.obj").read_text()
    assert "mtllib ./atlas.obj.mtl" in text
    assert {line for line in text.splitlines() if line.startswith("usemtl")} == {"usemtl material_0"}
    material = (folder / "atlas.obj.mtl").read_text()
    assert material.count("newmtl") == material.count("map_Kd") == 1
    assert (folder / material.split("map_Kd ")[1].split()[0]).exists()
    ms_before, ms_after = load(MESH), load(folder / "atlas.obj")  # a mesh lives as long as its MeshSet
    before, after = ms_before.current_mesh(), ms_after.current_mesh()
    assert np.array_equal(before.face_matrix(), after.face_matrix())
    assert np.allclose(before.vertex_matrix(), after.vertex_matrix(), rtol=0, atol=1e-15)  # 16 decimals
    uvs = after.wedge_tex_coord_matrix()
    assert uvs.min() >= 0 and uvs.max() <= 1 and len(np.unique(uvs, axis=0)) > 700


def test_segmented_mesh_has_chart_ids_and_their_colours(folder):
    ms = load(folder / "segmented.ply")
    mesh = ms.current_mesh()
    ids = mesh.face_scalar_array()
    count = json.loads((folder / "report.json").read_text())["figures"]["charts"]
    assert sorted(set(ids)) == list(range(count))
    pairs = {(i, tuple(color)) for i, color in zip(ids, mesh.face_color_matrix())}
    assert len(pairs) == count


def test_patterns_are_there(folder):
    assert (folder / "pattern.pdf").read_bytes().startswith(b"%PDF-")
    assert len(svg_pieces(folder / "pattern.svg")) == len(dxf_pieces(folder / "pattern.dxf")) >= 1
    assert json.loads((folder / "report.json").read_text())["pattern"]["parameters"]["size"] == 300


def test_pictures_are_not_empty(folder):
    for name in ("charts.png", "atlas.png", "checker.png"):
        image = np.asarray(Image.open(folder / name).convert("RGB"))
        assert min(image.shape[:2]) >= 500 and len(np.unique(image.reshape(-1, 3), axis=0)) >= 2


def test_texture_named_before_is_replaced(tmp_path):
    material = tmp_path / "a.mtl"
    material.write_text("newmtl a\nmap_Kd old.png\nKd 1 1 1\n\nnewmtl b\nKd 1 1 1\n")
    demo.use_texture(material, "new.png")
    assert material.read_text() == "newmtl a\nmap_Kd new.png\nKd 1 1 1\n\nnewmtl b\nmap_Kd new.png\nKd 1 1 1\n"


@pytest.mark.parametrize("content", ["no mesh at all\n", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n"
                                     "property float y\nproperty float z\nend_header\n0 0 0\n"])
def test_says_what_is_wrong(tmp_path, capsys, content):
    (tmp_path / "bad.ply").write_text(content)
    assert demo.main([str(tmp_path / "bad.ply"), str(tmp_path / "out")]) == 1
    message = capsys.readouterr().err
    assert "bad.ply" in message and "MeshLab" in message and "Traceback" not in message
