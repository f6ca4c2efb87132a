#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Gets the MeshLab source trees whose headers the plugins are built against, from Debian's source packages.
# usage: fetch-meshlab-headers.sh [2020.09] [2025.07]        (default: both)
# Prints one line "VERSION FOLDER" per tree on stdout. The trees stay in $DCHARTS_CACHE (default: the folder
# dcharts in $XDG_CACHE_HOME or ~/.cache); a tree that is there already is used as it is, without a network.
# Needs no root and leaves /etc/apt alone: it has apt folders of its own and takes the machine's own mirror.
set -euo pipefail

cache=${DCHARTS_CACHE:-${XDG_CACHE_HOME:-$HOME/.cache}/dcharts}
keyring=/usr/share/keyrings/debian-archive-keyring.gpg
work=
trap '[ -z "$work" ] || rm -rf "$work"' EXIT

# What to know of a version: the suites that may hold it, the package version (a pattern: the part after the
# dash is Debian's own and the tarball stays the same), the tarball and its hash, a header it must contain.
describe() {
  version=$1
  case $version in
    2020.09)
      suites="bookworm" pattern="2020.09+dfsg1-*" tarball="meshlab_2020.09+dfsg1.orig.tar.xz"
      sha256=d6715352ff65caffdec0292858d4263eb0c3cbbf3b1e5c2e2bab218e3f234630
      variable=MESHLAB_2020_SOURCE header=src/common/interfaces.h ;;
    2025.07)
      suites="forky sid" pattern="2025.07~dfsg-*" tarball="meshlab_2025.07~dfsg.orig.tar.xz"
      sha256=d22c98d362f2a284e481af8dbfc272b2222f5b9c67b3cf8bec57d1c3161886f4
      variable=MESHLAB_2025_SOURCE header=src/common/plugins/interfaces/filter_plugin.h ;;
    *)
      echo "fetch-meshlab-headers: unknown version $version; known are 2020.09 and 2025.07" >&2
      exit 2 ;;
  esac
}

give_up() {
  echo "fetch-meshlab-headers: MeshLab $version: $1" >&2
  echo "If you have a source tree of MeshLab $version with its vcglib, tell CMake:" \
    "-D$variable=/path/to/meshlab" >&2
  exit 1
}

# The apt tool $1 with folders of our own. A mirror that lags behind forky's expiry date is good enough: signatures are
# checked, and the tarball's hash.
private() {
  local tool=$1
  shift
  "$tool" -q -o Dir::Etc::sourcelist=/dev/null -o Dir::Etc::sourceparts="$work/etc" \
    -o Dir::State::lists="$work/lists" -o Dir::Cache="$work/cache" \
    -o APT::Sandbox::User=root -o Acquire::Retries=3 -o Acquire::Check-Valid-Until=false "$@"
}

# The mirror from which this machine gets Debian: that of its own release, else any that looks like one.
# Asks apt for the addresses it would use, which needs neither a network nor root.
find_mirror() {
  local codename
  codename=$(. /etc/os-release && echo "${VERSION_CODENAME:-}")
  apt-get update --print-uris 2>/dev/null | sed -n "s|^'\(.*\)/dists/\(.*\)/InRelease'.*|\1 \2|p" |
    awk -v release="$codename" '
      $2 == release && !own { own = $1 }
      $1 ~ /\/debian$/ && !other { other = $1 }
      END { print own ? own : other }'
}

# Puts $tarball into $work.
download() {
  local mirror suite candidate
  command -v apt-get >/dev/null || give_up "there is no apt-get on this machine."
  [ -r "$keyring" ] || give_up "there is no $keyring (package debian-archive-keyring)."
  mirror=$(find_mirror)
  [ -n "$mirror" ] || give_up "this machine's apt configuration names no Debian mirror."
  mkdir -p "$work/etc" "$work/lists/partial" "$work/cache/archives/partial"
  for suite in $suites; do
    printf 'Types: deb-src\nURIs: %s\nSuites: %s\nComponents: main\nSigned-By: %s\n' \
      "$mirror" "$suite" "$keyring" >"$work/etc/meshlab.sources"
    if ! private apt-get -o APT::Update::Error-Mode=any update >"$work/log" 2>&1; then
      grep '^E:' "$work/log" >&2 || cat "$work/log" >&2
      continue
    fi
    for candidate in $(private apt-cache showsrc --only-source meshlab 2>/dev/null | awk '$1 == "Version:" { print $2 }'); do
      # shellcheck disable=SC2053  # the right side is a pattern
      [[ $candidate == $pattern ]] || continue
      (cd "$work" && private apt-get source --download-only --tar-only "meshlab=$candidate") \
        >"$work/log" 2>&1 || cat "$work/log" >&2
      [ ! -e "$work/$tarball" ] || return 0
    done
  done
  give_up "no source package $pattern could be had from the mirror (suites: $suites)."
}

fetch() {
  local tree=$cache/meshlab-$version
  if [ ! -e "$tree/$header" ]; then
    echo "Getting the headers of MeshLab $version..." >&2
    mkdir -p "$cache"
    work=$(mktemp -d "$cache/fetch.XXXXXX")
    download
    echo "$sha256  $work/$tarball" | sha256sum --check --status ||
      give_up "the downloaded $tarball is not the expected one (its sha256 differs)."
    mkdir "$work/tree"
    tar -xf "$work/$tarball" -C "$work/tree" --strip-components=1 ||
      give_up "the tarball could not be unpacked (tar and xz-utils are needed)."
    rm -rf "$tree" && mv -T "$work/tree" "$tree" # in one step: another run sees all of it or nothing
    rm -rf "$work"
    work=
  fi
  echo "$version $tree"
}

[ $# -gt 0 ] || set -- 2020.09 2025.07
for version in "$@"; do
  describe "$version"
  fetch
done
