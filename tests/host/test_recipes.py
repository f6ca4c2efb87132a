# SPDX-License-Identifier: GPL-3.0-or-later
"""The recipes of docs/recipes.md run as they stand and write the files that they name. The messages that
docs/troubleshooting.md quotes stand in the code."""
import os
import pathlib
import re
import subprocess
import sys

import pytest

ROOT = pathlib.Path(__file__).parents[2]
DOCS = {name: (ROOT / name).read_text(encoding="utf-8") for name in ("docs/recipes.md", "docs/troubleshooting.md")}


def python_blocks():
    """Each block of Python under its heading."""
    for section in re.split(r"(?m)^## ", DOCS["docs/recipes.md"])[1:]:
        for code in re.findall(r"```python\n(.*?)```", section, re.S):
            yield pytest.param(code, id=section.split("\n")[0].lower().replace(" ", "-"))


BLOCKS = list(python_blocks())


def named_files(code):
    """What the code writes to out/: files named there, and textures, which are saved beside their mesh."""
    names = re.findall(r'"(out/[^"{]+)"', code)
    return set(names) | {f"out/{name}" for name in re.findall(r'textname="([^"]+)"', code)}


def meshes():
    return {path.name: path.stat().st_mtime_ns for path in (ROOT / "meshes").iterdir()}


@pytest.mark.parametrize("code", BLOCKS)
def test_recipe_runs_and_writes_its_files(code, tmp_path):
    for folder in ("meshes", "examples"):
        (tmp_path / folder).symlink_to(ROOT / folder, target_is_directory=True)
    before = meshes()
    run = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                         stderr=subprocess.STDOUT, text=True, errors="replace", timeout=600)
    assert run.returncode == 0, run.stdout[-2000:]
    written = list((tmp_path / "out").iterdir())
    assert written and all(path.stat().st_size > 0 for path in written)
    for name in named_files(code):
        assert (tmp_path / name).exists(), name
    for materials in (tmp_path / "out").glob("*.mtl"):  # MeshLab writes a material for each face colour
        assert materials.read_text().count("newmtl") == 1
    assert sorted(os.listdir(tmp_path)) == ["examples", "meshes", "out"] and meshes() == before


def test_there_are_blocks():
    assert len(BLOCKS) >= 9 and sum(len(named_files(block.values[0])) > 0 for block in BLOCKS) >= 9


def letters(text):
    """The letters alone: how a sentence is broken into strings and lines, and its signs, do not count."""
    return re.sub(r"[^a-z]+", "", text.lower())


def test_messages_that_are_quoted_stand_in_the_code():
    said = ""
    for folder in ("vcg_ext", "filter_dcharts"):
        for path in sorted((ROOT / folder).rglob("*")):
            if path.suffix in (".cpp", ".h"):
                said += letters("".join(re.findall(r'"((?:[^"\\]|\\.)*)"', path.read_text(encoding="utf-8"))))
    # Before these sections scripts and hosts speak, too.
    ours = DOCS["docs/troubleshooting.md"].split("## Meshes that are refused")[1]
    heads = " ".join(re.findall(r"(?ms)^- \*\*(.*?)\*\*$", ours))
    quotes = re.findall(r'"([^"]+)"', heads)
    assert len(quotes) > 40
    for quote in quotes:
        for part in re.split(r"\.\.\.|'|Too small to (?:sew|glue) ", quote):  # these words are put in
            assert letters(part) in said, part
