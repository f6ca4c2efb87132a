# SPDX-License-Identifier: GPL-3.0-or-later
"""Light on a rasterized model."""
import numpy as np


def corner_normals(vertices, faces, crease_degrees=35):
    """Unit normals at every face's corners (faces by 3 by 3): smooth, but not across creases sharper than the angle."""
    corners = vertices[faces]
    weighted = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    unit = weighted / np.maximum(np.linalg.norm(weighted, axis=1, keepdims=True), 1e-300)
    # All pairs of corners at the same vertex.
    order = np.argsort(faces.ravel(), kind="stable")
    at = faces.ravel()[order]
    first = np.searchsorted(at, at, "left")
    count = np.searchsorted(at, at, "right") - first
    me = np.repeat(np.arange(len(at)), count)
    other = first[me] + np.arange(len(me)) - np.repeat(np.cumsum(count) - count, count)
    my_face, other_face = order[me] // 3, order[other] // 3
    alike = (unit[my_face] * unit[other_face]).sum(1) > np.cos(np.radians(crease_degrees))
    normals = np.zeros((len(at), 3))
    for axis in range(3):
        normals[order, axis] = np.bincount(
            me[alike], weighted[other_face[alike], axis], minlength=len(at)
        )
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    normals = np.where(lengths > 0, normals / np.maximum(lengths, 1e-300), np.repeat(unit, 3, axis=0))
    return normals.reshape(-1, 3, 3)


def _blur(values, radius):
    """Three box filters, nearly a Gaussian."""
    for _ in range(3):
        for axis in (0, 1):
            padded = np.pad(values, [(radius + 1, radius) if k == axis else (0, 0) for k in (0, 1)], mode="edge")
            sums = np.moveaxis(np.cumsum(padded, axis=axis), axis, 0)
            values = np.moveaxis((sums[2 * radius + 1 :] - sums[: -2 * radius - 1]) / (2 * radius + 1), 0, axis)
    return values


def hollow_shadow(depth, size):
    """0..1 per pixel: how much a pixel lies behind its surroundings.

    depth: height by width, in pixels, infinite where nothing is; size: of the model in the picture, in pixels.
    """
    solid = np.isfinite(depth)
    plain = np.where(solid, depth, 0)
    shadow = np.zeros_like(plain)
    for radius in (max(2, int(size * 0.012)), max(3, int(size * 0.045))):
        around = _blur(plain, radius) / np.maximum(_blur(solid.astype(np.float32), radius), 1e-6)
        shadow += np.clip((plain - around) / (1.6 * radius), 0, 1) / 2
    return shadow


def light(colors, normals, view, seen, size):
    """Lit colours (k by 3, 0..1) of the seen pixels from plain ones and normals in space; size as in hollow_shadow."""
    # Half the resolution is plenty for a soft shadow; depths are in pixels, so they shrink too.
    depth = seen.spread(seen.depth, np.inf)
    small = hollow_shadow(depth[::2, ::2] / 2, size / 2)
    width = seen.shape[1]
    shadow = small[seen.pixel // width // 2, seen.pixel % width // 2]
    eye = normals @ view.T.astype(np.float32)
    eye /= np.maximum(np.linalg.norm(eye, axis=1, keepdims=True), 1e-9)
    eye *= np.where(eye[:, 2:] < 0, -1, 1)  # inner sides are lit too

    def lamp(*towards):
        return np.clip(eye @ (np.array(towards, np.float32) / np.linalg.norm(towards)), 0, None)

    key = np.array([-0.45, 0.65, 0.7])
    diffuse = 0.56 + 0.10 * eye[:, 1] + 0.40 * lamp(*key) + 0.14 * lamp(0.9, 0.1, 0.5)
    gloss = 0.13 * lamp(*(key / np.linalg.norm(key) + [0, 0, 1])) ** 40
    return np.clip(colors * (diffuse * (1 - 0.5 * shadow))[:, None] + gloss[:, None], 0, 1)
