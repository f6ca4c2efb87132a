// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <vector>

#include "common/chart_ids.h"
#include "surface/surface_graph.h"

namespace dcharts {

/// Seam bit mask per face: bit i = edge (i, i+1).
using SeamMask = std::vector<std::uint8_t>;

inline bool IsSeam(const SeamMask& seams, int half_edge) {
  return seams[half_edge / 3] >> (half_edge % 3) & 1;
}
inline void SetSeam(SeamMask& seams, int half_edge) {
  seams[half_edge / 3] = static_cast<std::uint8_t>(seams[half_edge / 3] | 1 << (half_edge % 3));
}
/// A side of an edge is no seam any more.
inline void ClearSeam(SeamMask& seams, int half_edge) {
  seams[half_edge / 3] = static_cast<std::uint8_t>(seams[half_edge / 3] & ~(1 << (half_edge % 3)));
}
inline void MarkSeam(SeamMask& seams, int half_edge, bool is_seam) {
  is_seam ? SetSeam(seams, half_edge) : ClearSeam(seams, half_edge);
}

/// Face quality as users and other tools write it: an integer to within 0.01, at least 0; all else is
/// unassigned.
inline int ChartIdOfQuality(double quality) {
  constexpr double kLargestId = 2e9;
  if (!(quality >= 0) || quality > kLargestId) return kUnassigned;
  const double rounded = std::round(quality);
  return std::abs(quality - rounded) <= 0.01 ? static_cast<int>(rounded) : kUnassigned;
}

/// Connected pieces become charts of their own and ids become 0..n-1, in the order of the old ids; the piece
/// that holds a chart's first face keeps the id, the others are appended. Unassigned faces stay so. With
/// `seams`, pieces are connected over edges that are no seam. Applied twice it changes nothing.
template <class MeshType>
void SplitAndCompact(const SurfaceGraph<MeshType>& surface, ChartIds& ids, const SeamMask* seams = nullptr) {
  const int face_count = surface.FaceCount();
  std::vector<int> piece(face_count, -1);
  std::vector<int> piece_id, stack;
  for (int start = 0; start < face_count; ++start) {
    if (piece[start] >= 0 || ids[start] < 0) continue;
    const int p = static_cast<int>(piece_id.size());
    piece_id.push_back(ids[start]);
    piece[start] = p;
    stack.assign(1, start);
    while (!stack.empty()) {
      const int f = stack.back();
      stack.pop_back();
      for (int h = 3 * f; h < 3 * f + 3; ++h) {
        const int g = surface.Neighbour(h);
        if (g < 0 || piece[g] >= 0 || ids[g] != ids[f] || (seams && IsSeam(*seams, h))) continue;
        piece[g] = p;
        stack.push_back(g);
      }
    }
  }
  std::map<int, int> first_piece;  // of each old id
  for (int p = 0; p < static_cast<int>(piece_id.size()); ++p) first_piece.emplace(piece_id[p], p);
  std::vector<int> new_id(piece_id.size(), kUnassigned);
  int next = 0;
  for (const auto& entry : first_piece) new_id[entry.second] = next++;
  for (int& id : new_id)
    if (id == kUnassigned) id = next++;
  for (int f = 0; f < face_count; ++f)
    if (ids[f] >= 0) ids[f] = new_id[piece[f]];
}

/// Which of the charts 0..count-1 have no face, or several pieces.
template <class MeshType>
std::vector<bool> ChartsNotInOnePiece(const SurfaceGraph<MeshType>& surface, const ChartIds& ids, int count) {
  std::vector<bool> not_one(count, true);
  ChartIds pieces = ids;
  SplitAndCompact(surface, pieces);
  std::vector<int> piece_of(count, kUnassigned);
  for (size_t f = 0; f < ids.size(); ++f) {
    if (ids[f] < 0) continue;
    int& piece = piece_of[ids[f]];
    if (piece == kUnassigned) {
      piece = pieces[f];
      not_one[ids[f]] = false;
    } else if (piece != pieces[f]) {
      not_one[ids[f]] = true;
    }
  }
  return not_one;
}

/// Half-edges between faces of different charts, as a seam mask on both sides.
template <class MeshType>
SeamMask ChartBorders(const SurfaceGraph<MeshType>& surface, const ChartIds& ids) {
  SeamMask seams(surface.FaceCount(), 0);
  for (int h = 0; h < surface.HalfEdgeCount(); ++h)
    if (surface.Neighbour(h) >= 0 && ids[surface.Neighbour(h)] != ids[h / 3]) SetSeam(seams, h);
  return seams;
}

/// 3D length of the seams, each edge once, over the square root of the area. Odd edges are always seams.
template <class MeshType>
double SeamLength(const SurfaceGraph<MeshType>& surface, const SeamMask& seams) {
  double length = surface.OddEdgesLength();
  for (int h = 0; h < surface.HalfEdgeCount(); ++h)
    if (surface.Opposite(h) > h && IsSeam(seams, h)) length += surface.Length(h);
  return length / std::sqrt(surface.TotalArea());
}

/// The faces of each chart, in increasing order.
inline std::vector<std::vector<int>> FacesOfCharts(const ChartIds& ids) {
  std::vector<std::vector<int>> faces(ChartCount(ids));
  for (int f = 0; f < static_cast<int>(ids.size()); ++f)
    if (ids[f] >= 0) faces[ids[f]].push_back(f);
  return faces;
}

/// Of the charts whose first face is_wanted() takes alone.
template <class IsWanted>
std::vector<std::vector<int>> FacesOfCharts(const ChartIds& ids, const IsWanted& is_wanted) {
  std::vector<std::vector<int>> faces = FacesOfCharts(ids);
  faces.erase(std::remove_if(faces.begin(), faces.end(),
                             [&](const std::vector<int>& chart) { return !is_wanted(chart.front()); }),
              faces.end());
  return faces;
}

/// A colour that differs well between neighbouring ids; grey for unassigned faces.
std::array<std::uint8_t, 3> ChartColor(int id);

}  // namespace dcharts
