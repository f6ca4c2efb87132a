# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes made for the benchmarks."""

import numpy as np
import pymeshlab


def noisy(vertices, faces, share):
    """Normal noise on each coordinate, its standard deviation a share of the mean edge; always the same."""
    mean_edge = np.linalg.norm(vertices[faces] - vertices[np.roll(faces, 1, axis=1)], axis=2).mean()
    return vertices + np.random.default_rng(5).normal(0, share * mean_edge, vertices.shape)


def save(path, vertices, faces):
    ms = pymeshlab.MeshSet()
    ms.add_mesh(pymeshlab.Mesh(vertices, faces))
    ms.save_current_mesh(str(path))
    return path
