# SPDX-License-Identifier: GPL-3.0-or-later
"""A source release (what `git archive` packs), the source package for pip, and `cmake --install`: nothing is missing
and nothing needs git."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tarfile

import pytest

from cases import ROOT
from hosts import BUILD

ALL_HOSTS = ('pymeshlab', '2025', '2020')


def run(*command, **options):
    done = subprocess.run([*map(str, command)], stdin=subprocess.DEVNULL, capture_output=True, text=True, **options)
    assert done.returncode == 0, f'{command}\n{done.stdout[-2000:]}\n{done.stderr[-2000:]}'
    return done.stdout


@pytest.fixture(scope='module')
def no_git(tmp_path_factory):
    """An environment where git can't be used: a program of that name that fails is the first on the path."""
    folder = tmp_path_factory.mktemp('no-git')
    (folder / 'git').write_text('#!/bin/sh\necho "git was called: $*" >&2\nexit 1\n')
    (folder / 'git').chmod(0o755)
    return {**os.environ, 'PATH': f'{folder}{os.pathsep}{os.environ["PATH"]}'}


@pytest.fixture(scope='module')
def release(tmp_path_factory):
    """The unpacked release of what is committed; in a release, of which this may be a test, a copy of it."""
    folder = tmp_path_factory.mktemp('release') / 'dcharts'
    if (ROOT / '.git').exists():
        run('git', '-C', ROOT, 'archive', '-o', folder.parent / 'release.tar', 'HEAD')
        with tarfile.open(folder.parent / 'release.tar') as archive:
            archive.extractall(folder)
    else:
        shutil.copytree(ROOT, folder, ignore=shutil.ignore_patterns('build*', 'out', '.venv', '__pycache__'))
    assert not (folder / '.git').exists()
    return folder


def configure(source, build, env, *options):
    """What would be built. CMake fails where a source file that is named is not there."""
    run('cmake', '-S', source, '-B', build, '-G', 'Ninja', '-DDCHARTS_FETCH_HEADERS=OFF', *options, env=env)
    return run('ninja', '-C', build, '-t', 'targets', 'all', env=env)


def files_below(folder, *names):
    return {str(path.relative_to(folder)) for name in names for path in (folder / name).rglob('*') if path.is_file()}


def test_a_release_has_all_that_is_built_and_builds(release, no_git, tmp_path):
    build = tmp_path / 'build'
    targets = configure(release, build, no_git)
    for host in ALL_HOSTS:
        assert f'libfilter_dcharts_{host}.so:' in targets
    # What is quickly built: the generator of the shapes, which makes the files that are shipped.
    run('cmake', '--build', build, '--target', 'generate_meshes', '-j', 2, env=no_git)
    run(build / 'meshes' / 'generate_meshes', tmp_path, 'cylinder', 'torus')
    for name in ('cylinder.ply', 'torus.ply'):
        assert (tmp_path / name).read_bytes() == (release / 'meshes' / name).read_bytes()


def test_the_source_package_for_pip_has_all_that_is_built(release, no_git, tmp_path):
    run(sys.executable, '-c', 'import sys; from scikit_build_core.build import build_sdist; build_sdist(sys.argv[1])',
        tmp_path, cwd=release, env=no_git)
    (package,) = tmp_path.glob('pymeshlab_dcharts-*.tar.gz')
    with tarfile.open(package) as archive:
        archive.extractall(tmp_path)
    folder = tmp_path / package.name[:-len('.tar.gz')]
    parts = ('cmake', 'filter_dcharts', 'meshes', 'python', 'scripts', 'vcg_ext')
    assert files_below(folder, *parts) == files_below(release, *parts)
    assert {'CMakeLists.txt', 'LICENSE', 'README.md', 'pyproject.toml'} <= {path.name for path in folder.iterdir()}
    targets = configure(folder, tmp_path / 'build', no_git, '-DDCHARTS_PLUGIN_2025=OFF', '-DDCHARTS_PLUGIN_2020=OFF',
                      '-DDCHARTS_BUILD_TESTS=OFF')
    assert 'libfilter_dcharts_pymeshlab.so:' in targets


def test_what_does_not_compile_for_windows_is_said(tmp_path):
    """The check itself; scripts/test.sh runs it for all files."""
    check = ('bash', str(ROOT / 'scripts' / 'check-mingw.sh'))
    right = tmp_path / 'right.cpp'
    right.write_text('#include <thread>\n#include <hpdf.h>\n#include "runner.h"\nstd::thread thread;\n')
    run(*check, right)
    wrong = tmp_path / 'wrong.cpp'
    wrong.write_text('#include <sys/resource.h>\n')
    done = subprocess.run([*check, str(right), str(wrong)], stdin=subprocess.DEVNULL, capture_output=True, text=True)
    assert done.returncode == 1
    assert f'{wrong} does not compile for Windows' in done.stdout and str(right) not in done.stdout


def test_the_version_is_the_same_everywhere():
    patterns = {'CMakeLists.txt': r'VERSION ([\d.]+) LANGUAGES', 'pyproject.toml': r'(?m)^version = "(.*)"',
                'CITATION.cff': r'(?m)^version: (.*)', 'CHANGELOG.md': r'(?m)^## \[([\d.]+)\]'}
    assert len({re.search(pattern, (ROOT / file).read_text(encoding='utf-8')).group(1)
                for file, pattern in patterns.items()}) == 1


@pytest.fixture
def installed(tmp_path):
    """A function: the files that `cmake --install` puts below a folder, relative to it."""

    def install(*options):
        run('cmake', '--install', BUILD, *options, env={**os.environ, 'DESTDIR': str(tmp_path)})
        return {str(path.relative_to(tmp_path)) for path in tmp_path.rglob('*') if path.is_file()}

    return install


def test_install_puts_the_plugins_into_one_folder(installed, tmp_path):
    files = installed('--component', 'plugins')
    (folder,) = {str(pathlib.Path(file).parent) for file in files}
    assert re.fullmatch(r'usr/local/lib(64|/[\w-]+)?/dcharts', folder)
    assert files == {f'{folder}/libfilter_dcharts_{host}.so' for host in ALL_HOSTS}
    for file in files:  # nothing in them says where they were built
        dynamic = run('readelf', '-d', tmp_path / file)
        assert 'libmeshlab-common.so' in dynamic and 'RUNPATH' not in dynamic and 'RPATH' not in dynamic


def test_install_of_all_is_the_plugins(installed):
    """The Python package is installed by pip only."""
    assert {pathlib.Path(file).name for file in installed('--prefix', '/opt/dcharts')} == {
        f'libfilter_dcharts_{host}.so' for host in ALL_HOSTS}
