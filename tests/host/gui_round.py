# SPDX-License-Identifier: GPL-3.0-or-later
"""All filters in one window, one after the other, each by its dialog; what is then to be seen there."""
import time

import numpy as np

from cases import FILTERS
from mlx import field_number


def changed(before, after):
    """How many pixels of the 3D view are others."""
    return int((np.abs(after.astype(int) - before) > 40).any(2)[100:760, :860].sum())


def apply_all(gui, file_of, uv_line=1):
    """`gui` shows meshes/cad_part.ply; it is closed. `file_of`: the file of a picture's name; `uv_line`: in which line the
    search box finds Show UV Tex Param."""

    def picture(name):
        gui.session.save_screen(file_of(name))
        return gui.session.screen()

    try:
        plain = gui.session.screen()
        for name, (_, parameters) in FILTERS.items():
            if not parameters:
                gui.apply_at_once(name)
                continue
            gui.apply(name, ticked=[field_number(name, 'seam_layer')] if name == 'D-Charts: Cut' else (),
                      typed={field_number(name, 'size'): '150'} if name == 'D-Charts: Pattern' else None)
            if name == 'D-Charts: Segment':
                assert changed(plain, picture('segment')) > 50000, 'the charts have no colours'
            if name == 'D-Charts: Merge':
                merged = gui.session.screen()
            if name == 'D-Charts: Cut':
                assert changed(merged, picture('cut')) > 200, 'the seams are not seen'
            if name == 'D-Charts: Parameterize':
                mesh = gui.session.screen()
                gui.choose('Show UV Tex Param', uv_line)
                time.sleep(3)
                assert changed(mesh, picture('uv')) > 5000, 'the atlas is not seen'
                gui.choose('Show UV Tex Param', uv_line)
                time.sleep(3)
                assert changed(mesh, gui.session.screen()) < 1000, 'it was something else that was seen'
        gui.session.keys('ctrl+h')
        time.sleep(2)
        picture('pattern')
        assert all(len(gui.applied(name)) == 1 for name in FILTERS)
    finally:
        gui.close()
