# SPDX-License-Identifier: GPL-3.0-or-later
"""The hosts on this machine: where they are, and how the plugin gets into them."""
import os
import pathlib
import platform
import shutil
import subprocess

from cases import ROOT, is_sentence

BUILD = pathlib.Path(os.environ.get('DCHARTS_BUILD', ROOT / 'build'))
CACHE = pathlib.Path(os.environ.get('DCHARTS_CACHE')
                     or pathlib.Path(os.environ.get('XDG_CACHE_HOME') or pathlib.Path.home() / '.cache') / 'dcharts')
REFUSED = 255  # meshlabserver's exit code for a filter that says no; 134 would be an abort


class NotHere(Exception):
    """A host that this machine does not have; the text says what is missing."""


def plugin_file(name):
    """The built plugin for a host: 'pymeshlab', '2025' or '2020'."""
    file = BUILD / 'filter_dcharts' / f'libfilter_dcharts_{name}.so'
    if not file.exists():
        raise NotHere(f'{file.name} was not built in {BUILD}')
    return file


def source_tree(version):
    """MeshLab's source tree whose headers the build used: '2020' or '2025'."""
    variable = f'MESHLAB_{version}_SOURCE'
    for line in (BUILD / 'CMakeCache.txt').read_text().splitlines():
        if line.startswith(f'{variable}:') and line.split('=', 1)[1]:
            return pathlib.Path(line.split('=', 1)[1])
    release = {'2020': '2020.09', '2025': '2025.07'}[version]
    tree = CACHE / f'meshlab-{release}'
    if not tree.exists():
        raise NotHere(f'there are no headers of MeshLab {release}')
    return tree


def install(*options, path=None, home=None):
    """Runs scripts/install-meshlab.sh for the MeshLab first on `path`, or the one in the home folder `home`."""
    env = dict(os.environ)
    if path:
        env['PATH'] = f'{path}{os.pathsep}{env["PATH"]}'
    if home:
        env['HOME'] = str(home)
        env['DCHARTS_CACHE'] = str(CACHE)  # the build's cache stays that of the real home
        env.pop('XDG_DATA_HOME', None)
    return subprocess.run(['bash', str(ROOT / 'scripts' / 'install-meshlab.sh'), *options], env=env,
                          stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=1200)


class Meshlab2020:
    """MeshLab 2020.09 of the system, copied into a folder so that plugins can be tried without touching it."""

    def __init__(self, folder):
        if not shutil.which('meshlabserver'):
            raise NotHere('meshlabserver is not installed (Debian 12: apt-get install meshlab)')
        prefix = pathlib.Path(shutil.which('meshlabserver')).resolve().parents[1]
        system = prefix / 'lib' / f'{platform.machine()}-linux-gnu' / 'meshlab'
        self.bin = folder / 'bin'
        self.plugins = folder / 'lib' / system.parent.name / 'meshlab' / 'plugins'
        self.bin.mkdir(parents=True)
        self.plugins.mkdir(parents=True)
        (folder / 'share').mkdir()
        (folder / 'share' / 'meshlab').symlink_to(prefix / 'share' / 'meshlab')
        for program in ('meshlab', 'meshlabserver'):  # copies: it looks for plugins beside its real self
            shutil.copy2(prefix / 'bin' / program, self.bin / program)
        for file in system.iterdir():
            if file.name != 'plugins':
                (self.plugins.parent / file.name).symlink_to(file)
        for file in (system / 'plugins').iterdir():
            if not file.name.startswith('libfilter_dcharts'):
                (self.plugins / file.name).symlink_to(file)
        self.library = system / 'libmeshlab-common.so'
        self.installed = install(path=self.bin)

    def server(self, session, *arguments, folder):
        """Runs meshlabserver on an XSession in `folder`."""
        return subprocess.run([str(self.bin / 'meshlabserver'), *map(str, arguments)], env=session.env, cwd=folder,
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                              errors='replace', timeout=600)


def refused(run, out):
    """meshlabserver's run was refused with a sentence and wrote nothing."""
    assert run.returncode == REFUSED, f'exit code {run.returncode}:\n{run.stdout[-2000:]}'
    assert out is None
    said = [line for line in run.stdout.splitlines() if 'LOG' in line or is_sentence(line)]
    assert any(is_sentence(line) for line in said), run.stdout[-2000:]
