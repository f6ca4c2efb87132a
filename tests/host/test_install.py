# SPDX-License-Identifier: GPL-3.0-or-later
"""scripts/install-meshlab.sh: what is installed is found, a second run changes nothing, and it can be undone."""
import os
import pathlib
import subprocess

import pytest

from cases import ROOT
from forky import inside
from hosts import Meshlab2020, NotHere, install


@pytest.fixture
def fresh(tmp_path):
    try:
        return Meshlab2020(tmp_path / 'meshlab')
    except NotHere as reason:
        pytest.skip(str(reason))


def test_install_again_and_undo(fresh):
    plugin = fresh.plugins / 'libfilter_dcharts_2020.so'
    assert fresh.installed.returncode == 0, fresh.installed.stderr
    assert str(plugin) in fresh.installed.stdout, 'it does not say where the plugin is'
    first = plugin.stat()
    again = install(path=fresh.bin)
    assert again.returncode == 0 and 'already there' in again.stdout
    assert (plugin.stat().st_mtime_ns, plugin.stat().st_ino) == (first.st_mtime_ns, first.st_ino)
    others = sorted(file.name for file in fresh.plugins.iterdir() if file != plugin)
    undone = install('--uninstall', path=fresh.bin)
    assert undone.returncode == 0 and str(plugin) in undone.stdout, undone.stderr
    assert sorted(file.name for file in fresh.plugins.iterdir()) == others
    assert install('--uninstall', path=fresh.bin).returncode == 0


def meshlab(folder, says, name='meshlab'):
    """A program that says of itself which MeshLab it is, as MeshLab 2025.07 does, and is nothing else."""
    folder.mkdir(parents=True, exist_ok=True)
    program = folder / name
    program.write_text(f'#!/bin/sh\n[ "$*" = --version ] && echo "{says}"\n')
    program.chmod(0o755)
    return program


@pytest.fixture
def no_other(tmp_path):
    """A home without any MeshLab. The one of the system is hidden by a program that is none."""
    (tmp_path / 'home').mkdir()
    meshlab(tmp_path / 'bin', 'MeshLab 2023.12')
    return {'path': tmp_path / 'bin', 'home': tmp_path / 'home'}


def plugins_below(home):
    """The plugins' folders and names in a home, without what they all begin with."""
    start = home / '.local/share/VCG'
    return sorted(str(file.relative_to(start)) for file in start.rglob('*') if file.is_file())


FLOAT = 'MeshLab_64bit_fp/MeshLabExtraPlugins/2025.07/libfilter_dcharts_2025.so'
DOUBLE = 'MeshLab_64bit_dp/MeshLabExtraPlugins/2025.07d/libfilter_dcharts_pymeshlab.so'


@pytest.mark.parametrize('says, plugin', [('MeshLab 2025.07', FLOAT), ('MeshLab 2025.07d', DOUBLE)])
def test_an_appimage_that_was_never_started(no_other, tmp_path, says, plugin):
    """Named on the command line, since it can be anywhere."""
    program = meshlab(tmp_path / 'Downloads', says, 'MeshLab-x86_64.AppImage')
    run = install(str(program), **no_other)
    assert run.returncode == 0, run.stderr
    assert plugins_below(no_other['home']) == [plugin] and plugin in run.stdout
    assert 'already there' in install(**no_other).stdout, 'not found again by its folder'
    assert install('--uninstall', **no_other).returncode == 0
    assert plugins_below(no_other['home']) == []


def test_an_unpacked_appimage_on_the_path(no_other, tmp_path):
    root = tmp_path / 'squashfs-root'
    (root / 'usr/lib/meshlab/plugins').mkdir(parents=True)
    run = install(path=meshlab(root / 'usr/bin', 'MeshLab 2025.07').parent, home=no_other['home'])
    assert run.returncode == 0, run.stderr
    assert plugins_below(no_other['home']) == [FLOAT]


def test_two_that_were_started_before(no_other):
    for plugin in (FLOAT, DOUBLE):
        (no_other['home'] / '.local/share/VCG' / plugin).parent.mkdir(parents=True)
    run = install(**no_other)
    assert run.returncode == 0, run.stderr
    assert plugins_below(no_other['home']) == [DOUBLE, FLOAT]
    assert install('--uninstall', **no_other).returncode == 0
    assert plugins_below(no_other['home']) == []


@pytest.mark.parametrize('says', ['MeshLab 2023.12', 'MeshLab 2025.07_nightly_0a1b2c', ''])
def test_another_version_is_refused(no_other, tmp_path, says):
    program = meshlab(tmp_path / 'Downloads', says)
    run = install(str(program), **no_other)
    assert run.returncode == 1
    assert f'{program} is neither MeshLab 2020.09 nor 2025.07; the plugin is only for these.' in run.stderr
    assert plugins_below(no_other['home']) == []


def test_no_such_file(no_other, tmp_path):
    run = install(str(tmp_path / 'missing.AppImage'), **no_other)
    assert run.returncode == 1 and 'There is no file' in run.stderr


def test_debians_2025_package(no_other, forky, tmp_path):
    """The real program of the package, for which it is enough to be on the path."""
    program = meshlab(tmp_path / 'package', '')
    command = ' '.join(inside(pathlib.Path(os.path.realpath(forky)), 'meshlab'))
    program.write_text(f'#!/bin/sh\nexec {command} "$@"\n')
    run = install(path=program.parent, home=no_other['home'])
    assert run.returncode == 0, run.stderr
    assert plugins_below(no_other['home']) == [FLOAT]


def test_unknown_option():
    run = install('--unknown')
    assert run.returncode == 2 and 'usage' in run.stderr


@pytest.mark.parametrize('code', [0, 3])
def test_a_build_says_how_far_it_is_and_whether_it_failed(tmp_path, code):
    log = tmp_path / 'build.log'
    build = f'for i in $(seq 1 40); do echo "[$i/40] Building"; done; echo done; (exit {code})'
    run = subprocess.run(['bash', '-euo', 'pipefail', '-c', f'source {ROOT}/scripts/setup.sh; {{ {build}; }} | tell_progress {log}'],
                         capture_output=True, text=True, timeout=60)
    assert run.returncode == code
    assert run.stderr.split() == [word for k in range(1, 11) for word in (f'{k}0', '%')]
    assert len(log.read_text().splitlines()) == 41
