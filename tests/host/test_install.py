# SPDX-License-Identifier: GPL-3.0-or-later
"""scripts/install-meshlab.sh: what is installed is found, a second run changes nothing, and it can be undone."""
import pytest

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


def test_unknown_option():
    run = install('--unknown')
    assert run.returncode == 2 and 'usage' in run.stderr
