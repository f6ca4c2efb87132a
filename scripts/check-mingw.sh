#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Does the code compile for Windows? Checks the syntax with MinGW: every file of vcg_ext/ and meshes/, and all of
# filter_dcharts/ but the adapters, which need a MeshLab for Windows; then all headers together after <windows.h>, whose
# macros take names such as `far`. Warnings are errors. Nothing is linked or run. A minute or two on two cores.
# usage: bash scripts/check-mingw.sh [FILE...]        (only these)
set -euo pipefail
# shellcheck source=setup.sh
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"
cd "$repo"

compiler=x86_64-w64-mingw32-g++-posix # with std::thread
ensure_apt_packages g++-mingw-w64-x86-64-posix libeigen3-dev libboost-dev libhpdf-dev libpng-dev
tree=$(bash scripts/fetch-meshlab-headers.sh 2025.07)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Libraries' headers are the same for Windows. Those in /usr/include must come without the C library's, which are there too.
mkdir "$work/include"
ln -s /usr/include/boost /usr/include/hpdf*.h /usr/include/png*.h "$work/include"

compile() {
  "$compiler" -std=c++17 -Wall -Wextra -Werror -DNOMINMAX -DEIGEN_DONT_PARALLELIZE -Ivcg_ext -Ifilter_dcharts \
    -Imeshes -isystem "$work/include" -isystem /usr/include/eigen3 -isystem "$vcglib" "$@"
}
# $1 is checked; what the compiler says comes out in one piece.
check() {
  local said
  said=$(compile -fsyntax-only -include "$work/eigen.h" "$1" 2>&1) && return
  printf '%s\n' "$1 does not compile for Windows:" "$said" | head -n 20
  return 1
}
export -f compile check
export compiler work
export vcglib=${tree#* }/src/vcglib
# Nearly half of the time goes into reading these, so that is done once. What lacks an include does not compile for Linux.
printf '#include <%s>\n' Eigen/Geometry Eigen/SparseCholesky algorithm functional map string vector >"$work/eigen.h"
compile -x c++-header "$work/eigen.h" -o "$work/eigen.h.gch"

if [ $# -gt 0 ]; then
  files=("$@")
else
  find_ours() { find vcg_ext filter_dcharts meshes -name "$1" -not -name 'adapter_*' "${@:2}" | LC_ALL=C sort; }
  mapfile -t files < <(find_ours '*.cpp')
  {
    echo '#include <windows.h>'
    find_ours '*.h' -not -name host_filter.h -not -name mesh_exchange.h | sed "s|.*|#include \"$repo/&\"|"
  } >"$work/all_headers.cpp"
  files=("$work/all_headers.cpp" "${files[@]}")
fi
printf '%s\0' "${files[@]}" | xargs -0 -n 1 -P 2 bash -c 'check "$1"' check ||
  fail "Not all of the ${#files[@]} files compile for Windows."
say "${#files[@]} files compile for Windows."
