# SPDX-License-Identifier: GPL-3.0-or-later
"""Mechanical parts: how much of the seams lies on creases, and whether charts can be kept strictly developable."""

from common import ROOT

from atlases import SHARP, make

STRICT = {"merge_by": "Boundary Region", "merge_threshold": 1e-5}
STRICT_L2 = 1.00075


def creases(models, bounds):
    print(f"creases (above {SHARP:g} degrees): share of the seams' length that is crease, strictly: {STRICT}")
    meshes = [ROOT / "meshes" / "cad_part.ply"]
    meshes += [path for path in (models / f"{name}.ply" for name in ("fandisk_9926", "fandisk")) if path.exists()]
    for mesh in meshes:
        for how, values in (("default", {}), ("strictly", STRICT), ("strictly, from 40", {**STRICT, "chart_count": 40})):
            atlas = make(mesh, **values)
            share, length = atlas.crease_share()
            print(f"  {mesh.stem:14} {how:18} {atlas.charts:3} charts  L2 {atlas.l2:.5f}  Linf {atlas.linf:.3f}  "
                  f"seam {atlas.seam:5.2f}, {share:.0%} of it crease (all creases: {length:.2f})", flush=True)
            bounds.check(f"{mesh.stem}, {how}: not sound: {', '.join(atlas.flaws)}", not atlas.flaws)
            if values:
                bounds.check(f"{mesh.stem}, {how}: L2 {atlas.l2:.5f} not below {STRICT_L2}", atlas.l2 < STRICT_L2)
