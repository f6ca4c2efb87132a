# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes made for the benchmarks."""

import numpy as np
import pymeshlab


def noisy(vertices, faces, share, seed=5):
    """Normal noise on each coordinate, its standard deviation a share of the mean edge; always the same for a seed."""
    mean_edge = np.linalg.norm(vertices[faces] - vertices[np.roll(faces, 1, axis=1)], axis=2).mean()
    return vertices + np.random.default_rng(seed).normal(0, share * mean_edge, vertices.shape)


def quartered(vertices, faces):
    """Every face split in four at the middles of its edges: the same surface."""
    edges = np.sort(faces[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    pairs, middle = np.unique(edges, axis=0, return_inverse=True)
    a, b, c = faces.T
    ab, bc, ca = middle.reshape(-1, 3).T + len(vertices)
    parts = ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))
    return np.vstack([vertices, vertices[pairs].mean(axis=1)]), np.stack([np.stack(p, 1) for p in parts], 1).reshape(-1, 3)


def save(path, vertices, faces):
    ms = pymeshlab.MeshSet()
    ms.add_mesh(pymeshlab.Mesh(vertices, faces))
    ms.save_current_mesh(str(path))
    return path
