# SPDX-License-Identifier: GPL-3.0-or-later
"""D-Charts for pymeshlab: nearly developable charts and texture atlases.

Importing this module loads the plugin into pymeshlab and adds its filters to ``pymeshlab.MeshSet``:

    import pymeshlab, pymeshlab_dcharts
    ms = pymeshlab.MeshSet()
    ms.load_new_mesh("model.ply")
    figures = ms.dcharts_texture_atlas()
    ms.save_current_mesh("atlas.obj")

``help(pymeshlab.MeshSet.dcharts_texture_atlas)`` describes a filter and its parameters.
"""

from ._load import PLUGIN, filters

__all__ = ["PLUGIN", "filters"]
