# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures for notebooks: the charts on the model, the atlas, the pattern's sheet. Needs matplotlib and Pillow.

    from pymeshlab_dcharts.show import show_charts, show_atlas, show_pattern

Each returns a matplotlib Figure, which a notebook shows when it is the last line of a cell; ``figure.savefig("a.png")``
writes it. The current mesh of the MeshSet is what is shown; it stays as it is.
"""

import base64
import io
import re
import xml.etree.ElementTree as ElementTree

import numpy as np

try:
    from matplotlib.figure import Figure
    from matplotlib.textpath import TextPath
    from PIL import Image
except ImportError as error:
    raise ImportError(
        f"pymeshlab_dcharts.show needs {error.name}. Install it: pip install matplotlib Pillow", name=error.name
    ) from error

from .pictures import Model, atlas_picture, charts_picture

__all__ = ["show_charts", "show_atlas", "show_pattern"]

_INCH = 25.4  # mm
_SVG = "{http://www.w3.org/2000/svg}"
_HREF = "{http://www.w3.org/1999/xlink}href"


class _Figure(Figure):
    """Shows itself in a notebook, without %matplotlib."""

    def _repr_png_(self):
        png = io.BytesIO()
        self.savefig(png, format="png", dpi=72)
        return png.getvalue()


def _model(ms):
    mesh = ms.current_mesh()
    if mesh.face_number() == 0:
        raise ValueError("The current mesh has no faces. Choose another with set_current_mesh().")
    charts = mesh.face_scalar_array() if mesh.has_face_scalar() else np.full(mesh.face_number(), -1)
    # Quality that is no chart number (another filter's, or NaN) has no colour of its own.
    charts = np.where(np.isfinite(charts) & (charts >= 0) & (charts < mesh.face_number()), charts, -1)
    uvs = mesh.wedge_tex_coord_matrix() if mesh.has_wedge_tex_coord() else None
    return Model(mesh.vertex_matrix(), mesh.face_matrix(), charts, uvs)


def _figure(picture, width):
    figure = _Figure(figsize=(width, width * picture.height / picture.width))
    axes = figure.add_axes([0, 0, 1, 1])
    axes.imshow(picture)
    axes.axis("off")
    return figure


def show_charts(ms, title="", width=10):
    """The current mesh from three sides, each chart (face quality) in a colour of its own, seams as dark lines.

    title: a line above the pictures; width: of the figure, in inches. Returns a matplotlib Figure.
    Raises ValueError when the mesh has no faces.
    """
    return _figure(charts_picture(_model(ms), title), width)


def show_atlas(ms, texture=None, title="", width=10):
    """The texture atlas of the current mesh (wedge texcoords), and the mesh with it.

    texture: the file of an image that lies on the atlas, or a PIL image; None draws a checker. title and width as in
    show_charts. Returns a matplotlib Figure. Raises ValueError when the mesh has no texcoords.
    """
    model = _model(ms)
    if model.uvs is None:
        raise ValueError("The current mesh has no texture coordinates. Run dcharts_texture_atlas() first.")
    if texture is not None and not isinstance(texture, Image.Image):
        texture = Image.open(texture)
    return _figure(atlas_picture(model, title, texture=texture), width)


def show_pattern(svg_file, assembly=False, width=10):
    """The pieces of a pattern that dcharts_pattern(output_file="....svg") wrote, or what is said of their assembly.

    assembly: shows the model with its pieces numbered and the table of seams instead of the pieces; width: of the figure,
    in inches; the drawing is scaled to it. Returns a matplotlib Figure. Raises ValueError when the file is no pattern.
    """
    try:
        root = ElementTree.parse(svg_file).getroot()
    except ElementTree.ParseError as error:
        raise ValueError(f"{svg_file} is no SVG that dcharts_pattern wrote.") from error
    groups = [g for g in root.iter(_SVG + "g") if g.get("class") in ("piece", "sheet") and g in list(root)]
    groups = [g for g in groups if g.get("id", "").startswith("assembly") == assembly]
    low, high = _bounds(groups)
    if not np.all(low < high):
        raise ValueError(f"{svg_file} is no SVG that dcharts_pattern wrote.")
    size = high - low
    points_per_mm = width * 72 / size[0]
    figure = _Figure(figsize=(width, width * size[1] / size[0]))
    axes = figure.add_axes([0, 0, 1, 1])
    axes.axis("off")
    for element in (e for group in groups for e in group.iter()):
        if element.tag == _SVG + "path":
            _draw_path(axes, element, points_per_mm)
        elif element.tag == _SVG + "text":
            _draw_text(axes, element, points_per_mm)
        elif element.tag == _SVG + "image":
            _draw_image(axes, element)
    axes.set(xlim=(low[0], high[0]), ylim=(high[1], low[1]))
    return figure


def _bounds(groups, margin=4):
    """Lower and upper corner of what lies in the groups, in mm."""
    points = [np.reshape(_numbers(e.get("d")), (-1, 2)) for group in groups for e in group.iter(_SVG + "path")]
    for element in (e for group in groups for e in group.iter(_SVG + "text")):
        middle, angle = _place(element)
        half = float(element.get("textLength", 0)) / 2 * np.array([np.cos(angle), np.sin(angle)])
        points.append(np.stack([middle - half, middle + half]))
    points = np.vstack(points or [np.empty((0, 2))])
    return points.min(0, initial=np.inf) - margin, points.max(0, initial=-np.inf) + margin


def _numbers(text):
    return [float(n) for n in re.findall(r"-?\d+\.?\d*(?:e-?\d+)?", text)]


def _draw_path(axes, element, points_per_mm):
    """Our paths are polylines in absolute coordinates, closed when they end in Z."""
    color, fill = element.get("stroke", "none"), element.get("fill", "none")
    for part in element.get("d").split("M")[1:]:
        points = np.reshape(_numbers(part), (-1, 2))
        if part.rstrip().endswith("Z"):
            points = np.vstack([points, points[:1]])
        if fill != "none":
            axes.fill(points[:, 0], points[:, 1], color=fill, linewidth=0)
        if color == "none":
            continue
        wide = max(float(element.get("stroke-width", 0.2)) * points_per_mm, 0.3)
        dashes = _numbers(element.get("stroke-dasharray", ""))
        # matplotlib counts dashes in widths of the line.
        style = (0, [dash * points_per_mm / wide for dash in dashes]) if dashes else "solid"
        axes.plot(points[:, 0], points[:, 1], color=color, linewidth=wide, linestyle=style)


def _place(element):
    """Where the middle of a text's base line is, and how it is turned, in radians."""
    transform = element.get("transform", "")
    middle = np.array(_numbers(re.search(r"translate\(([^)]*)\)", transform).group(1)))
    turned = re.search(r"rotate\(([^)]*)\)", transform)
    return middle, np.radians(_numbers(turned.group(1))[0]) if turned else 0.0


def _draw_text(axes, element, points_per_mm):
    text, size = element.text or "", float(element.get("font-size"))
    if element.get("textLength") and text.strip():  # the room that is kept for it, whatever the font
        size = min(size, float(element.get("textLength")) / TextPath((0, 0), text, size=1).get_extents().width)
    (x, y), angle = _place(element)
    axes.text(x, y, text, fontsize=size * points_per_mm, ha="center", va="baseline", rotation=-np.degrees(angle),
              rotation_mode="anchor", parse_math=False)


def _draw_image(axes, element):
    x, y, wide, high = (float(element.get(key)) for key in ("x", "y", "width", "height"))
    picture = Image.open(io.BytesIO(base64.b64decode(element.get(_HREF).split(",", 1)[1])))
    axes.imshow(picture, extent=(x, x + wide, y + high, y), aspect="auto")
