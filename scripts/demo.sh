#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Sets everything up, builds the plugin and makes a texture atlas and a sewing pattern of MESH in pymeshlab.
# usage: bash scripts/demo.sh [MESH]        (default: meshes/plush.ply) -> out/NAME/
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
# shellcheck source=setup.sh
source "$here/setup.sh"

[ $# -le 1 ] || fail "usage: bash scripts/demo.sh [MESH]"
mesh=${1:-$repo/meshes/plush.ply}
[ -f "$mesh" ] || fail "There is no file $mesh. Give a mesh that MeshLab can read (.ply, .obj, .off, .stl)."
[ -r "$mesh" ] || fail "The file $mesh can't be read; check its permissions."

ensure_apt_packages "${build_packages[@]}"
ensure_plugin
ensure_venv numpy Pillow
name=$(basename "$mesh")
result=0
"$python" -m pymeshlab_dcharts.demo "$mesh" "$repo/out/${name%.*}" || result=$?
# 1 and 2 come with an explanation of their own.
[ $result -le 2 ] || say "The run in pymeshlab ended with code $result. Remove .venv and run this again to build it anew; if that" \
  "does not help, please report the mesh and this message."
exit $result
