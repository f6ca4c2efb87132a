#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Atlases of models to look at: for each, all that the demo writes, and among it the charts in colours from three sides
(charts.png) and the texture with a checker beside the model that wears it (atlas.png).

    python benchmarks/checker_pictures.py OUTDIR [--models DIR] [MODEL ...]

Needs the package (pip install .) and Pillow. Prints a line of figures per model."""

import argparse
import sys
from pathlib import Path

from common import MODELS_DIR

from pymeshlab_dcharts.demo import run

MODELS = ("fandisk_9926", "horse", "gargoyle", "feline", "bunny")


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("out", type=Path)
    options.add_argument("names", nargs="*", default=MODELS, metavar="MODEL", help="file names without .ply")
    options.add_argument("--models", type=Path, default=MODELS_DIR)
    options = options.parse_intermixed_args()  # MODEL may stand after --models
    for name in options.names:
        mesh = options.models / f"{name}.ply"
        if not mesh.exists():
            sys.exit(f"{mesh} is not there: give the models' folder with --models.")
        print(run(mesh, options.out / name)[1], flush=True)


if __name__ == "__main__":
    main()
