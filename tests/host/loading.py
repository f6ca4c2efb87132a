# SPDX-License-Identifier: GPL-3.0-or-later
"""A mesh file in pymeshlab."""


def load(path):
    """A MeshSet with the mesh; meshes live no longer than their set."""
    import pymeshlab  # tests that can do without it skip when it is not there

    ms = pymeshlab.MeshSet()
    ms.load_new_mesh(str(path))
    return ms
