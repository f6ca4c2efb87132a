# SPDX-License-Identifier: GPL-3.0-or-later
"""The GUI of MeshLab 2020.09, by keyboard, and what is then to be seen."""
import time

import numpy as np
import pytest

from cases import FILTERS, ROOT
from meshlab_gui import MeshlabGui
from mlx import field_number


@pytest.mark.parametrize('name', ['D-Charts: Segment', 'D-Charts: Texture Atlas', 'D-Charts: Pattern'])
def test_filter_colors_the_charts(screen, meshlab_2020, large_plush, screenshots, name):
    gui = MeshlabGui(screen, [meshlab_2020.bin / 'meshlab'], large_plush)
    try:
        # Of a pattern's layer only a part is in view.
        least = gui.colors() + (1 if name.endswith('Pattern') else 3)
        try:
            gui.apply(name)
            gui.wait_for_colors(least)
        finally:
            screen.save_screen(screenshots / f'2020 {name}.png'.replace(': ', ' '))
        assert gui.has_line(r'\bcharts\b\W+[0-9]'), gui.output[-2000:]
        assert gui.colors() >= least, 'no coloured charts on the screen'
    finally:
        gui.close()


def changed(before, after):
    """How many pixels of the 3D view are others."""
    return int((np.abs(after.astype(int) - before) > 40).any(2)[100:760, :860].sum())


def test_all_filters_and_what_they_show(screen, meshlab_2020, screenshots):
    """One after the other, each by its dialog. The pictures of docs/meshlab-window.md were made here."""
    gui = MeshlabGui(screen, [meshlab_2020.bin / 'meshlab'], ROOT / 'meshes' / 'cad_part.ply')

    def picture(name):
        screen.save_screen(screenshots / f'2020 window {name}.png')
        return screen.screen()

    try:
        plain = screen.screen()
        for name, (_, parameters) in FILTERS.items():
            if not parameters:
                gui.apply_at_once(name)
                continue
            gui.apply(name, ticked=[field_number(name, 'seam_layer')] if name == 'D-Charts: Cut' else (),
                      typed={field_number(name, 'size'): '150'} if name == 'D-Charts: Pattern' else None)
            if name == 'D-Charts: Segment':
                assert changed(plain, picture('segment')) > 50000, 'the charts have no colours'
            if name == 'D-Charts: Merge':
                merged = screen.screen()
            if name == 'D-Charts: Cut':
                assert changed(merged, picture('cut')) > 200, 'the seams are not seen'
            if name == 'D-Charts: Parameterize':
                mesh = screen.screen()
                gui.choose('Show UV Tex Param')
                time.sleep(3)
                assert changed(mesh, picture('uv')) > 5000, 'the atlas is not seen'
                gui.choose('Show UV Tex Param')  # off again
        gui.session.keys('ctrl+h')
        time.sleep(2)
        picture('pattern')
        assert all(len(gui.applied(name)) == 1 for name in FILTERS)
    finally:
        gui.close()
