#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks D-Charts filters in MeshLab's filter scripts.

usage: python3 scripts/check_mlx.py SCRIPT.mlx...

MeshLab 2020.09's meshlabserver ends with an abort where a script lacks a parameter or has a wrong name. This says before
which, a line each: SCRIPT.mlx:LINE: what is wrong and what to do. Filters of others are not looked at.
The exit code is 0 when nothing is wrong, 1 when something is, 2 when a file can't be read or is no filter script.
"""
import difflib
import json
import math
import pathlib
import sys
from xml.parsers import expat
from xml.sax.saxutils import quoteattr

TABLE = pathlib.Path(__file__).resolve().parents[1] / "docs" / "filters.json"
OURS = "D-Charts"


class NoScript(Exception):
    """Why a file is no filter script."""


def read_filters(path):
    """The script's filters as (line, element, name, parameters); of each parameter its line and attributes."""
    filters, open_elements = [], []
    parser = expat.ParserCreate()

    def start(name, attributes):
        if not open_elements and name != "FilterScript":
            raise NoScript(f"the outermost element is <{name}>; a script of MeshLab starts with <FilterScript>.")
        if len(open_elements) == 1:
            filters.append((parser.CurrentLineNumber, name, attributes.get("name", ""), []))
        elif len(open_elements) == 2 and name == "Param":
            filters[-1][3].append((parser.CurrentLineNumber, attributes))
        open_elements.append(name)

    def entity(*_):
        raise NoScript("it declares entities, which no script of MeshLab does.")

    parser.StartElementHandler = start
    parser.EndElementHandler = lambda _: open_elements.pop()
    parser.EntityDeclHandler = entity
    try:
        parser.Parse(path.read_bytes(), True)
    except expat.ExpatError as error:
        raise NoScript(f"it is no XML: {error}.") from error
    except OSError as error:
        raise NoScript(f"it can't be read: {error.strerror}.") from error
    return filters


def near(name, names):
    """' Did you mean ...?' when there is a name like it."""
    found = difflib.get_close_matches(name, names, 1)
    return f" Did you mean '{found[0]}'?" if found else ""


def rich_type(spec):
    """MeshLab's name for the type of a parameter."""
    if "options" in spec:
        return "RichEnum"
    return {"int": "RichInt", "float": "RichFloat", "bool": "RichBool", "str": "RichSaveFile"}[spec["type"]]


def default_value(spec):
    if "options" in spec:
        return str(spec["options"].index(spec["default"]))
    return str(spec["default"]).lower() if spec["type"] == "bool" else str(spec["default"])


def line_to_paste(spec):
    attributes = {"name": spec["name"], "type": rich_type(spec), "value": default_value(spec), "description": "", "tooltip": ""}
    if "options" in spec:
        attributes.update({f"enum_val{k}": option for k, option in enumerate(spec["options"])})
        attributes["enum_cardinality"] = str(len(spec["options"]))
    if rich_type(spec) == "RichSaveFile":
        attributes["ext"] = ""
    return "<Param " + " ".join(f"{key}={quoteattr(value)}" for key, value in attributes.items()) + "/>"


def wrong_value(spec, text):
    """What is wrong with a value, or None."""
    if rich_type(spec) == "RichSaveFile":
        known = text == "" or text.lower().endswith((".svg", ".pdf", ".dxf"))
        return None if known else f"'{text}' does not end in .svg, .pdf or .dxf."
    if spec["type"] == "bool":
        return None if text in ("true", "false") else f"'{text}' is neither true nor false."
    if "options" in spec:
        numbers = [str(k) for k in range(len(spec["options"]))]
        choices = ", ".join(f"{k} ({option})" for k, option in enumerate(spec["options"]))
        return None if text in numbers else f"'{text}' is none of {choices}."
    try:
        number = int(text) if spec["type"] == "int" else float(text)
    except ValueError:
        return f"'{text}' is no {'whole number' if spec['type'] == 'int' else 'number'}."
    if not math.isfinite(number):
        return f"'{text}' is not finite."
    if number < spec.get("min", -math.inf):
        return f"{text} is below {spec['min']}."
    if "above" in spec and number <= spec["above"]:
        return f"{text} is not above {spec['above']}."
    if number > spec.get("max", math.inf):
        return f"{text} is above {spec['max']}."
    return None


def check_filter(spec, line, parameters):
    """Yields (line, sentence) for what is wrong."""
    known = {p["name"]: p for p in spec["parameters"]}
    seen = set()
    for at, attributes in parameters:
        name = attributes.get("name", "")
        lacking = [key for key in ("name", "type", "value") if key not in attributes]
        if lacking:
            yield at, f"a parameter '{name}' without {' and '.join(lacking)}. Copy its line from the scripts in examples/."
        elif name not in known:
            yield at, f"'{name}' is no parameter of {spec['menu_name']}.{near(name, known)}"
        elif name in seen:
            yield at, f"'{name}' is there twice. Delete one."
        elif attributes["type"] != rich_type(known[name]):
            yield at, f"'{name}' has the type '{attributes['type']}', but it is '{rich_type(known[name])}'."
        else:
            problem = wrong_value(known[name], attributes["value"])
            if problem:
                yield at, f"{name}: {problem}"
        seen.add(name)
    for name in known:
        if name not in seen:
            yield line, f"{spec['menu_name']} lacks '{name}'. Add: {line_to_paste(known[name])}"


def check_script(path, table):
    """The problems of a script as (line, sentence), and a summary."""
    filters = read_filters(path)
    problems, ours = [], 0
    for line, element, name, parameters in filters:
        if element != "filter" or not name.startswith(OURS):
            continue
        ours += 1
        if name in table:
            problems += check_filter(table[name], line, parameters)
        else:
            problems.append((line, f"There is no filter '{name}'.{near(name, table)}"))
    others = f"; filters not looked at: {len(filters) - ours}" if len(filters) > ours else ""
    return sorted(problems), f"D-Charts filters: {ours}{others}"


def main(arguments):
    if not arguments or arguments[0].startswith("-"):
        print(__doc__, file=sys.stderr)
        return 2
    table = {spec["menu_name"]: spec for spec in json.loads(TABLE.read_text(encoding="utf-8"))}
    worst = 0
    for script in arguments:
        try:
            problems, summary = check_script(pathlib.Path(script), table)
        except NoScript as error:
            print(f"{script}: {error}")
            worst = 2
            continue
        for line, sentence in problems:
            print(f"{script}:{line}: {sentence}")
        if problems:
            worst = max(worst, 1)
        else:
            print(f"{script}: nothing is wrong. {summary}")
    return worst


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
