# SPDX-License-Identifier: GPL-3.0-or-later
"""The files of a pattern from every host: SVG, PDF and DXF, byte for byte those of pymeshlab, which are looked into
elsewhere."""
import shutil
import tempfile
import xml.etree.ElementTree as ElementTree

import pytest

from cases import ROOT
from forky import inside
from hosts import install
from meshlab_gui import MeshlabGui
from mlx import write_script

pymeshlab = pytest.importorskip('pymeshlab')
pytest.importorskip('pymeshlab_dcharts')

PATTERN = 'D-Charts: Pattern'
EXAMPLE = ROOT / 'examples' / 'pattern.mlx'
ENDINGS = ('svg', 'pdf', 'dxf')
SIZE = 150


@pytest.fixture(scope='module')
def expected(tmp_path_factory):
    """{(model, ending): the file's bytes} in pymeshlab, with defaults but for the size."""
    folder = tmp_path_factory.mktemp('expected')
    files = {}
    for model in ('bishop', 'torus'):
        for ending in ENDINGS:
            ms = pymeshlab.MeshSet()
            ms.load_new_mesh(str(ROOT / 'meshes' / f'{model}.ply'))
            file = folder / f'{model}.{ending}'
            ms.dcharts_pattern(size=SIZE, output_file=str(file))
            files[model, ending] = file.read_bytes()
    return files


@pytest.mark.parametrize('model', ['bishop', 'torus'])
def test_meshlabserver(meshlab_2020, screen, tmp_path, expected, model):
    """One run with a script of three filters; the mesh itself is saved as it was."""
    script = tmp_path / 'three.mlx'
    steps = []
    for ending in ENDINGS:
        # Parameters that the example sets for A4 have their defaults.
        one = write_script(tmp_path / 'one.mlx', PATTERN, EXAMPLE, size=SIZE, page=0, output_file=f'{model}.{ending}')
        steps += list(ElementTree.parse(one).getroot())
    root = ElementTree.Element('FilterScript')
    root.extend(steps)
    script.write_text('<!DOCTYPE FilterScript>\n' + ElementTree.tostring(root, encoding='unicode'))
    mesh = ROOT / 'meshes' / f'{model}.ply'
    run = meshlab_2020.server(screen, '-i', mesh, '-o', tmp_path / 'out.ply', '-s', script, folder=tmp_path)
    assert run.returncode == 0, run.stdout[-2000:]
    for ending in ENDINGS:
        assert (tmp_path / f'{model}.{ending}').read_bytes() == expected[model, ending], f'another {ending}'


def three_files(gui, folder, seen_as):
    """{(model, ending): bytes} of what the GUI writes; `seen_as`: what it takes the folder for."""
    order = [p.get('name') for p in ElementTree.parse(EXAMPLE).getroot().find(f"filter[@name='{PATTERN}']")]
    for ending in ENDINGS:
        gui.apply(PATTERN, seconds=60, typed={order.index('size'): str(SIZE)},
                  saved_as=(order.index('output_file'), f'{seen_as}/torus.{ending}'))
    return {('torus', ending): (folder / f'torus.{ending}').read_bytes() for ending in ENDINGS}


def test_gui_2020(screen, meshlab_2020, tmp_path, expected, screenshots):
    gui = MeshlabGui(screen, [meshlab_2020.bin / 'meshlab'], ROOT / 'meshes' / 'torus.ply')
    try:
        files = three_files(gui, tmp_path, tmp_path)
    finally:
        screen.save_screen(screenshots / '2020 pattern files.png')
        gui.close()
    for (model, ending), content in files.items():
        assert content == expected[model, ending], f'another {ending}'


def test_gui_2025(screen, forky, expected, screenshots):
    folder = tempfile.mkdtemp(prefix='home-', dir=forky / 'root')
    home = forky / 'root' / folder
    plugins = home / '.local/share/VCG/MeshLab_64bit_fp/MeshLabExtraPlugins/2025.07'
    plugins.mkdir(parents=True)
    try:
        run = install(home=home)
        assert run.returncode == 0, run.stderr
        shutil.copy(ROOT / 'meshes' / 'torus.ply', home)
        at_home = '/' + str(home.relative_to(forky))
        gui = MeshlabGui(screen, inside(forky, 'meshlab'), f'{at_home}/torus.ply',
                         env={'HOME': at_home, 'XDG_RUNTIME_DIR': at_home}, first_field=3)
        try:
            files = three_files(gui, home, at_home)
        finally:
            screen.save_screen(screenshots / '2025 pattern files.png')
            gui.close()
    finally:
        shutil.rmtree(home)
    for (model, ending), content in files.items():
        assert content == expected[model, ending], f'another {ending}'
