# SPDX-License-Identifier: GPL-3.0-or-later
"""The two pictures of a result, charts.png and atlas.png, and the checker texture."""
import numpy as np
from PIL import Image, ImageDraw, ImageFont

from .raster import rasterize, shrink, stamp_lines
from .shading import corner_normals, light
from .views import choose_views, guess_up, project

SUPERSAMPLING = 2
PAPER = np.array([1.0, 1.0, 1.0], np.float32)
DESK = np.array([0.93, 0.93, 0.94], np.float32)  # behind the atlas
INK = np.array([0.10, 0.10, 0.13], np.float32)
MARK = np.array([0.85, 0.05, 0.10], np.float32)
UNASSIGNED = np.array([0.75, 0.75, 0.75], np.float32)


def chart_colors(count):
    """`count` soft colours (0..1), neighbours in number far apart in hue."""
    k = np.arange(count)
    hue = (0.08 + k * 0.61803398875) % 1
    saturation = np.array([0.50, 0.62, 0.38])[(k // 3) % 3]
    value = np.array([0.97, 0.88])[k % 2]
    channel = (hue[:, None] * 6 + np.array([5, 3, 1])) % 6
    return value[:, None] * (1 - saturation[:, None] * np.clip(np.minimum(channel, 4 - channel), 0, 1))



class Model:
    """A mesh with charts and texture coordinates, ready to be drawn.

    vertices n by 3; faces m by 3; chart_ids m (-1: none); uvs m by 3 by 2, or None;
    colors m by 3 (0..1) or None for colours made from the chart ids.
    """

    def __init__(self, vertices, faces, chart_ids, uvs=None, colors=None):
        self.vertices = np.asarray(vertices, float)
        self.faces = np.asarray(faces)
        self.chart_ids = np.asarray(chart_ids).round().astype(int)
        self.uvs = None if uvs is None else np.asarray(uvs, float).reshape(-1, 3, 2)
        if colors is None:
            palette = np.vstack([chart_colors(max(self.chart_ids.max(initial=-1) + 1, 0)), UNASSIGNED])
            colors = palette[self.chart_ids]
        self.colors = np.asarray(colors, np.float32)
        corners = self.vertices[self.faces]
        self.areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) / 2
        self.normals = corner_normals(self.vertices, self.faces)
        #: cameras that together see most of it, the best one first
        self.views = choose_views(self.vertices, self.faces, self.areas, guess_up(self.vertices), 3)
        self.seam_corners = self._seam_corners()

    def _seam_corners(self):
        """(face, corner) of every edge from that corner to the next that is a border, in space or in the texture, of a chart."""
        start = self.faces.ravel()
        end = self.faces[:, [1, 2, 0]].ravel()
        face = np.repeat(np.arange(len(self.faces)), 3)
        corner = np.tile(np.arange(3), len(self.faces))
        low, high = np.minimum(start, end), np.maximum(start, end)
        order = np.lexsort((high, low))
        same = (low[order][1:] == low[order][:-1]) & (high[order][1:] == high[order][:-1])
        group = np.r_[0, np.cumsum(~same)]
        sizes = np.bincount(group)
        seam = sizes[group] != 2
        first = np.flatnonzero(same & (sizes[group][:-1] == 2))
        a, b = order[first], order[first + 1]
        differs = self.chart_ids[face[a]] != self.chart_ids[face[b]]
        if self.uvs is not None:
            uv = self.uvs.reshape(-1, 2)
            next_a, next_b = face[a] * 3 + (corner[a] + 1) % 3, face[b] * 3 + (corner[b] + 1) % 3
            turned = start[a] == end[b]
            at_start, at_end = np.where(turned, next_b, b), np.where(turned, b, next_b)
            differs |= (uv[a] != uv[at_start]).any(1) | (uv[next_a] != uv[at_end]).any(1)
        seam[first] = differs
        seam[first + 1] = differs
        chosen = order[seam]
        return face[chosen], corner[chosen]

    def draw(self, view, width, height, colors_at, line_width, marked=None):
        """A picture (height by width by 3, 0..1) of the model on paper; colors_at(seen) gives the unlit colours.

        marked: a bool for each of seam_corners; those are drawn wider, in red.
        """
        big_width, big_height = width * SUPERSAMPLING, height * SUPERSAMPLING
        pixels, depths, _ = project(self.vertices, view, big_width, big_height, 0.05 * min(big_width, big_height))
        seen = rasterize(pixels, depths, self.faces, big_width, big_height)
        size = np.ptp(pixels, axis=0).max()
        lit = light(colors_at(seen), seen.interpolate(self.normals), view, seen, size)

        face, corner = self.seam_corners
        # A seam on the far side stays hidden; on slopes the depth changes much within a pixel.
        nearest = seen.spread(seen.depth, np.inf)
        front = nearest.copy()
        for shift in (-1, 1):
            for axis in (0, 1):
                beside = np.roll(nearest, shift, axis)
                front = np.where(np.isfinite(beside), np.maximum(front, np.minimum(beside, front + 0.01 * size)), front)

        def visible(columns, rows, segment, t):
            z = depths[a[segment]] * (1 - t) + depths[b[segment]] * t
            return z < front[rows, columns] + 0.004 * size

        marked = np.zeros(len(face), bool) if marked is None else marked
        for some, ink, wider in ((~marked, INK, 1), (marked, MARK, 1.6)):
            a, b = self.faces[face, corner][some], self.faces[face, (corner + 1) % 3][some]
            lines = np.zeros(seen.shape, bool)
            stamp_lines(lines, pixels[a], pixels[b], wider * line_width * SUPERSAMPLING / 2, visible)
            on_line = lines.ravel()[seen.pixel]
            lit[on_line] = 0.15 * lit[on_line] + 0.85 * ink
        return shrink(seen.spread(lit, PAPER), SUPERSAMPLING)


def checker(uv, cells):
    """0 or 1 at texture coordinates (... by 2)."""
    return (np.floor(uv[..., 0] * cells) + np.floor(uv[..., 1] * cells)) % 2


def checker_image(size=1024, cells=32):
    """The checker as a texture: grey-blue and nearly white fields. Returns a PIL image."""
    u = (np.arange(size) + 0.5) / size
    uv = np.stack(np.meshgrid(u, 1 - u), -1)
    return Image.fromarray(_to_bytes(_checker_colors(uv, cells)))


def _checker_colors(uv, cells):
    dark, pale = np.array([0.36, 0.47, 0.62]), np.array([0.96, 0.95, 0.91])
    return np.where(checker(uv, cells)[..., None] > 0, dark, pale)


def _to_bytes(picture):
    return (np.clip(picture, 0, 1) * 255 + 0.5).astype(np.uint8)


def _page(parts, title):
    """Pictures side by side, under a title if there is one."""
    gap = 24
    head = 74 if title else gap
    width = sum(p.shape[1] for p in parts) + gap * (len(parts) + 1)
    height = max(p.shape[0] for p in parts) + head + gap
    page = Image.new("RGB", (width, height), tuple(_to_bytes(PAPER).tolist()))
    ImageDraw.Draw(page).text((gap, 20), title, fill=tuple(_to_bytes(INK).tolist()), font=ImageFont.load_default(30))
    x = gap
    for part in parts:
        page.paste(Image.fromarray(_to_bytes(part)), (x, head))
        x += part.shape[1] + gap
    return page


def charts_picture(model, title, size=680):
    """The model from three sides, each chart in its colour, seams as dark lines. Returns a PIL image."""
    parts = [model.draw(view, size, size, lambda seen: model.colors[seen.face], 2.2) for view in model.views]
    return _page(parts, title)


def atlas_picture(model, title, cells=32, size=900, texture=None):
    """The atlas and the model with it: the charts in their colours under a checker, or with a texture.

    cells: fields of the checker along a side; size: of each picture, in pixels; texture: a PIL image that lies on the
    atlas, or None. Returns a PIL image.
    """
    big = size * SUPERSAMPLING
    points = model.uvs.reshape(-1, 2) * [big, -big] + [0, big]
    seen = rasterize(points, np.zeros(len(points)), np.arange(len(points)).reshape(-1, 3), big, big)

    def surface(seen, shade):
        return _checkered(model, seen, cells, shade) if texture is None else _textured(model, seen, texture)

    atlas = seen.spread(surface(seen, 0.80), DESK)
    face, corner = model.seam_corners
    corners = points.reshape(-1, 3, 2)
    lines = np.zeros(seen.shape, bool)
    stamp_lines(lines, corners[face, corner], corners[face, (corner + 1) % 3], 0.9 * SUPERSAMPLING)
    atlas[lines] = INK

    on_model = model.draw(model.views[0], size, size, lambda seen: surface(seen, 0.62), 2.2)
    return _page([shrink(atlas, SUPERSAMPLING), on_model], title)


def _checkered(model, seen, cells, shade):
    """The charts' colours, darker in every other field of the checker."""
    fields = checker(seen.interpolate(model.uvs), cells)
    return model.colors[seen.face] * np.where(fields > 0, shade, 1.0).astype(np.float32)[:, None]


def _textured(model, seen, texture):
    """The texture's colours, of the nearest texel."""
    texels = np.asarray(texture.convert("RGB"), np.float32) / 255
    uv = seen.interpolate(model.uvs)
    size = np.array(texels.shape[1::-1])
    at = np.clip((uv * [1, -1] + [0, 1]) * size, 0, size - 1).astype(int)
    return texels[at[:, 1], at[:, 0]]
