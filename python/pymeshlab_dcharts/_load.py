# SPDX-License-Identifier: GPL-3.0-or-later
"""Loads the plugin and binds its filters, once per process."""

import html
import importlib.metadata
import json
import pathlib
import re
import textwrap

_FOLDER = pathlib.Path(__file__).parent

#: the plugin file
PLUGIN = _FOLDER / "libfilter_dcharts_pymeshlab.so"

#: the pymeshlab whose plugin interface the plugin was built for
_PYMESHLAB = "2025.7"


def _check_pymeshlab():
    version = importlib.metadata.version("pymeshlab")
    if re.fullmatch(re.escape(_PYMESHLAB) + r"(\D.*)?", version) is None:
        raise ImportError(
            f"pymeshlab_dcharts works with pymeshlab {_PYMESHLAB}, but pymeshlab {version} is installed. "
            f"Install the right one: pip install 'pymeshlab=={_PYMESHLAB}.*'"
        )


def _paragraph(text, indent=""):
    plain = html.unescape(re.sub(r"<[^>]*>", " ", text))
    return textwrap.fill(plain, 100, initial_indent=indent, subsequent_indent=indent)


def _docstring(spec):
    parts = [_paragraph(f"{spec['menu_name']}. {spec['text']}")]
    for parameter in spec["parameters"]:
        head = f"{parameter['name']}: {parameter['type']} = {parameter['default']!r}"
        parts.append(head + "\n" + _paragraph(parameter["text"], "    "))
    parts.append("Returns a dictionary of the figures that are known, such as charts, l2_stretch and seconds.\n"
                 "Raises pymeshlab.PyMeshLabException with a sentence; then the mesh is unchanged.")
    return "\n\n".join(parts)


_last_refused = None


def _method(pymeshlab, spec):
    run = pymeshlab.bind_function(spec["name"])

    def method(self, **parameters):
        global _last_refused
        try:
            return run(self, **parameters)
        except pymeshlab.PyMeshLabException:
            # After a filter has failed, pymeshlab 2025.7 goes on writing to the log of its MeshSet, and ends with a
            # segmentation fault when that is gone. So the MeshSet stays until the next one takes its place.
            _last_refused = self
            raise

    method.__name__ = spec["name"]
    method.__qualname__ = "MeshSet." + spec["name"]
    method.__doc__ = _docstring(spec)
    return method


def _load():
    _check_pymeshlab()
    import pymeshlab

    specs = json.loads((_FOLDER / "filters.json").read_text(encoding="utf-8"))
    # The plugin is there already when its file was copied to pymeshlab's own folder of plugins.
    if specs[0]["name"] not in pymeshlab.filter_list():
        pymeshlab.load_plugin(str(PLUGIN))
    for spec in specs:
        setattr(pymeshlab.MeshSet, spec["name"], _method(pymeshlab, spec))
    return tuple(spec["name"] for spec in specs)


#: the names of the filters, each a method of pymeshlab.MeshSet
filters = _load()
