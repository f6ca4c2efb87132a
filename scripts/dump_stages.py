#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the six stages on a mesh one by one and writes each result as PLY, to see which stage does what.

    python scripts/dump_stages.py MESH FOLDER [--set NAME=VALUE ...] [--from STAGE]

Needs the package (pip install .). Writes FOLDER/1_segment.ply to FOLDER/6_parameterize.ply, with the chart's number as
face quality (-1: none), the chart's colour, and wedge texture coordinates where there are any; with Cut they jump
exactly at the seams. Prints a line of figures per stage. The exit code is 1 when something is wrong; the files of the
stages before stay."""

import argparse
import difflib
import json
import pathlib
import sys

import pymeshlab
import pymeshlab_dcharts  # noqa: F401 (adds the filters)

TABLE = pathlib.Path(__file__).resolve().parents[1] / "docs" / "filters.json"
STAGES = ("segment", "fill", "straighten", "merge", "cut", "parameterize")
# name of a figure -> how it is printed, in this order
FIGURES = {
    "charts": "charts {}",
    "unassigned_faces": "faces in none {}",
    "iterations": "iterations {}",
    "seam_length": "seams {:.3f}",
    "darts": "darts {}",
    "l2_stretch": "L2 stretch {:.5f}",
    "linf_stretch": "Linf {:.3f}",
    "flipped_faces": "flipped {}",
    "overlapping_faces": "overlapping {}",
    "packing_efficiency": "texture used {:.0%}",
    "seconds": "{:.2f} s",
}


class Wrong(Exception):
    """What the user has to mend, as a sentence."""


def stage_parameters():
    """Of each stage its parameters by name."""
    specs = json.loads(TABLE.read_text(encoding="utf-8"))
    named = {spec["name"]: {p["name"]: p for p in spec["parameters"]} for spec in specs}
    return {stage: named["dcharts_" + stage] for stage in STAGES}


def value_of(text, spec):
    """The value that a text stands for; the filter itself says what is out of range."""
    if spec["type"] == "bool":
        if text.lower() not in ("true", "false"):
            raise Wrong(f"{spec['name']} is true or false, not '{text}'.")
        return text.lower() == "true"
    if spec["type"] == "str":
        if text not in spec["options"]:
            raise Wrong(f"{spec['name']} is one of {', '.join(map(repr, spec['options']))}, not '{text}'.")
        return text
    try:
        return int(text) if spec["type"] == "int" else float(text)
    except ValueError:
        raise Wrong(f"{spec['name']} is a {'whole ' * (spec['type'] == 'int')}number, not '{text}'.") from None


def chosen_parameters(settings, known):
    """Per stage what --set gave; a parameter goes to every stage that has it, as in Texture Atlas."""
    chosen = {stage: {} for stage in STAGES}
    for setting in settings:
        name, equals, text = setting.partition("=")
        if not equals:
            raise Wrong(f"--set needs NAME=VALUE, not '{setting}'.")
        having = [stage for stage in STAGES if name in known[stage]]
        if not having:
            near = difflib.get_close_matches(name, {n for stage in STAGES for n in known[stage]}, 1)
            raise Wrong(f"No stage has a parameter '{name}'." + (f" Did you mean '{near[0]}'?" if near else ""))
        for stage in having:
            chosen[stage][name] = value_of(text, known[stage][name])
    return chosen


def line_of(figures):
    return ", ".join(text.format(figures[name]) for name, text in FIGURES.items() if name in figures)


def load(path):
    if not path.is_file():
        raise Wrong(f"{path} is not there.")
    ms = pymeshlab.MeshSet()
    try:
        ms.load_new_mesh(str(path))
    except pymeshlab.PyMeshLabException as error:
        raise Wrong(f"{path} can't be read: {str(error).strip()}") from error
    return ms


def dump(mesh, folder, parameters, first=STAGES[0]):
    """Writes the stages from `first` on and prints a line for each. parameters: of each stage, by name."""
    ms = load(mesh)
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise Wrong(f"The folder {folder} can't be made: {error.strerror}.") from error
    for number, stage in enumerate(STAGES, 1):
        if number <= STAGES.index(first):
            continue
        try:
            figures = getattr(ms, "dcharts_" + stage)(**parameters[stage])
        except pymeshlab.PyMeshLabException as error:
            raise Wrong(f"{stage} failed: {str(error).strip()}") from error
        ms.set_current_mesh(0)  # seam_layer adds a layer
        file = folder / f"{number}_{stage}.ply"
        try:
            ms.save_current_mesh(str(file), save_face_quality=True, save_face_color=True,
                                 save_wedge_texcoord=ms.current_mesh().has_wedge_tex_coord(), save_textures=False)
        except pymeshlab.PyMeshLabException as error:
            raise Wrong(f"{file} can't be written: is there space, and may you write there?") from error
        print(f"{file}: {line_of(figures)}", flush=True)


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mesh", type=pathlib.Path, metavar="MESH", help="any file that MeshLab reads")
    parser.add_argument("folder", type=pathlib.Path, metavar="FOLDER", help="where to write; made when it is not there")
    parser.add_argument("--set", action="append", default=[], metavar="NAME=VALUE", dest="settings",
                        help="a parameter, for every stage that has it; may be given several times")
    parser.add_argument("--from", choices=STAGES, default=STAGES[0], metavar="STAGE", dest="first",
                        help="the stage to begin with, on a mesh that has charts, such as a file written by this: "
                        + ", ".join(STAGES))
    options = parser.parse_args(arguments)
    try:
        dump(options.mesh, options.folder, chosen_parameters(options.settings, stage_parameters()), options.first)
    except Wrong as error:
        print(error, file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
