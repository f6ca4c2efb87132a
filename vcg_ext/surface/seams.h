// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "surface/chart_patch.h"
#include "surface/charts.h"

namespace dcharts {

/// Wedge texcoords per face, u0 v0 u1 v1 u2 v2, as hosts store them.
using WedgeTexcoords = std::vector<std::array<float, 6>>;

inline bool SameUv(const std::array<float, 6>& a, int i, const std::array<float, 6>& b, int j) {
  return a[2 * i] == b[2 * j] && a[2 * i + 1] == b[2 * j + 1];
}

/// Edges over which texcoords jump, at one end or both.
template <class MeshType>
SeamMask SeamsOfTexcoords(const SurfaceGraph<MeshType>& surface, const WedgeTexcoords& uv) {
  SeamMask seams(surface.FaceCount(), 0);
  for (int h = 0; h < surface.HalfEdgeCount(); ++h) {
    const int o = surface.Opposite(h);
    if (o < 0) continue;
    if (!SameUv(uv[h / 3], h % 3, uv[o / 3], Next(o) % 3) ||
        !SameUv(uv[h / 3], Next(h) % 3, uv[o / 3], o % 3))
      SetSeam(seams, h);
  }
  return seams;
}

/// Takes back seams that the texcoords don't show: very short ones, whose sides are one in float32.
template <class MeshType>
void DropSeamsNotIn(const WedgeTexcoords& uv, const SurfaceGraph<MeshType>& surface, SeamMask& seams) {
  const SeamMask shown = SeamsOfTexcoords(surface, uv);
  for (int h = 0; h < surface.HalfEdgeCount(); ++h)
    if (surface.Opposite(h) >= 0 && !IsSeam(shown, h)) ClearSeam(seams, h);
}

/// True when every face has three different, finite corners: what provisional and finished texcoords have,
/// and the zeros of a mesh that never had any have not.
inline bool LooksLikeTexcoords(const WedgeTexcoords& uv) {
  for (const auto& t : uv) {
    for (float x : t)
      if (!std::isfinite(x)) return false;
    if (SameUv(t, 0, t, 1) || SameUv(t, 1, t, 2) || SameUv(t, 2, t, 0)) return false;
  }
  return true;
}

/// True when seams fit chart ids: the same on both sides of an edge, every border between charts is a seam,
/// and no chart falls apart along them.
template <class MeshType>
bool SeamsAgree(const SurfaceGraph<MeshType>& surface, const ChartIds& ids, const SeamMask& seams) {
  for (int h = 0; h < surface.HalfEdgeCount(); ++h) {
    const int o = surface.Opposite(h);
    if (o < 0) continue;
    if (IsSeam(seams, h) != IsSeam(seams, o)) return false;
    if (ids[h / 3] != ids[o / 3] && !IsSeam(seams, h)) return false;
  }
  ChartIds whole = ids, parted = ids;
  SplitAndCompact(surface, whole);
  SplitAndCompact(surface, parted, &seams);
  return whole == parted;
}

/// Takes back seam edges that open nothing: both ends stay whole, as for a single edge inside a chart.
template <class MeshType>
void DropIneffectiveSeams(const SurfaceGraph<MeshType>& surface, SeamMask& seams) {
  const CutVertices cut = OpenAtSeams(surface, seams);
  for (int h = 0; h < surface.HalfEdgeCount(); ++h) {
    const int o = surface.Opposite(h);
    if (o < 0 || !IsSeam(seams, h)) continue;
    if (cut.of_corner[h] == cut.of_corner[Next(o)] && cut.of_corner[Next(h)] == cut.of_corner[o])
      for (int k : {h, o}) ClearSeam(seams, k);
  }
}

/// Texcoords that are equal exactly where faces hang together: each cut vertex has a place of its own on a
/// grid in [0,1]^2. They carry the seams through files that keep texcoords only.
template <class MeshType>
WedgeTexcoords ProvisionalTexcoords(const SurfaceGraph<MeshType>& surface, const SeamMask& seams) {
  const CutVertices cut = OpenAtSeams(surface, seams);
  int side = 1;
  while (side * side < cut.count) side *= 2;  // a power of two: the grid's places are exact in float
  WedgeTexcoords uv(surface.FaceCount());
  for (int h = 0; h < surface.HalfEdgeCount(); ++h) {
    const int place = cut.of_corner[h];
    uv[h / 3][2 * (h % 3)] = static_cast<float>(place % side) / static_cast<float>(side);
    uv[h / 3][2 * (h % 3) + 1] = static_cast<float>(place / side) / static_cast<float>(side);
  }
  return uv;
}

}  // namespace dcharts
