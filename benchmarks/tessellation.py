# SPDX-License-Identifier: GPL-3.0-or-later
"""Does the result belong to the shape, and not to its triangles? The same surface with 4 and 16 times the faces, and with
noise on its vertices, without any parameter."""

import tempfile
from pathlib import Path

import pymeshlab

from common import ROOT
from meshes import noisy, quartered, save

from atlases import Atlas, evaluator, make

OURS = ("plush", "torus", "cad_part")
OTHERS = ("spot", "horse")
NOISE = 0.05  # standard deviation of each coordinate, of the mean edge
SHARE, LEAST = 0.2, 1  # chart counts may differ by the larger of the two
L2 = 0.002


def laid_on(clean, atlas):
    """The charts and cuts of an atlas of a mesh with other vertex places, flattened on the mesh file `clean`."""
    vertices, faces, _ = evaluator.read_mesh(str(clean))
    ms = pymeshlab.MeshSet()
    ms.add_mesh(pymeshlab.Mesh(vertices, faces, f_scalar_array=atlas.chart_ids.astype(float),
                               w_tex_coords_matrix=atlas.uv.reshape(-1, 2)))
    ms.dcharts_parameterize()
    ids = ms.current_mesh().face_scalar_array().round().astype(int)
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "atlas.obj"
        ms.save_current_mesh(str(file), save_wedge_texcoord=True)
        return Atlas(file, clean, ids, 0.0)


def compare(case, faces, atlas, reference, l2, kept, bounds):
    """`l2` of the atlas is to be `kept`."""
    near = abs(atlas.charts - reference.charts) <= max(LEAST, SHARE * reference.charts)
    verdicts = [bounds.check(f"{case}: {atlas.charts} charts, not {reference.charts}", near),
                bounds.check(f"{case}: L2 {l2:.4f}, not {kept:.4f}", abs(l2 - kept) <= L2),
                bounds.check(f"{case}: not sound: {', '.join(atlas.flaws)}", not atlas.flaws)]
    print(f"  {case:34} {faces:7} faces {atlas.charts:4} charts  L2 {l2:.4f}  Linf {atlas.linf:.3f}  seam {atlas.seam:6.2f}"
          f"  {atlas.seconds:6.2f} s | L2 {kept:.4f} to keep; count, L2, sound hold: {' '.join(verdicts)}", flush=True)


def tessellation(models, bounds):
    print("other triangles of the same shape; L2 to keep: that of the mesh as it is; of noisy charts, which are measured when "
          "laid on the clean mesh, that on the noisy one")
    meshes = [ROOT / "meshes" / f"{name}.ply" for name in OURS]
    meshes += [path for path in (models / f"{name}.ply" for name in OTHERS) if path.exists()]
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for mesh in meshes:
            vertices, faces, _ = evaluator.read_mesh(str(mesh))
            clean = make(mesh)
            compare(mesh.stem, len(faces), clean, clean, clean.l2, clean.l2, bounds)
            atlas = make(save(folder / "noisy.ply", noisy(vertices, faces, NOISE), faces))
            compare(f"{mesh.stem}, noise {NOISE:.0%}", len(faces), atlas, clean, laid_on(mesh, atlas).l2,
                    atlas.l2, bounds)
            for times in (4, 16):
                vertices, faces = quartered(vertices, faces)
                atlas = make(save(folder / "fine.ply", vertices, faces))
                compare(f"{mesh.stem}, {times} times the faces", len(faces), atlas, clean, atlas.l2, clean.l2, bounds)
