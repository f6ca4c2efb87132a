# SPDX-License-Identifier: GPL-3.0-or-later
"""Filter scripts in MeshLab's window: one recorded there runs in meshlabserver, and the shipped ones run there as they are."""
import re
import shutil

import numpy as np
import pytest

from atlas_check import ply_layers
from cases import EXAMPLES, FILTERS, ROOT
from forky import inside
from meshlab_gui import MeshlabGui
from mlx import read_script

pymeshlab = pytest.importorskip('pymeshlab')
pytest.importorskip('pymeshlab_dcharts')

MESH = ROOT / 'meshes' / 'cad_part.ply'
SCRIPTS = ('pattern.mlx', 'texture_atlas.mlx', 'stages.mlx', 'paper.mlx')
DISPLAY_NAMES = {python: name for name, (python, _) in FILTERS.items()}


def test_a_recorded_script_runs_in_the_server(screen, meshlab_2020, server, tmp_path, plush):
    recorded = tmp_path / 'recorded.mlx'
    gui = MeshlabGui(screen, [meshlab_2020.bin / 'meshlab'], plush)
    try:
        gui.apply('D-Charts: Segment', typed={0: '9'})
        gui.apply('D-Charts: Fill')
        gui.apply('D-Charts: Parameterize')
        gui.save_script(recorded)
    finally:
        gui.close()
    steps = read_script(recorded)
    assert [name for name, _ in steps] == ['dcharts_segment', 'dcharts_fill', 'dcharts_parameterize']
    assert steps[0][1]['chart_count'] == 9
    run, out = server(recorded, plush)
    assert run.returncode == 0 and out is not None, run.stdout[-2000:]
    there = ply_layers(out)
    here = pymeshlab.MeshSet()
    here.load_new_mesh(str(plush))
    here.dcharts_segment(chart_count=9)
    here.dcharts_fill()
    figures = here.dcharts_parameterize()
    assert np.array_equal(there.quality, here.current_mesh().face_scalar_array())
    assert np.abs(there.texcoords.reshape(-1, 2) - here.current_mesh().wedge_tex_coord_matrix()).max() < 1e-4
    assert re.findall(r'\bcharts\b\W+([0-9]+)', run.stdout)[-1] == str(figures['charts'])


@pytest.fixture(scope='module')
def expected():
    """For each shipped script the numbers of charts that its filters give in pymeshlab, and the pattern's file."""
    charts = {}
    for script in SCRIPTS:
        ms = pymeshlab.MeshSet()
        ms.load_new_mesh(str(MESH))
        charts[script] = [ms.apply_filter(name, **{**values, **({'output_file': ''} if 'output_file' in values else {})})['charts']
                          for name, values in read_script(EXAMPLES / script)]
    assert len(set(map(tuple, charts.values()))) == len(SCRIPTS)
    return charts


def run_shipped_scripts(gui, folder, expected):
    """All of them in one window, one after the other. `folder`: where the scripts are for the GUI."""
    for script in SCRIPTS:
        before = len(gui.lines)
        gui.run_script(f'{folder}/{script}', DISPLAY_NAMES[read_script(EXAMPLES / script)[-1][0]])
        said = '\n'.join(gui.lines[before:])
        assert [int(n) for n in re.findall(r'\bcharts: ([0-9]+)', said)] == expected[script], f'{script}:\n{said}'


def test_shipped_scripts_in_2020(screen, meshlab_2020, tmp_path, screenshots, expected):
    gui = MeshlabGui(screen, [meshlab_2020.bin / 'meshlab'], shutil.copy(MESH, tmp_path), folder=tmp_path)
    try:
        run_shipped_scripts(gui, EXAMPLES, expected)
    finally:
        screen.save_screen(screenshots / '2020 filter scripts.png')
        gui.close()
    assert (tmp_path / 'pattern.pdf').read_bytes().startswith(b'%PDF-')


def test_shipped_scripts_in_2025(screen, forky, forky_home, screenshots, expected):
    at_home = f'/{forky_home.relative_to(forky)}'
    for file in (MESH, *(EXAMPLES / script for script in SCRIPTS)):
        shutil.copy(file, forky_home)
    gui = MeshlabGui(screen, inside(forky, 'env', '-C', at_home, 'meshlab'), f'{at_home}/{MESH.name}',
                     env={'HOME': at_home, 'XDG_RUNTIME_DIR': at_home})
    try:
        run_shipped_scripts(gui, at_home, expected)
    finally:
        screen.save_screen(screenshots / '2025 filter scripts.png')
        gui.close()
    assert (forky_home / 'pattern.pdf').read_bytes().startswith(b'%PDF-')
