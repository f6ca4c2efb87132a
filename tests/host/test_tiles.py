# SPDX-License-Identifier: GPL-3.0-or-later
"""The commands of docs/large-scans.md on a small model, as they stand there but for the scan and the size of a tile."""
import os
import pathlib
import re
import shutil
import subprocess
import sys

import numpy as np
import pytest

from loading import load

ROOT = pathlib.Path(__file__).parents[2]
PAGE = (ROOT / "docs/large-scans.md").read_text(encoding="utf-8")
MODEL, FACES = "meshes/plush.ply", 3000


def run(command, folder):
    path = f"{pathlib.Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    return subprocess.run(["bash", "-ec", command], cwd=folder, env={**os.environ, "PATH": path}, stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=600)


@pytest.fixture(scope="module")
def joined(tmp_path_factory):
    if shutil.which("parallel") is None:
        pytest.skip("GNU parallel is not installed (Debian 12: apt-get install parallel)")
    folder = tmp_path_factory.mktemp("tiles")
    for name in ("meshes", "examples"):
        (folder / name).symlink_to(ROOT / name, target_is_directory=True)
    (commands,) = [block for block in re.findall(r"```sh\n(.*?)```", PAGE, re.S) if "tiles.py join" in block]
    commands = commands.replace("SCAN.ply", MODEL).replace("--faces 1000000", f"--faces {FACES}")
    done = run(commands, folder)
    assert done.returncode == 0, done.stdout
    return folder


def test_the_scan_is_as_it_was_with_texcoords_of_tiles_in_their_squares(joined):
    before_set, after_set = load(ROOT / MODEL), load(joined / "out/scan_atlas.ply")
    before, after = before_set.current_mesh(), after_set.current_mesh()
    assert np.array_equal(before.vertex_matrix(), after.vertex_matrix())
    assert np.array_equal(before.face_matrix(), after.face_matrix())
    uv = after.wedge_tex_coord_matrix().reshape(-1, 3, 2)
    tiles = sorted((joined / "out/tiles").glob("tile_????.npy"))
    assert len(tiles) == 4
    seen = np.zeros(len(uv), int)
    for k, tile in enumerate(tiles):
        faces = np.load(tile)
        assert 0 < len(faces) <= FACES
        seen[faces] += 1
        inside = uv[faces] - [k % 10, k // 10]
        assert inside.min() >= 0 and inside.max() <= 1
        a, b, c = inside.swapaxes(0, 1)
        u, v = b - a, c - a
        assert (u[:, 0] * v[:, 1] > u[:, 1] * v[:, 0]).all()  # none is flipped
    assert (seen == 1).all()


def test_every_tile_is_sound(joined):
    log = (joined / "out/tiles/log").read_text().splitlines()
    assert len(log) == 1 + 4 and all(line.split("\t")[6] == "0" for line in log[1:])


def test_a_tile_without_an_atlas_is_named(joined, tmp_path):
    tiles = tmp_path / "tiles"
    shutil.copytree(joined / "out/tiles", tiles)
    (tiles / "tile_0002.uv.npy").unlink()
    done = run(f"python examples/tiles.py join {MODEL} {tiles} {tmp_path}/joined.ply", joined)
    assert done.returncode == 1 and "tile_0002.ply" in done.stdout and "--resume" in done.stdout
    assert not (tmp_path / "joined.ply").exists()


def test_what_is_no_ply_of_triangles_is_refused(joined, tmp_path):
    quad = tmp_path / "quad.ply"
    quad.write_text("ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
                    "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                    "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n")
    done = run(f"python examples/tiles.py split {quad} {tmp_path}/tiles", joined)
    assert done.returncode == 1 and "triangulate it" in done.stdout and "Traceback" not in done.stdout
