# SPDX-License-Identifier: GPL-3.0-or-later
"""The files of a pattern from every host: SVG, PDF and DXF, byte for byte those of pymeshlab, which are looked into
elsewhere."""
import shutil
import xml.etree.ElementTree as ElementTree

import pytest

from cases import ROOT
from forky import inside
from made_patterns import ENDINGS, MODELS, SIZE, made_pattern
from meshlab_gui import MeshlabGui
from mlx import write_script

pymeshlab = pytest.importorskip('pymeshlab')
pytest.importorskip('pymeshlab_dcharts')

PATTERN = 'D-Charts: Pattern'
EXAMPLE = ROOT / 'examples' / 'pattern.mlx'
MATERIALS = ('Fabric', 'Paper')  # in the order of the menu


@pytest.fixture
def expected(model_file):
    """A function: {ending: the file's bytes} of a model in pymeshlab."""

    def files(model):
        return {e: made_pattern(model_file(model), MODELS[model], e)[1].read_bytes() for e in ENDINGS}

    return files


@pytest.mark.parametrize('model', MODELS)
def test_meshlabserver(meshlab_2020, screen, tmp_path, model_file, expected, model):
    """One run with a script of three filters; the mesh itself is saved as it was."""
    script = tmp_path / 'three.mlx'
    steps = []
    for ending in ENDINGS:
        # Parameters that the example sets for A4 have their defaults.
        one = write_script(tmp_path / 'one.mlx', PATTERN, EXAMPLE, size=SIZE, page=0,
                           material=MATERIALS.index(MODELS[model]), output_file=f'pattern.{ending}')
        steps += list(ElementTree.parse(one).getroot())
    root = ElementTree.Element('FilterScript')
    root.extend(steps)
    script.write_text('<!DOCTYPE FilterScript>\n' + ElementTree.tostring(root, encoding='unicode'))
    run = meshlab_2020.server(screen, '-i', model_file(model), '-o', tmp_path / 'out.ply', '-s', script, folder=tmp_path)
    assert run.returncode == 0, run.stdout[-2000:]
    for ending, content in expected(model).items():
        assert (tmp_path / f'pattern.{ending}').read_bytes() == content, f'another {ending}'


def write_three_files(gui, model, folder, picture):
    """`folder`: as the GUI sees it. Closes the GUI."""
    order = [p.get('name') for p in ElementTree.parse(EXAMPLE).getroot().find(f"filter[@name='{PATTERN}']")]
    try:
        for ending in ENDINGS:
            gui.apply(PATTERN, seconds=60, typed={order.index('size'): str(SIZE)},
                      chosen={order.index('material'): MATERIALS.index(MODELS[model])},
                      saved_as=(order.index('output_file'), f'{folder}/pattern.{ending}'))
    finally:
        gui.session.save_screen(picture)
        gui.close()


@pytest.mark.parametrize('model', MODELS)
def test_gui_2020(screen, meshlab_2020, tmp_path, model_file, expected, screenshots, model):
    gui = MeshlabGui(screen, [meshlab_2020.bin / 'meshlab'], model_file(model))
    write_three_files(gui, model, tmp_path, screenshots / f'2020 pattern of {model}.png')
    for ending, content in expected(model).items():
        assert (tmp_path / f'pattern.{ending}').read_bytes() == content, f'another {ending}'


@pytest.mark.parametrize('model', MODELS)
def test_gui_2025(screen, forky, forky_home, model_file, expected, screenshots, model):
    shutil.copy(model_file(model), forky_home)
    at_home = f'/{forky_home.relative_to(forky)}'
    gui = MeshlabGui(screen, inside(forky, 'meshlab'), f'{at_home}/{model}.ply',
                     env={'HOME': at_home, 'XDG_RUNTIME_DIR': at_home}, first_field=3)
    write_three_files(gui, model, at_home, screenshots / f'2025 pattern of {model}.png')
    for ending, content in expected(model).items():
        file = forky_home / f'pattern.{ending}'
        assert file.read_bytes() == content, f'another {ending}'
        file.unlink()
