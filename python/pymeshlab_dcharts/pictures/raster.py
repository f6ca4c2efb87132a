# SPDX-License-Identifier: GPL-3.0-or-later
"""A small z-buffer rasterizer in numpy: which triangle is seen at which pixel."""
from dataclasses import dataclass

import numpy as np

CANDIDATES_AT_ONCE = 400_000


@dataclass
class Seen:
    """What the pixels of a picture show; only those where there is something, k in number, row by row."""

    shape: tuple  #: height and width of the picture
    pixel: np.ndarray  #: k: row * width + column
    face: np.ndarray  #: k: index of the triangle in front
    weights: np.ndarray  #: k by 3: barycentric coordinates of the pixel's centre in it
    depth: np.ndarray  #: k: larger is farther

    def interpolate(self, corner_values):
        """Values at the triangles' corners (faces by 3 by n), at the pixels (k by n)."""
        corner_values = np.asarray(corner_values, np.float32)
        return np.einsum("pc,pcn->pn", self.weights, corner_values[self.face])

    def spread(self, values, background):
        """A picture (height by width by n) with values (k by n, or k) where there is something and one value elsewhere."""
        values = np.asarray(values)
        picture = np.empty((self.shape[0] * self.shape[1],) + values.shape[1:], values.dtype)
        picture[:] = background
        picture[self.pixel] = values
        return picture.reshape(self.shape + values.shape[1:])


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


def _parts(points, faces):
    """Splits the faces in runs whose bounding boxes together hold about CANDIDATES_AT_ONCE pixels."""
    boxes = np.prod(np.ptp(points[faces], axis=1) + 1, axis=1)
    run = (np.cumsum(boxes) // CANDIDATES_AT_ONCE).astype(np.int64)
    starts = np.r_[0, np.flatnonzero(np.diff(run)) + 1, len(faces)] if len(faces) else [0, 0]
    return zip(starts[:-1], starts[1:])


def rasterize(points, depths, faces, width, height):
    """Draws triangles with hidden surfaces removed.

    points: n by 2, in pixels, x to the right, y down; depths: n, larger is farther; faces: m by 3.
    Both sides of a triangle are drawn. Returns Seen.
    """
    points = np.asarray(points, float)
    faces = np.asarray(faces)
    face = np.full(width * height, -1, np.int32)
    weights = np.zeros((width * height, 2), np.float32)
    depth = np.full(width * height, np.inf, np.float32)
    for start, end in _parts(points, faces):
        part = faces[start:end]
        owner, x, y = _candidates(points, width, height, part)
        a, b, c = (points[part[:, i]] for i in range(3))
        double_area = (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0])
        # Each weight is a linear function of the pixel.
        with np.errstate(divide="ignore", invalid="ignore"):
            slopes_a = np.stack([b[:, 1] - c[:, 1], c[:, 0] - b[:, 0]], 1) / double_area[:, None]
            slopes_b = np.stack([c[:, 1] - a[:, 1], a[:, 0] - c[:, 0]], 1) / double_area[:, None]
            from_c = 0.5 - c
            at_a = (slopes_a * from_c).sum(1)
            at_b = (slopes_b * from_c).sum(1)
            wa = at_a[owner] + slopes_a[owner, 0] * x + slopes_a[owner, 1] * y
            wb = at_b[owner] + slopes_b[owner, 0] * x + slopes_b[owner, 1] * y
            inside = np.flatnonzero((wa >= -1e-9) & (wb >= -1e-9) & (wa + wb <= 1 + 1e-9))
        wa, wb, owner, pixel = wa[inside], wb[inside], owner[inside], (y * width + x)[inside]
        za, zb, zc = (depths[part[:, i]] for i in range(3))
        z = (zc[owner] + wa * (za - zc)[owner] + wb * (zb - zc)[owner]).astype(np.float32)
        front = np.flatnonzero(z < depth[pixel])
        front = front[np.lexsort((z[front], pixel[front]))]
        front = front[np.diff(pixel[front], prepend=-1) != 0]
        pixel = pixel[front]
        face[pixel] = owner[front] + start
        weights[pixel, 0] = wa[front]
        weights[pixel, 1] = wb[front]
        depth[pixel] = z[front]
    hit = np.flatnonzero(face >= 0)
    wa, wb = weights[hit].T
    return Seen((height, width), hit, face[hit], np.stack([wa, wb, 1 - wa - wb], 1), depth[hit])


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
