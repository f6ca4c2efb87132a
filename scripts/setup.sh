# SPDX-License-Identifier: GPL-3.0-or-later
# Set-up shared by the scripts here; to be sourced by bash, with `set -euo pipefail` in force. Each function looks first
# and does nothing when all is there: a second run is quick and needs no network.
#   ensure_apt_packages PACKAGE...    Debian packages; needs root or sudo when one is missing
#   ensure_venv REQUIREMENT...        Python packages in the repository's own .venv
#   ensure_plugin                     the Python package pymeshlab-dcharts in .venv, built from this checkout
#   ensure_build [OPTION...]          build/ configured with these options for cmake
#   build_targets TARGET...           these targets built there

repo=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
venv=$repo/.venv
python=$venv/bin/python
build=$repo/build

# What building the plugin and running it in pymeshlab takes on a bare Debian 12.
build_packages=(build-essential cmake ninja-build python3-venv ca-certificates qtbase5-dev libqt5opengl5-dev libeigen3-dev
  libboost-dev libhpdf-dev libpng-dev libglew-dev libglu1-mesa-dev libgl1 libopengl0)

say() { printf '%s\n' "$*" >&2; }
fail() {
  say "$@"
  exit 1
}

ensure_apt_packages() {
  local package missing=()
  command -v dpkg-query >/dev/null || fail "This script sets up Debian 12 only. Elsewhere, see README.md for what is needed."
  for package in "$@"; do
    [ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null)" = installed ] || missing+=("$package")
  done
  [ ${#missing[@]} -gt 0 ] || return 0
  local line="apt-get update && apt-get install -y --no-install-recommends ${missing[*]}"
  local as_root=()
  if [ "$(id -u)" != 0 ]; then
    # Without a terminal sudo must not wait for a password.
    if ! command -v sudo >/dev/null || { [ ! -t 0 ] && ! sudo -n true 2>/dev/null; }; then
      fail "Debian packages are missing. As root, run this line, then this script again:" "$line"
    fi
    as_root=(sudo)
  fi
  say "Installing Debian packages: ${missing[*]}"
  local log
  log=$(mktemp)
  if ! { "${as_root[@]}" apt-get -q update &&
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -y -o Acquire::Retries=3 \
      install --no-install-recommends "${missing[@]}"; } >"$log" 2>&1; then
    tail -n 15 "$log" >&2
    rm -f "$log"
    fail "apt could not install the packages. Check the network and the apt sources, then run this line as root:" "$line"
  fi
  rm -f "$log"
}

# Prints those of the requirements that .venv does not meet, one a line.
unmet_requirements() {
  "$python" - "$@" <<'PY'
import sys
from importlib import metadata
from pip._vendor.packaging.requirements import Requirement
for text in sys.argv[1:]:
    requirement = Requirement(text)
    try:
        met = requirement.specifier.contains(metadata.version(requirement.name), prereleases=True)
    except metadata.PackageNotFoundError:
        met = False
    if not met:
        print(text)
PY
}

ensure_venv() {
  # A venv that was moved, or whose Python is gone, is made anew.
  if [ "$("$python" -c 'import sys; print(sys.prefix)' 2>/dev/null)" != "$venv" ] || ! "$python" -m pip --version >/dev/null 2>&1; then
    say "Making a Python environment in .venv"
    rm -rf "$venv"
    python3 -m venv "$venv" || fail "python3 -m venv failed. On Debian the package python3-venv is needed."
  fi
  local unmet
  mapfile -t unmet < <(unmet_requirements "$@")
  [ ${#unmet[@]} -gt 0 ] || return 0
  say "Installing Python packages: ${unmet[*]}"
  "$python" -m pip install -q --disable-pip-version-check "${unmet[@]}" ||
    fail "pip could not install ${unmet[*]}. Check the network, or pip's own settings, and run this script again."
}

# Everything the plugin is built from, as one hash.
plugin_inputs_hash() {
  (cd "$repo" && find CMakeLists.txt pyproject.toml cmake filter_dcharts vcg_ext python scripts/fetch-meshlab-headers.sh \
    -type f -not -path '*/__pycache__/*' -not -path '*.egg-info/*' -print0 | LC_ALL=C sort -z | xargs -0 sha256sum | sha256sum)
}

# The requirements written in pyproject.toml: to build, then to run.
plugin_requirements() {
  "$python" - "$repo/pyproject.toml" <<'PY'
import sys
from pip._vendor import tomli
with open(sys.argv[1], "rb") as file:
    project = tomli.load(file)
print(*project["build-system"]["requires"], *project["project"].get("dependencies", []), sep="\n")
PY
}

# Writes what a build says to file $1, and to the user how far it is: ninja begins lines with [done/all].
tell_progress() {
  local line last=0 tenths
  while IFS= read -r line; do
    printf '%s\n' "$line" >&3
    if [[ $line =~ ^[[:space:]]*\[([0-9]+)/([0-9]+)\] ]] && ((BASH_REMATCH[2] >= 20)); then
      tenths=$((10 * BASH_REMATCH[1] / BASH_REMATCH[2]))
      ((tenths <= last)) || say "  ${tenths}0 %"
      last=$tenths
    fi
  done 3>"$1"
}

ensure_plugin() {
  local hash stamp=$venv/dcharts-plugin.sha256 requirements
  ensure_venv
  hash=$(plugin_inputs_hash)
  if [ "$hash" = "$(cat "$stamp" 2>/dev/null)" ] && [ -z "$(unmet_requirements pymeshlab-dcharts)" ]; then
    return 0
  fi
  mapfile -t requirements < <(plugin_requirements)
  ensure_venv "${requirements[@]}"
  say "Building the plugin for pymeshlab (the first time takes some minutes)"
  rm -f "$stamp"
  # Without isolation the build tools are those of .venv, so that a rebuild needs no network.
  local log=$venv/dcharts-build.log
  if ! "$python" -m pip install -v --disable-pip-version-check --no-build-isolation --no-deps --force-reinstall \
    --config-settings=build-dir="$repo/build-python" "$repo" 2>&1 | tell_progress "$log"; then
    grep -E 'error|Error|fetch-meshlab' "$log" | tail -n 15 >&2
    fail "The plugin could not be built. The whole log is in $log"
  fi
  "$python" -c 'import pymeshlab_dcharts' || fail "The plugin was built but pymeshlab could not load it."
  printf '%s\n' "$hash" >"$stamp"
}

ensure_build() {
  local log=$build/configure.log
  mkdir -p "$build"
  if ! cmake -S "$repo" -B "$build" -G Ninja "$@" >"$log" 2>&1; then
    tail -n 20 "$log" >&2
    fail "cmake could not set up the build. The whole log is in $log"
  fi
  grep -A 3 'CMake Warning' "$log" >&2 || true
}

build_targets() {
  local log=$build/build.log
  say "Building: $* (the first time takes some minutes)"
  if ! cmake --build "$build" --target "$@" 2>&1 | tell_progress "$log"; then
    grep -E -A 3 'error|FAILED' "$log" | head -n 30 >&2 || true
    fail "The build failed. The whole log is in $log"
  fi
}
