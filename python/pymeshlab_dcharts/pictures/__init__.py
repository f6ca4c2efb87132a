# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of a segmented mesh and of its texture atlas, made with numpy and Pillow; needs no display."""
from .compose import Model, atlas_picture, chart_colors, charts_picture, checker_image

__all__ = ["Model", "atlas_picture", "chart_colors", "charts_picture", "checker_image"]
