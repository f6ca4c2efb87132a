# SPDX-License-Identifier: GPL-3.0-or-later
import ctypes
import os
import pathlib
import shutil
import sys
import tempfile

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent))

from cases import ROOT, SHARED_MESHES  # noqa: E402
from forky import root_folder  # noqa: E402
from hosts import Meshlab2020, NotHere, install  # noqa: E402
from xsession import XSession, missing_tools  # noqa: E402


@pytest.fixture(autouse=True)
def flushed_c_output():
    """What libraries print goes to the test that caused it, not after pytest's last line."""
    yield
    ctypes.CDLL(None).fflush(None)


@pytest.fixture(scope='session')
def screen():
    """An XSession for all tests."""
    missing = missing_tools()
    if missing:
        pytest.skip(f'not installed: {", ".join(missing)} (Debian 12: apt-get install xvfb openbox xdotool)')
    session = XSession()
    yield session
    session.close()


@pytest.fixture(scope='session')
def meshlab_2020(tmp_path_factory):
    """A MeshLab 2020.09 with the plugin in it."""
    try:
        return Meshlab2020(tmp_path_factory.mktemp('meshlab-2020'))
    except NotHere as reason:
        pytest.skip(str(reason))


@pytest.fixture(scope='session')
def forky():
    """The folder of a Debian forky with MeshLab 2025.07."""
    try:
        return root_folder()
    except NotHere as reason:
        pytest.skip(str(reason))


@pytest.fixture(scope='module')
def forky_home(forky):
    """A home folder in the forky folder, with the plugin in it."""
    home = forky / 'root' / tempfile.mkdtemp(prefix='home-', dir=forky / 'root')
    try:
        (home / '.local/share/VCG/MeshLab_64bit_fp/MeshLabExtraPlugins/2025.07').mkdir(parents=True)
        run = install(home=home)
        assert run.returncode == 0, run.stderr
        yield home
    finally:
        shutil.rmtree(home)


@pytest.fixture(scope='session')
def screenshots(tmp_path_factory):
    """Where screenshots go: $DCHARTS_SCREENSHOTS, else a folder of pytest's."""
    folder = os.environ.get('DCHARTS_SCREENSHOTS')
    return pathlib.Path(folder) if folder else tmp_path_factory.mktemp('screenshots')


@pytest.fixture(scope='session')
def model_file():
    """A function: the file of a model of meshes/ or of the well-known ones, which are not in the project."""

    def find(name):
        for folder in (ROOT / 'meshes', SHARED_MESHES):
            if (folder / f'{name}.ply').exists():
                return folder / f'{name}.ply'
        pytest.skip(f'{name}.ply is not in {SHARED_MESHES}')

    return find


@pytest.fixture(scope='session')
def plush():
    return ROOT / 'meshes' / 'plush.ply'


@pytest.fixture(scope='session')
def large_plush(plush, tmp_path_factory):
    """The same in mm, 30 cm tall: a pattern of it can be made without giving a size."""
    pymeshlab = pytest.importorskip('pymeshlab')
    ms = pymeshlab.MeshSet()
    ms.load_new_mesh(str(plush))
    ms.compute_matrix_from_scaling_or_normalization(axisx=100, uniformflag=True)
    file = tmp_path_factory.mktemp('large') / 'plush.ply'
    ms.save_current_mesh(str(file))
    return file


@pytest.fixture
def server(meshlab_2020, screen, tmp_path):
    """A function that runs meshlabserver and returns (run, output file or None)."""

    def run(script, mesh=None):
        out = tmp_path / 'out.ply'
        out.unlink(missing_ok=True)
        arguments = (['-i', mesh] if mesh else []) + ['-o', out, '-m', 'fq', 'fc', 'wt', '-s', script]
        result = meshlab_2020.server(screen, *arguments, folder=tmp_path)
        return result, (out if out.exists() else None)

    return run
