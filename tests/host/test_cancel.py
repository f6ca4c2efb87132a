# SPDX-License-Identifier: GPL-3.0-or-later
"""Every filter of every plugin file, cancelled at callback after callback, leaves the document as it was: see tests/harness."""
import pathlib
import shutil
import subprocess
import tempfile

import pytest

from cases import FILTERS, ROOT
from forky import inside
from hosts import BUILD, NotHere, plugin_file, source_tree


def build_harness(name, api, scalar, host_library, rpath):
    """Builds the harness for a host; nothing is done where it is up to date."""
    folder = BUILD / f'harness-{name}'
    commands = (['cmake', '-S', ROOT / 'tests' / 'harness', '-B', folder, '-G', 'Ninja', '-DCMAKE_BUILD_TYPE=Release',
                 f'-DHARNESS_API={api}', f'-DHARNESS_SCALAR={scalar}', f'-DHARNESS_SOURCE={source_tree(api)}',
                 f'-DHARNESS_HOST_LIBRARY={host_library}', f'-DHARNESS_RPATH={rpath}'], ['cmake', '--build', folder])
    for command in commands:
        run = subprocess.run(list(map(str, command)), capture_output=True, text=True)
        assert run.returncode == 0, run.stdout[-3000:] + run.stderr[-3000:]
    return folder / 'cancel_harness'


def check(command, tmp_path):
    run = subprocess.run(list(map(str, command)), stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=900,
                         cwd=tmp_path)
    failed = [line for line in run.stdout.splitlines() if line.startswith('FAIL')]
    assert run.returncode == 0 and not failed, '\n'.join(failed) + run.stderr[-2000:]
    for name in FILTERS:
        assert f'ok   {name}:' in run.stdout, f'{name} was not run:\n{run.stdout}'
    for what in ('deleted elements', 'without memory'):
        assert f'ok   {what}:' in run.stdout, run.stdout


def plugin_or_skip(name):
    try:
        return plugin_file(name)
    except NotHere as reason:
        pytest.skip(str(reason))


def test_pymeshlab(tmp_path):
    pymeshlab = pytest.importorskip('pymeshlab')
    libraries = pathlib.Path(pymeshlab.__file__).parent / 'lib'
    plugin = plugin_or_skip('pymeshlab')
    harness = build_harness('pymeshlab', '2025', 'double', libraries / 'libmeshlab-common.so', libraries)
    check([harness, plugin], tmp_path)


def test_meshlab_2020(meshlab_2020, tmp_path):
    plugin = plugin_or_skip('2020')
    harness = build_harness('2020', '2020', 'float', meshlab_2020.library, meshlab_2020.library.parent)
    check([harness, plugin], tmp_path)


def test_meshlab_2025(forky, tmp_path):
    plugin = plugin_or_skip('2025')
    libraries = pathlib.Path('/usr/lib/x86_64-linux-gnu/meshlab')
    library = forky / libraries.relative_to('/') / 'libmeshlab-common.so'
    harness = build_harness('2025', '2025', 'float', library, libraries)
    with tempfile.TemporaryDirectory(prefix='harness-', dir=forky / 'root') as folder:
        for file in (harness, plugin):
            shutil.copy(file, folder)
        there = pathlib.Path('/') / pathlib.Path(folder).relative_to(forky)
        check(inside(forky, there / harness.name, there / plugin.name), tmp_path)
