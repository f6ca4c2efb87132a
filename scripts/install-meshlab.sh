#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Builds the plugin (when that was not done yet), puts it where the installed MeshLab (GUI and meshlabserver) finds
# it, and says where.
# usage: install-meshlab.sh [--uninstall] [MESHLAB]
# MESHLAB is the MeshLab program or AppImage, when it is none that is found without: on the PATH, or started once before.
# MeshLab 2020.09 (Debian 12, Ubuntu 22.04) has one plugin folder for all users: root or sudo is needed.
# MeshLab 2025.07 has one in the home folder as well, which is taken; another one for its version with double precision.
set -euo pipefail
# shellcheck source=setup.sh
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

action=install
[ "${1:-}" != --uninstall ] || { action=uninstall; shift; }
if [ $# -gt 1 ] || [[ ${1:-} == -* ]]; then
  echo "usage: install-meshlab.sh [--uninstall] [MESHLAB]" >&2
  exit 2
fi
given=${1:-}
[ -z "$given" ] || [ -f "$given" ] || fail "There is no file $given. Give the MeshLab program or its AppImage."

# The folder of the plugins that came with program $1; nothing for an AppImage, which has them inside.
plugins_of() {
  local folder bin
  bin=$(dirname "$(readlink -f "$1")")
  for folder in "$bin"/../lib/*/meshlab/plugins "$bin"/../lib/meshlab/plugins "$bin"/usr/lib/meshlab/plugins; do
    [ ! -d "$folder" ] || { readlink -f "$folder"; return; }
  done
}

# What program $1 is: 2020.09, 2025.07 or, with double precision, 2025.07d; "another MeshLab" otherwise. Newer ones say
# it themselves, without a display; 2020.09 is known by the plugins it has.
version_of() {
  local program=$1 plugins said
  plugins=$(plugins_of "$program")
  if grep -qsa 'vcg\.meshlab\.MeshFilterInterface/1\.0' "$plugins/libfilter_clean.so"; then
    echo 2020.09
    return
  fi
  # Debian's package for forky does not find its own libraries.
  said=$(QT_QPA_PLATFORM=offscreen LD_LIBRARY_PATH=${plugins:+$plugins/..:}${LD_LIBRARY_PATH:-} timeout 60 "$program" --version 2>/dev/null </dev/null | grep -m 1 '^MeshLab ') || said=
  case ${said#MeshLab } in
    2025.07 | 2025.07d) echo "${said#MeshLab }" ;;
    *) echo "another MeshLab" ;;
  esac
}

# The folder in the home of MeshLab 2025.07 ($1) or 2025.07d.
user_folder() {
  local precision=fp
  [ "$1" = 2025.07 ] || precision=dp
  echo "${XDG_DATA_HOME:-$HOME/.local/share}/VCG/MeshLab_64bit_$precision/MeshLabExtraPlugins/$1"
}

# Runs a command as root, when folder $1 is not ours to write.
in_folder() {
  local folder=$1
  shift
  if [ -w "$folder" ]; then
    "$@"
  elif command -v sudo >/dev/null; then
    sudo "$@"
  else
    echo "No right to write to $folder, and there is no sudo. As root, run: $*" >&2
    exit 1
  fi
}

# Installs or removes one plugin file: put BUILT_FILE FOLDER WHAT
put() {
  local built=$1 folder=$2 what=$3 target
  target=$folder/$(basename "$built")
  if [ $action = uninstall ]; then
    if [ -e "$target" ]; then
      in_folder "$folder" rm "$target"
      echo "$what: removed $target"
    else
      echo "$what: nothing to remove, there is no $target"
    fi
  elif cmp -s "$built" "$target"; then
    echo "$what: already there, $target"
  else
    # A copy under another name that is then moved: a MeshLab that runs keeps the file it has.
    in_folder "$folder" install -m 644 "$built" "$target.new"
    in_folder "$folder" mv "$target.new" "$target"
    echo "$what: installed $target"
  fi
}

# Builds the plugin of target $1 and prints where it is.
build_plugin() {
  local file=$build/filter_dcharts/lib$1.so
  if [ $action = install ]; then
    ensure_apt_packages "${build_packages[@]}"
    [ -e "$build/CMakeCache.txt" ] || ensure_build -DDCHARTS_BUILD_TESTS=OFF
    build_targets "$1"
  fi
  echo "$file"
}

found=no
# Installs or removes the plugin of one MeshLab: do_for VERSION FOLDER
do_for() {
  local version=$1 folder=$2 target file
  case $version in
    2020.09) target=filter_dcharts_2020 ;;
    2025.07) target=filter_dcharts_2025 ;;
    2025.07d) target=filter_dcharts_pymeshlab ;; # pymeshlab has double precision, too
  esac
  found=yes
  file=$(build_plugin "$target")
  [ $action = uninstall ] || [ -d "$folder" ] || mkdir -p "$folder"
  put "$file" "$folder" "MeshLab $version"
}

programs=("$given")
[ -n "$given" ] || mapfile -t programs < <(type -P meshlab meshlabserver | head -n 1)
versions=()
for program in "${programs[@]}"; do
  version=$(version_of "$program")
  case $version in
    2020.09) do_for 2020.09 "$(plugins_of "$program")" ;;
    2025.07*) versions+=("$version") ;;
    *) echo "$program is neither MeshLab 2020.09 nor 2025.07; the plugin is only for these." >&2 ;;
  esac
done
for version in 2025.07 2025.07d; do
  folder=$(user_folder $version)
  if [[ " ${versions[*]} " == *" $version "* ]] || { [ -z "$given" ] && [ -d "$folder" ]; }; then
    do_for $version "$folder"
  fi
done
if [ $found = no ]; then
  echo "No MeshLab was found that the plugin is for. On Debian 12: apt-get install meshlab. If you have MeshLab 2025.07" \
    "(AppImage, installer), name it: bash scripts/install-meshlab.sh /path/to/MeshLab2025.07.AppImage" >&2
  exit 1
fi
