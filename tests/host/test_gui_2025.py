# SPDX-License-Identifier: GPL-3.0-or-later
"""The GUI of MeshLab 2025.07 (float): does it take the plugin, and what is then to be seen."""
import shutil

import pytest

from cases import ROOT
from forky import inside
from gui_round import apply_all
from meshlab_gui import MeshlabGui


def opened(screen, forky, forky_home, mesh, **options):
    """MeshLab 2025.07 with the mesh."""
    shutil.copy(mesh, forky_home)
    at_home = '/' + str(forky_home.relative_to(forky))
    return MeshlabGui(screen, inside(forky, 'meshlab'), f'{at_home}/{mesh.name}',
                      env={'HOME': at_home, 'XDG_RUNTIME_DIR': at_home}, **options)


@pytest.mark.parametrize('name', ['D-Charts: Texture Atlas', 'D-Charts: Pattern'])
def test_filter_colors_the_charts(screen, forky, forky_home, large_plush, screenshots, name):
    gui = opened(screen, forky, forky_home, large_plush)
    try:
        # Of a pattern's layer only a part is in view, and of a bear in three charts two.
        least = gui.colors() + (1 if name.endswith('Pattern') else 2)
        try:
            gui.apply(name)
            gui.wait_for_colors(least)
        finally:
            screen.save_screen(screenshots / f'2025 {name}.png'.replace(': ', ' '))
        assert gui.has_line(r'\bcharts\b\W+[0-9]'), gui.output[-2000:]
        assert gui.colors() >= least, 'no coloured charts on the screen'
    finally:
        gui.close()


def test_all_filters_and_what_they_show(screen, forky, forky_home, screenshots):
    gui = opened(screen, forky, forky_home, ROOT / 'meshes' / 'cad_part.ply', first_field=3)
    apply_all(gui, lambda name: screenshots / f'2025 window {name}.png', uv_line=2)
