#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Sets everything up, builds the plugin for every host, and runs every test: format, syntax for Windows, unit tests
# (also with sanitizers), and the hosts. usage: bash scripts/test.sh
# Screenshots of the GUIs are left in out/screenshots. The exit code is 0 when nothing failed.
set -euo pipefail
# shellcheck source=setup.sh
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"
cd "$repo"

ensure_apt_packages "${build_packages[@]}" libgtest-dev meshlab xvfb xauth openbox xdotool debootstrap \
  libgl1-mesa-dri ccache git parallel g++-mingw-w64-x86-64-posix
# The plugin for pymeshlab compiles what build/ has compiled already.
export CMAKE_CXX_COMPILER_LAUNCHER=ccache
ensure_build -DDCHARTS_BUILD_TESTS=ON
build_targets all
for host in pymeshlab 2025 2020; do
  [ -e "$build/filter_dcharts/libfilter_dcharts_$host.so" ] ||
    fail "The plugin for $host was not built; the messages above say which variable to set."
done
ensure_plugin
ensure_venv pytest pytest-xdist numpy scipy Pillow ezdxf plyfile matplotlib ipykernel nbclient cffconvert clang-format==14.0.6

failed=()
step() {
  local name=$1
  shift
  say "== $name"
  "$@" || failed+=("$name")
}

check_format() {
  find vcg_ext filter_dcharts meshes tests \( -name '*.h' -o -name '*.cpp' \) -print0 |
    xargs -0 "$venv/bin/clang-format" --dry-run --Werror
}

sanitized_unit_tests() {
  local build=$repo/build-sanitized
  ensure_build -DDCHARTS_BUILD_TESTS=ON -DCMAKE_BUILD_TYPE=RelWithDebInfo \
    -DCMAKE_CXX_FLAGS_RELWITHDEBINFO='-O1 -g1 -DNDEBUG' -DDCHARTS_SANITIZE=address,undefined \
    -DDCHARTS_PLUGIN_PYMESHLAB=OFF -DDCHARTS_PLUGIN_2025=OFF -DDCHARTS_PLUGIN_2020=OFF
  build_targets unit_tests_2025 fuzz_meshes
  # Sanitizers make tests ten times slower: those that take seconds without are left to the fuzzer, with its small meshes.
  local slow='Pipeline/*:Shapes/Paper*:*Sheet*:Meshes/*Pattern*:PatternModel.*:PatternSymmetry.*:PatternBaseMesh.*:Paper.*'
  slow+=':Taken.*:Threads.*:Invariance.*:Cancelling.*:TrialMerge.*:Coarsen.*:Corpus*:Crease*:KeptBorders.*:ChooseSegmentation.*'
  slow+=':*/plush*:*/cad_part*:*torus*:*.WhatReachesTheMean*:*.EveryShapeInOneChart*:*.NoChartVanishes*:*.PaintedChartsOfAnyKind*'
  slow+=':*.LeavesCleanShapesAsTheyAre:*.GiveTheSame*:Padding.*:*.PlanesAndDisks*:Shapes.F*:Shapes.S*:*.ChartsAreApartByThePadding'
  GTEST_FILTER="-$slow" \
    UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1 \
    ctest --test-dir "$build" --output-on-failure -j 2 -R 'unit_tests_2025|fuzz_meshes'
}

step "format of the C++ code" check_format
step "syntax for Windows (MinGW)" bash scripts/check-mingw.sh
step "unit tests, examples" ctest --test-dir "$build" --output-on-failure -j 2
step "unit tests and fuzzer with sanitizers" sanitized_unit_tests
# Last, so that the runner's own summary is the last line.
[ ${#failed[@]} = 0 ] || printf 'FAILED: %s\n' "${failed[@]}" >&2
step "tests in the hosts" env DCHARTS_SCREENSHOTS="$repo/out/screenshots" DCHARTS_BUILD="$build" \
  "$python" -m pytest -q -rs --durations=5 -n 2 --dist loadscope -p no:cacheprovider tests/host
[ ${#failed[@]} = 0 ]
