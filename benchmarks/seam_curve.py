# SPDX-License-Identifier: GPL-3.0-or-later
"""The trade between stretch and seams that seam_weight makes, beside UVAtlas's charts flattened by SLIM."""

import numpy as np

from atlases import make
from reference import RIVAL

WEIGHTS = (0.0, 0.25, 0.5, 1.0, 2.0, 4.0, 16.0)


def curve_at(points, seam):
    """L2 of the curve through the points (seam, L2) at a seam length; points that another one beats are left out.
    Longer seams than all: the curve stays level. Shorter than all: infinite."""
    best = []
    for s, l2 in sorted(points):
        if not best or l2 < best[-1][1]:
            best.append((s, l2))
    seams, stretches = np.transpose(best)
    return np.inf if seam < seams[0] else float(np.interp(seam, seams, stretches))


def draw(panels, picture):
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    across = 4
    figure, axes = pyplot.subplots(-(-len(panels) // across), across, figsize=(18, 9), squeeze=False)
    for axis in axes.flat[len(panels):]:
        axis.set_visible(False)
    for axis, (name, rival, points) in zip(axes.flat, panels):
        seams, stretches = np.transpose(sorted((s, l2) for _, s, l2 in points))
        axis.plot(seams, 1e3 * (stretches - 1), "o-", label="ours, by seam_weight")
        for weight, seam, l2 in points:
            axis.annotate(f"{weight:g}", (seam, 1e3 * (l2 - 1)), textcoords="offset points", xytext=(4, 4), fontsize=8)
        axis.plot([rival.seam], [1e3 * (rival.l2 - 1)], "r^", label="UVAtlas + SLIM")
        axis.set(title=f"{name}, {rival.charts} charts", xlabel="seam length / sqrt(area)", ylabel="1000 (L2 stretch - 1)",
                 ylim=(0, None))
        axis.legend()
    figure.tight_layout()
    figure.savefig(picture, dpi=80)


def seam_curve(models, names, picture, bounds):
    """Prints and draws, for each of the rival's results, ours with as many charts; our curve has to lie below it."""
    panels = []
    for name in names:
        for rival in RIVAL[name]:
            case = f"{name}, {rival.charts} charts{rival.note}"
            print(f"{case}: UVAtlas + SLIM L2 {rival.l2:.4f}, seam {rival.seam:.2f}")
            points = []
            for weight in WEIGHTS:
                atlas = make(models / f"{name}.ply", target_charts=rival.charts, seam_weight=weight)
                points.append((weight, atlas.seam, atlas.l2))
                print(f"  seam_weight {weight:5g}: {atlas.charts:3} charts  L2 {atlas.l2:.4f}  Linf {atlas.linf:.3f}  "
                      f"seam {atlas.seam:6.2f}  {'sound' if not atlas.flaws else 'NOT SOUND'}", flush=True)
                bounds.check(f"{case}, seam_weight {weight:g}: {atlas.charts} charts", atlas.charts == rival.charts)
            ours = curve_at([(seam, l2) for _, seam, l2 in points], rival.seam)
            holds = bounds.check(f"{case}: our L2 {ours:.4f} at seam {rival.seam}", ours < rival.l2)
            print(f"  our curve has L2 {ours:.4f} at that seam length, below: {holds}")
            seams = [seam for _, seam, _ in points]
            print(f"  seams span {min(seams):.2f} to {max(seams):.2f}")
            panels.append((name, rival, points))
    draw(panels, picture)
    print(f"curves: {picture}")
