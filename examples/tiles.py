#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A scan too large for one run, in tiles, each with a texture of its own (UDIM). Needs plyfile (pip install plyfile), and
GNU parallel, or any other batch engine, for the middle step:

    python examples/tiles.py split SCAN.ply out/tiles --faces 1000000
    parallel --joblog out/tiles/log python examples/tiles.py atlas {} ::: out/tiles/tile_????.ply
    python examples/tiles.py join SCAN.ply out/tiles out/scan_atlas.ply

SCAN.ply is a binary PLY of triangles; it is read where it lies, so that only what a step needs is in memory. Tiles are halves
of halves, cut across the longest side of their box until none has more faces than asked for. `join` writes the scan as it
was, with wedge texcoords: those of tile k are moved to the UDIM square k, u + k % 10 and v + k // 10."""

import argparse
import sys
from pathlib import Path

import numpy as np
from plyfile import PlyData, PlyElement, PlyParseError


def read(path):
    """A PLY file, its arrays left on the disk where they can be."""
    for name in ("vertex_indices", "vertex_index"):
        try:
            ply = PlyData.read(str(path), known_list_len={"face": {name: 3}})
            faces = ply["face"][name]
        except (KeyError, ValueError, PlyParseError):
            continue
        if not ply.text and faces.dtype.kind in "iu" and faces.shape[1:] == (3,):
            return ply, faces
    sys.exit(f"{path} is no PLY of triangles: load it in MeshLab, triangulate it, and save it as a binary PLY.")


def halves(centroids, faces, most):
    """Lists of faces, each of at most `most`, from near to far along the longest side."""
    if len(faces) <= most:
        yield np.sort(faces)
        return
    here = centroids[faces]
    axis = np.argmax(here.max(axis=0) - here.min(axis=0))
    middle = len(faces) // 2
    order = np.argpartition(here[:, axis], middle)
    yield from halves(centroids, faces[order[:middle]], most)
    yield from halves(centroids, faces[order[middle:]], most)


def split(scan, folder, most):
    ply, faces = read(scan)
    vertices = ply["vertex"].data
    centroids = np.empty((len(faces), 3), np.float32)
    for k, axis in enumerate("xyz"):
        centroids[:, k] = vertices[axis][faces].mean(axis=1)
    folder.mkdir(parents=True, exist_ok=True)
    for k, tile in enumerate(halves(centroids, np.arange(len(faces)), most)):
        used, corners = np.unique(faces[tile], return_inverse=True)
        triangles = np.empty(len(tile), [("vertex_indices", "i4", (3,))])
        triangles["vertex_indices"] = corners.reshape(-1, 3)
        PlyData([PlyElement.describe(vertices[used], "vertex"),
                 PlyElement.describe(triangles, "face", len_types={"vertex_indices": "u1"})]
                ).write(str(folder / f"tile_{k:04}.ply"))
        np.save(folder / f"tile_{k:04}.npy", tile)
    print(f"{k + 1} tiles of {len(faces)} faces")


def atlas(tile):
    import pymeshlab
    import pymeshlab_dcharts  # noqa: F401 (adds the filters)

    ms = pymeshlab.MeshSet()
    ms.load_new_mesh(str(tile))
    figures = ms.dcharts_texture_atlas()
    # Faces keep their order.
    uv = ms.current_mesh().wedge_tex_coord_matrix().astype(np.float32).reshape(-1, 6)
    np.save(tile.with_suffix(".uv.npy"), uv)
    print(f"{tile.name}: {len(uv)} faces, {figures['charts']} charts, L2 {figures['l2_stretch']:.4f}, "
          f"{figures['flipped_faces']} flipped, {figures['overlapping_faces']} overlapping, {figures['seconds']:.1f} s")


def join(scan, folder, out):
    ply, faces = read(scan)
    written = np.empty(len(faces), [("vertex_indices", "i4", (3,)), ("texcoord", "f4", (6,))])
    written["vertex_indices"] = faces
    missing = []
    for k, tile in enumerate(sorted(folder.glob("tile_????.ply"))):
        if not tile.with_suffix(".uv.npy").exists():
            missing.append(tile.name)
            continue
        uv = np.load(tile.with_suffix(".uv.npy"))
        written["texcoord"][np.load(tile.with_suffix(".npy"))] = uv + np.float32([k % 10, k // 10] * 3)
    if missing:
        sys.exit(f"No atlas yet of {', '.join(missing)}: run the middle step again (parallel --resume does those alone).")
    PlyData([PlyElement.describe(ply["vertex"].data, "vertex"),
             PlyElement.describe(written, "face", len_types={"vertex_indices": "u1", "texcoord": "u1"})]).write(str(out))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    steps = parser.add_subparsers(dest="step", required=True)
    step = steps.add_parser("split")
    step.add_argument("scan", type=Path)
    step.add_argument("folder", type=Path)
    step.add_argument("--faces", type=int, default=1000000, help="the most of a tile")
    step = steps.add_parser("atlas")
    step.add_argument("tile", type=Path)
    step = steps.add_parser("join")
    step.add_argument("scan", type=Path)
    step.add_argument("folder", type=Path)
    step.add_argument("out", type=Path)
    options = parser.parse_args()
    if options.step == "split":
        split(options.scan, options.folder, options.faces)
    elif options.step == "atlas":
        atlas(options.tile)
    else:
        join(options.scan, options.folder, options.out)


if __name__ == "__main__":
    main()
