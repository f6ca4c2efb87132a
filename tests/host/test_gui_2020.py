# SPDX-License-Identifier: GPL-3.0-or-later
"""The GUI of MeshLab 2020.09, by keyboard, and what is then to be seen."""
import pytest

from cases import ROOT
from gui_round import apply_all
from meshlab_gui import MeshlabGui


@pytest.mark.parametrize('name', ['D-Charts: Segment', 'D-Charts: Texture Atlas', 'D-Charts: Pattern'])
def test_filter_colors_the_charts(screen, meshlab_2020, large_plush, screenshots, name):
    gui = MeshlabGui(screen, [meshlab_2020.bin / 'meshlab'], large_plush)
    try:
        # Of a pattern's layer only a part is in view, and of a bear in three charts two.
        least = gui.colors() + (1 if name.endswith('Pattern') else 2)
        try:
            gui.apply(name)
            gui.wait_for_colors(least)
        finally:
            screen.save_screen(screenshots / f'2020 {name}.png'.replace(': ', ' '))
        assert gui.has_line(r'\bcharts\b\W+[0-9]'), gui.output[-2000:]
        assert gui.colors() >= least, 'no coloured charts on the screen'
    finally:
        gui.close()


def test_all_filters_and_what_they_show(screen, meshlab_2020, screenshots):
    """The pictures of docs/meshlab-window.md were made here."""
    gui = MeshlabGui(screen, [meshlab_2020.bin / 'meshlab'], ROOT / 'meshes' / 'cad_part.ply')
    apply_all(gui, lambda name: screenshots / f'2020 window {name}.png')
