# SPDX-License-Identifier: GPL-3.0-or-later
"""What README.md says is so. Its files and links: test_docs."""
import pathlib
import re
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).parents[2]
README = (ROOT / "README.md").read_text(encoding="utf-8")


def blocks(language):
    return re.findall(rf"```{language}\n(.*?)```", README, re.S)


def test_python_example_runs(tmp_path):
    (tmp_path / "meshes").mkdir()
    shutil.copy(ROOT / "meshes" / "plush.ply", tmp_path / "meshes")
    (code,) = blocks("python")
    run = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True)
    assert run.returncode == 0, run.stderr
    charts, stretch = run.stdout.split()[-2:]
    assert int(charts) > 1 and 1 <= float(stretch) < 1.1
    assert (tmp_path / "atlas.obj").exists() and (tmp_path / "segmented.ply").exists()


def test_apt_line_is_that_of_the_scripts():
    setup = (ROOT / "scripts" / "setup.sh").read_text(encoding="utf-8")
    packages = re.search(r"build_packages=\(([^)]*)\)", setup).group(1).split()
    (line,) = re.findall(r"apt-get install -y --no-install-recommends ([a-z].*)", README)
    assert line.split() == packages


def test_filters_are_those_of_the_plugin():
    import pymeshlab_dcharts

    assert sorted(set(re.findall(r"\| `(dcharts_\w+)` \|", README))) == sorted(pymeshlab_dcharts.filters)
