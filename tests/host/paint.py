# SPDX-License-Identifier: GPL-3.0-or-later
"""Values on a mesh that no filter would write, to see whether they stay."""


def paint(ms):
    """Sets the current mesh's face quality, face colour and wedge texcoords."""
    ms.compute_texcoord_parametrization_triangle_trivial_per_wedge(sidedim=0)
    ms.compute_scalar_by_function_per_face(q='fi * 0.37 - 5')
    ms.compute_color_by_function_per_face(r='127 + 100 * sin(fi)', g='127 + 100 * cos(fi)', b='17', a='255')
