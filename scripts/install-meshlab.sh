#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Builds the plugin (when that was not done yet), puts it where the installed MeshLab (GUI and meshlabserver) finds
# it, and says where.
# usage: install-meshlab.sh [--uninstall]
# MeshLab 2020.09 (Debian 12, Ubuntu 22.04) has one plugin folder for all users: root or sudo is needed.
# MeshLab 2025.07 has one in the home folder as well, which is taken; it is found when that MeshLab was started once
# (this holds for the AppImage too) or is on the PATH.
set -euo pipefail
# shellcheck source=setup.sh
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

case ${1:-} in
  "") action=install ;;
  --uninstall) action=uninstall ;;
  *) echo "usage: install-meshlab.sh [--uninstall]" >&2; exit 2 ;;
esac

# The API of the MeshLab whose plugins are in folder $1: "2020", "2025", or nothing for another version.
meshlab_api() {
  local stock=$1/libfilter_clean.so common=$1/../libmeshlab-common.so
  if grep -qa 'vcg\.meshlab\.MeshFilterInterface/1\.0' "$stock" 2>/dev/null; then
    echo 2020
  elif grep -qa '2025\.07' "$common" 2>/dev/null; then
    echo 2025
  fi
}

# The plugin folder of the MeshLab on the PATH; nothing when there is none.
system_plugins() {
  local name program folder
  for name in meshlab meshlabserver; do
    program=$(command -v "$name") || continue
    program=$(readlink -f "$program")
    for folder in "$(dirname "$program")"/../lib/*/meshlab/plugins "$(dirname "$program")"/../lib/meshlab/plugins; do
      [ ! -d "$folder" ] || { readlink -f "$folder"; return; }
    done
  done
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
plugins=$(system_plugins)
api=
if [ -n "$plugins" ]; then
  api=$(meshlab_api "$plugins")
  if [ -z "$api" ]; then
    echo "The MeshLab with plugins in $plugins is neither 2020.09 nor 2025.07; the plugin is only for these." >&2
  fi
fi
if [ "$api" = 2020 ]; then
  found=yes
  file=$(build_plugin filter_dcharts_2020)
  put "$file" "$plugins" "MeshLab 2020.09"
fi
user_folder=${XDG_DATA_HOME:-$HOME/.local/share}/VCG/MeshLab_64bit_fp/MeshLabExtraPlugins/2025.07
if [ "$api" = 2025 ] || [ -d "$user_folder" ]; then
  found=yes
  file=$(build_plugin filter_dcharts_2025)
  mkdir -p "$user_folder"
  put "$file" "$user_folder" "MeshLab 2025.07"
fi
if [ $found = no ]; then
  echo "No MeshLab was found that the plugin is for. On Debian 12: apt-get install meshlab. If you have MeshLab" \
    "2025.07 (AppImage, installer), start it once, then run this again." >&2
  exit 1
fi
