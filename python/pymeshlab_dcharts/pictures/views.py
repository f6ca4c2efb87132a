# SPDX-License-Identifier: GPL-3.0-or-later
"""From where to look at a model: which way is up, and which views together show most of it."""
import numpy as np

from .raster import rasterize


def guess_up(vertices):
    """The axis (unit vector) that most likely points up: on the far side the model has something broad to stand on.

    y or z, by preference up; tells apart what models usually are, and is only a guess.
    """
    low, high = vertices.min(0), vertices.max(0)
    size = np.maximum(high - low, 1e-12)
    best, best_score = np.array([0.0, 0.0, 1.0]), -1.0
    for axis, sign, prior in ((2, 1, 1.0), (1, 1, 1.0), (1, -1, 0.6), (2, -1, 0.6)):
        ground = low[axis] if sign > 0 else high[axis]
        touching = vertices[np.abs(vertices[:, axis] - ground) < 0.03 * size[axis]]
        across = [i for i in range(3) if i != axis]
        footprint = np.prod(np.ptp(touching[:, across], axis=0) / size[across])
        balanced = np.all((vertices.mean(0) > touching.min(0) - 0.1 * size)[across]) and np.all(
            (vertices.mean(0) < touching.max(0) + 0.1 * size)[across]
        )
        score = prior * footprint * (1.0 if balanced else 0.3)
        if score > best_score + 1e-9:
            best, best_score = sign * np.eye(3)[axis], score
    return best


def camera(up, azimuth, elevation):
    """Rotation matrix whose rows are the picture's right, the picture's up and the direction towards the eye.

    azimuth and elevation in degrees.
    """
    side = np.eye(3)[np.argmin(np.abs(up))]
    east = np.cross(up, side)
    north = np.cross(up, east)
    a, e = np.radians([azimuth, elevation])
    towards = np.cos(e) * (np.cos(a) * east + np.sin(a) * north) + np.sin(e) * up
    right = np.cross(up, towards)
    right /= np.linalg.norm(right)
    return np.stack([right, np.cross(towards, right), towards])


def project(vertices, view, width, height, margin):
    """Pixels (n by 2) and depths (n) of an orthographic picture with the model in its middle; and pixels per unit."""
    turned = vertices @ view.T
    low, high = turned[:, :2].min(0), turned[:, :2].max(0)
    scale = min((np.array([width, height]) - 2 * margin) / np.maximum(high - low, 1e-12))
    pixels = (turned[:, :2] - (low + high) / 2) * [scale, -scale] + [width / 2, height / 2]
    return pixels, -turned[:, 2] * scale, scale


def choose_views(vertices, faces, face_areas, up, count, size=110):
    """`count` cameras that together see most of the surface, the best one first."""
    candidates = [camera(up, azimuth, 18) for azimuth in range(15, 375, 30)]
    candidates += [camera(up, azimuth, 55) for azimuth in range(30, 390, 60)]
    candidates += [camera(up, azimuth, -25) for azimuth in range(30, 390, 60)]
    corners = vertices[faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
    worth = []
    for view in candidates:
        pixels, depths, scale = project(vertices, view, size, size, 2)
        seen = rasterize(pixels, depths, faces, size, size)
        front = seen.spread(seen.depth, np.inf)
        x, y = np.floor(pixels[faces].mean(1)).astype(int).clip(0, size - 1).T
        near = depths[faces].mean(1) < front[y, x] + 2.5
        facing = np.abs(normals @ view[2])
        worth.append(np.where(near & (facing > 0.15), face_areas * facing, 0))
    worth = np.array(worth)
    worth[12:] *= 0.85  # people look at things from the side first
    shown = np.zeros(len(faces))
    chosen = []
    for _ in range(count):
        gains = np.maximum(worth - shown, 0).sum(1)
        best = int(np.argmax(gains))
        chosen.append(candidates[best])
        shown = np.maximum(shown, worth[best])
    return chosen
