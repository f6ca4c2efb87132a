# SPDX-License-Identifier: GPL-3.0-or-later
"""The GUI of MeshLab 2020.09, by keyboard, and what is then to be seen."""
import pytest

from meshlab_gui import MeshlabGui


@pytest.mark.parametrize('name', ['D-Charts: Segment', 'D-Charts: Texture Atlas', 'D-Charts: Pattern'])
def test_filter_colors_the_charts(screen, meshlab_2020, large_plush, screenshots, name):
    gui = MeshlabGui(screen, [meshlab_2020.bin / 'meshlab'], large_plush)
    try:
        before = gui.colors()
        try:
            gui.apply(name)
        finally:
            screen.save_screen(screenshots / f'2020 {name}.png'.replace(': ', ' '))
        assert gui.has_line(r'\bcharts\b\W+[0-9]'), gui.output[-2000:]
        # Of a pattern's layer only a part is in view.
        assert gui.colors() >= before + (1 if name.endswith('Pattern') else 3), 'no coloured charts on the screen'
    finally:
        gui.close()
