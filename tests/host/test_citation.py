# SPDX-License-Identifier: GPL-3.0-or-later
"""CITATION.cff is what the Citation File Format's own checker takes."""
import pathlib
import subprocess
import sys

import pytest

ROOT = pathlib.Path(__file__).parents[2]
CHECKER = pathlib.Path(sys.executable).parent / "cffconvert"


def validate(file):
    if not CHECKER.exists():
        pytest.skip("cffconvert is not installed (pip install cffconvert)")
    return subprocess.run([CHECKER, "--validate", "-i", file], capture_output=True, text=True, timeout=120)


def test_it_is_valid():
    run = validate(ROOT / "CITATION.cff")
    assert run.returncode == 0 and "valid" in run.stdout, run.stdout + run.stderr


def test_a_wrong_field_is_found(tmp_path):
    """So that the test above says something."""
    wrong = tmp_path / "CITATION.cff"
    wrong.write_text((ROOT / "CITATION.cff").read_text(encoding="utf-8").replace("\ntitle:", "\ntitel:"), encoding="utf-8")
    assert validate(wrong).returncode != 0
