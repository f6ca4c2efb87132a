# SPDX-License-Identifier: GPL-3.0-or-later
"""scripts/make_pictures.py makes the pictures of docs/images, and the pages show all of them."""
import pathlib
import re
import subprocess
import sys

import numpy as np
from PIL import Image

ROOT = pathlib.Path(__file__).parents[2]
SCRIPT = ROOT / 'scripts' / 'make_pictures.py'
IMAGES = ROOT / 'docs' / 'images'


def alike(picture, other):
    """Not byte for byte: another version of Pillow may choose other colours for the palette."""
    if picture.size != other.size:
        return False
    first, second = (np.asarray(p.convert('L'), float) for p in (picture, other))
    return (np.abs(first - second) > 40).mean() < 0.002


def run(*words):
    done = subprocess.run([sys.executable, SCRIPT, *words], capture_output=True, text=True, timeout=600)
    assert 'Traceback' not in done.stderr, done.stderr
    return done


def test_it_makes_a_picture_of_a_mesh_and_of_a_pattern(tmp_path):
    names = ('gallery_cylinder', 'pattern_cylinder_paper', 'pattern_torus_fabric')
    done = run(tmp_path / 'pictures', '--only', *names)
    assert done.returncode == 0, done.stderr
    assert [re.search(r'(\w+)\.png: \d+ KB', line).group(1) for line in done.stdout.splitlines()] == list(names)
    for name in names:
        picture, shipped = Image.open(tmp_path / 'pictures' / f'{name}.png'), Image.open(IMAGES / f'{name}.png')
        assert np.asarray(picture.convert('L')).std() > 8
        assert alike(picture, shipped), f'{name}.png is stale: python scripts/make_pictures.py'


def test_it_makes_those_of_the_window_from_screenshots(tmp_path):
    for name in ('segment', 'cut', 'uv', 'pattern'):
        Image.effect_noise((1280, 900), 50).convert('RGB').save(tmp_path / f'2020 window {name}.png')
    done = run(tmp_path / 'pictures', '--screenshots', tmp_path)
    assert done.returncode == 0, done.stderr
    for path in IMAGES.glob('window_*.png'):
        assert Image.open(tmp_path / 'pictures' / path.name).size == Image.open(path).size


def test_what_can_not_be_written_is_said(tmp_path):
    (tmp_path / 'file').touch()
    done = run(tmp_path / 'file' / 'pictures', '--only', 'pattern_cylinder_paper')
    assert done.returncode == 1 and "can't be written" in done.stderr


def test_every_picture_is_there_small_and_shown():
    say = 'from make_pictures import PICTURES, WINDOWS; print(*PICTURES, *(f"window_{name}" for name in WINDOWS))'
    names = subprocess.run([sys.executable, '-c', say],
                           cwd=SCRIPT.parent, capture_output=True, text=True, check=True, timeout=60).stdout
    made = {f'{name}.png' for name in names.split()}
    there = {path.name: path.stat().st_size for path in IMAGES.iterdir()}
    assert set(there) == made
    assert max(there.values()) < 200 * 1024 and sum(there.values()) < 1900 * 1024
    pages = [*(ROOT / 'docs').glob('*.md'), ROOT / 'README.md']
    shown = {name for page in pages for name in re.findall(r'images/([\w.]+)\)', page.read_text(encoding='utf-8'))}
    assert shown == made
