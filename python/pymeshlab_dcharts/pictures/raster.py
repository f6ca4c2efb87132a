# SPDX-License-Identifier: GPL-3.0-or-later
"""A small z-buffer rasterizer in numpy: which triangle is seen at which pixel."""
from dataclasses import dataclass

import numpy as np

NOTHING = -1


@dataclass
class Seen:
    """What each pixel of a picture shows; arrays of height by width."""

    face: np.ndarray  #: index of the triangle in front, or NOTHING
    weights: np.ndarray  #: by 3: barycentric coordinates of the pixel's centre in it
    depth: np.ndarray  #: larger is farther, infinite where nothing is

    def interpolate(self, corner_values):
        """Values at the triangles' corners (faces by 3 by k), at every pixel (height by width by k); 0 where nothing is."""
        corner_values = np.asarray(corner_values)
        hit = self.face != NOTHING
        values = np.zeros(self.face.shape + corner_values.shape[2:])
        values[hit] = np.einsum("pc,pck->pk", self.weights[hit], corner_values[self.face[hit]])
        return values


def _candidates(points, width, height, faces):
    """Pairs (triangle, pixel) with the pixel's centre in the triangle's bounding box."""
    low = np.ceil(points[faces].min(1) - 0.5).astype(np.int64).clip(0)
    high = np.floor(points[faces].max(1) - 0.5).astype(np.int64).clip(max=[width - 1, height - 1])
    size = (high - low + 1).clip(0)
    counts = size[:, 0] * size[:, 1]
    owner = np.repeat(np.arange(len(faces)), counts)
    within = np.arange(len(owner)) - np.repeat(np.cumsum(counts) - counts, counts)
    columns = np.maximum(size[owner, 0], 1)
    return owner, low[owner, 0] + within % columns, low[owner, 1] + within // columns


def rasterize(points, depths, faces, width, height, faces_at_once=20000):
    """Draws triangles with hidden surfaces removed.

    points: n by 2, in pixels, x to the right, y down; depths: n, larger is farther; faces: m by 3.
    Both sides of a triangle are drawn. Returns Seen.
    """
    points = np.asarray(points, float)
    faces = np.asarray(faces)
    face = np.full(width * height, NOTHING)
    weights = np.zeros((width * height, 3), np.float32)
    depth = np.full(width * height, np.inf)
    for start in range(0, len(faces), faces_at_once):
        part = faces[start : start + faces_at_once]
        owner, x, y = _candidates(points, width, height, part)
        a, b, c = (points[part[:, i]] for i in range(3))
        double_area = (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0])
        with np.errstate(divide="ignore", invalid="ignore"):
            scale = (1 / double_area)[owner]
            px, py = x + 0.5, y + 0.5
            wa = ((b[owner, 0] - px) * (c[owner, 1] - py) - (b[owner, 1] - py) * (c[owner, 0] - px)) * scale
            wb = ((c[owner, 0] - px) * (a[owner, 1] - py) - (c[owner, 1] - py) * (a[owner, 0] - px)) * scale
            inside = np.flatnonzero((wa >= -1e-9) & (wb >= -1e-9) & (wa + wb <= 1 + 1e-9))
        wa, wb, owner, pixel = wa[inside], wb[inside], owner[inside], (y * width + x)[inside]
        w = np.stack([wa, wb, 1 - wa - wb], 1)
        z = (w * depths[part[owner]]).sum(1)
        front = np.lexsort((z, pixel))
        front = front[np.r_[True, np.diff(pixel[front]) != 0]] if len(front) else front
        front = front[z[front] < depth[pixel[front]]]
        face[pixel[front]] = owner[front] + start
        weights[pixel[front]] = w[front]
        depth[pixel[front]] = z[front]
    return Seen(face.reshape(height, width), weights.reshape(height, width, 3), depth.reshape(height, width))


def shrink(pixels, factor):
    """Means of factor by factor pixels: the picture without jagged edges."""
    height, width, channels = pixels.shape
    return pixels.reshape(height // factor, factor, width // factor, factor, channels).mean((1, 3))


def stamp_lines(mask, starts, ends, radius, visible=None):
    """Sets `mask` along line segments (n by 2 points, pixels), `radius` pixels to each side.

    visible(columns, rows, segment, t): which of the samples at parameter t of the segments are to be drawn.
    """
    lengths = np.linalg.norm(ends - starts, axis=1)
    counts = np.ceil(lengths / 0.7).astype(np.int64) + 2
    segment = np.repeat(np.arange(len(starts)), counts)
    t = (np.arange(len(segment)) - np.repeat(np.cumsum(counts) - counts, counts)) / np.repeat(counts - 1, counts)
    samples = starts[segment] + t[:, None] * (ends - starts)[segment]
    height, width = mask.shape
    columns, rows = np.floor(samples).astype(np.int64).T
    inside = (columns >= 0) & (columns < width) & (rows >= 0) & (rows < height)
    columns, rows, segment, t = columns[inside], rows[inside], segment[inside], t[inside]
    if visible is not None:
        shown = visible(columns, rows, segment, t)
        columns, rows = columns[shown], rows[shown]
    reach = int(np.ceil(radius))
    thin = np.zeros_like(mask)
    thin[rows, columns] = True
    padded = np.pad(thin, reach)
    for dy in range(-reach, reach + 1):
        for dx in range(-reach, reach + 1):
            if dx * dx + dy * dy <= radius * radius:
                mask |= padded[reach + dy : reach + dy + height, reach + dx : reach + dx + width]
