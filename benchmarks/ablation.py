# SPDX-License-Identifier: GPL-3.0-or-later
"""What each improvement on the paper brings: each is turned off in turn, the others stay."""

from atlases import make, paper_parameters
from reference import GOALS

PAPER_VALUES = paper_parameters()


def as_in_paper(*names):
    return {name: PAPER_VALUES[name] for name in names}


VARIANTS = (
    ("all improvements", {}),
    ("merge_by Boundary Region", as_in_paper("merge_by")),
    ("straighten_by Shortest Path", as_in_paper("straighten_by")),
    ("dart_by Fitting Error", as_in_paper("dart_by")),
    ("seed_percent 0", as_in_paper("seed_percent")),
    ("the paper's weights (beta, gamma)", as_in_paper("compactness_weight", "straightness_weight")),
    ("max_stretch 0", as_in_paper("max_stretch")),
    ("seam_weight 0", {"seam_weight": 0.0}),
    ("no darts", {"max_dart_percent": 0.0}),
    ("none (as the paper is written)", PAPER_VALUES),
)


def figures(atlas):
    return (f"{atlas.charts:4} {atlas.l2:8.4f} {atlas.linf:7.3f} {atlas.seam:6.2f} {atlas.worst_chart:8.4f} "
            f"{atlas.seconds:6.2f}{'' if not atlas.flaws else ' UNSOUND'}")


def ablation(models, names):
    """Prints, for each model and variant, the figures with target_charts and without; no bounds."""
    head = "charts    L2    Linf   seam worst chart cpu s"
    for name in names:
        mesh, charts = models / f"{name}.ply", GOALS[name].charts
        print(f"{name}, turned off:{'':24} target_charts {charts}: {head} | free: {head}")
        for what, values in VARIANTS:
            wanted, free = make(mesh, **{**values, "target_charts": charts}), make(mesh, **values)
            print(f"  {what:36} {figures(wanted)} | {figures(free)}", flush=True)
