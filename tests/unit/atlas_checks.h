// SPDX-License-Identifier: GPL-3.0-or-later
/// Checks a finished atlas with code of its own: nothing here calls what it checks.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "common/surface_data.h"

namespace dcharts::test {

using Vec3 = std::array<double, 3>;

inline Vec3 Minus(const Vec3& a, const Vec3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline double Dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Vec3 Cross(const Vec3& a, const Vec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double Norm(const Vec3& a) { return std::sqrt(Dot(a, a)); }

inline double FaceArea(const SurfaceData& mesh, size_t f) {
  const Vec3 &a = mesh.vertices[mesh.faces[f][0]], &b = mesh.vertices[mesh.faces[f][1]],
             &c = mesh.vertices[mesh.faces[f][2]];
  return Norm(Cross(Minus(b, a), Minus(c, a))) / 2;
}

inline double TotalArea(const SurfaceData& mesh) {
  double area = 0;
  for (size_t f = 0; f < mesh.faces.size(); ++f) area += FaceArea(mesh, f);
  return area;
}

inline bool HasRepeatedVertex(const std::array<int, 3>& face) {
  return face[0] == face[1] || face[1] == face[2] || face[2] == face[0];
}

constexpr double kAreaFloorOfSquare = 1e-14;

/// Faces with less area than this are without area, to rounding.
inline double AreaFloor(const SurfaceData& mesh) {
  Vec3 low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
  for (const auto& face : mesh.faces) {
    if (HasRepeatedVertex(face)) continue;
    for (int v : face)
      for (size_t d = 0; d < 3; ++d) {
        low[d] = std::min(low[d], mesh.vertices[v][d]);
        high[d] = std::max(high[d], mesh.vertices[v][d]);
      }
  }
  const Vec3 size = Minus(high, low);
  return kAreaFloorOfSquare * Dot(size, size);
}

/// Per half-edge 3 f + i the half-edge across, where exactly two faces meet in an edge and agree in
/// orientation; else -1.
inline std::vector<int> Opposites(const SurfaceData& mesh) {
  std::map<std::pair<int, int>, std::vector<int>> edges;
  for (size_t f = 0; f < mesh.faces.size(); ++f)
    for (size_t i = 0; i < 3 && !HasRepeatedVertex(mesh.faces[f]); ++i) {
      const int a = mesh.faces[f][i], b = mesh.faces[f][(i + 1) % 3];
      edges[{std::min(a, b), std::max(a, b)}].push_back(static_cast<int>(3 * f + i));
    }
  std::vector<int> opposite(3 * mesh.faces.size(), -1);
  for (const auto& [ends, half_edges] : edges) {
    if (half_edges.size() != 2) continue;
    const int h = half_edges[0], o = half_edges[1];
    if (mesh.faces[h / 3][h % 3] == mesh.faces[o / 3][o % 3]) continue;
    opposite[h] = o;
    opposite[o] = h;
  }
  return opposite;
}

/// Disjoint sets.
class Sets {
 public:
  explicit Sets(size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }
  int Find(int a) { return parent_[a] == a ? a : parent_[a] = Find(parent_[a]); }
  void Join(int a, int b) { parent_[Find(a)] = Find(b); }

 private:
  std::vector<int> parent_;
};

/// Which faces hang together in the plane, and the topology of what hangs together.
struct UvTopology {
  std::vector<int> chart;         ///< per face, -1 for a face with a repeated vertex
  std::vector<int> glued;         ///< per half-edge the one across where the texcoords are the same, else -1
  std::vector<int> genus, loops;  ///< per chart
  double seam_length = 0;         ///< 3D, of the edges with several faces that are open, not normalized
};

/// 3D length of the edges where more than two faces meet, or two that disagree in orientation.
inline double OddEdgesLength(const SurfaceData& mesh) {
  std::map<std::pair<int, int>, int> faces_at, turns;  // turns: of two that agree 0
  for (const auto& face : mesh.faces)
    for (size_t i = 0; i < 3 && !HasRepeatedVertex(face); ++i) {
      const auto ends = std::minmax(face[i], face[(i + 1) % 3]);
      ++faces_at[ends];
      turns[ends] += face[i] < face[(i + 1) % 3] ? 1 : -1;
    }
  double length = 0;
  for (const auto& [ends, count] : faces_at)
    if (count > 2 || (count == 2 && turns[ends] != 0))
      length += Norm(Minus(mesh.vertices[ends.first], mesh.vertices[ends.second]));
  return length;
}

inline UvTopology TopologyOf(const SurfaceData& mesh, const std::vector<std::array<float, 6>>& uv) {
  const size_t face_count = mesh.faces.size();
  UvTopology topology;
  topology.glued = Opposites(mesh);
  Sets faces(face_count), corners(3 * face_count);
  auto next = [](int h) { return h % 3 == 2 ? h - 2 : h + 1; };
  auto same = [&](int h, int k) {
    return uv[h / 3][2 * (h % 3)] == uv[k / 3][2 * (k % 3)] &&
           uv[h / 3][2 * (h % 3) + 1] == uv[k / 3][2 * (k % 3) + 1];
  };
  topology.seam_length = OddEdgesLength(mesh);
  const std::vector<int> opposite = topology.glued;
  for (int h = 0; h < static_cast<int>(3 * face_count); ++h) {
    const int o = opposite[h];
    if (o < 0) continue;
    if (same(h, next(o)) && same(next(h), o)) {
      faces.Join(h / 3, o / 3);
      corners.Join(h, next(o));
      corners.Join(next(h), o);
    } else {
      topology.glued[h] = -1;
      const int a = mesh.faces[h / 3][h % 3], b = mesh.faces[h / 3][next(h) % 3];
      if (o > h) topology.seam_length += Norm(Minus(mesh.vertices[a], mesh.vertices[b]));
    }
  }
  std::map<int, int> number;
  topology.chart.assign(face_count, -1);
  for (int f = 0; f < static_cast<int>(face_count); ++f)
    if (!HasRepeatedVertex(mesh.faces[f]))
      topology.chart[f] = number.emplace(faces.Find(f), static_cast<int>(number.size())).first->second;

  const size_t chart_count = number.size();
  std::vector<std::set<int>> vertices(chart_count);
  std::vector<int> edges(chart_count, 0), face_counts(chart_count, 0);
  Sets boundary(3 * face_count);  // boundary half-edges, joined at shared corners
  std::map<int, int> outgoing;    // cut vertex -> a boundary half-edge at it
  topology.loops.assign(chart_count, 0);
  topology.genus.assign(chart_count, 0);
  std::vector<std::set<int>> loops(chart_count);
  for (int f = 0; f < static_cast<int>(face_count); ++f) {
    const int c = topology.chart[f];
    if (c < 0) continue;
    ++face_counts[c];
    for (int h = 3 * f; h < 3 * f + 3; ++h) {
      vertices[c].insert(corners.Find(h));
      edges[c] += topology.glued[h] < h;
      if (topology.glued[h] >= 0) continue;
      for (int end : {h, next(h)}) {
        const auto [it, fresh] = outgoing.emplace(corners.Find(end), h);
        if (!fresh) boundary.Join(h, it->second);
      }
    }
  }
  for (int h = 0; h < static_cast<int>(3 * face_count); ++h)
    if (topology.chart[h / 3] >= 0 && topology.glued[h] < 0)
      loops[topology.chart[h / 3]].insert(boundary.Find(h));
  for (size_t c = 0; c < chart_count; ++c) {
    topology.loops[c] = static_cast<int>(loops[c].size());
    const int euler = static_cast<int>(vertices[c].size()) - edges[c] + face_counts[c];
    topology.genus[c] = (2 - topology.loops[c] - euler) / 2;
  }
  return topology;
}

constexpr double kUvGrid = 16777216.0;  // texcoords are multiples of 2^-24: integers are exact

using GridUv = std::array<std::int64_t, 6>;

inline GridUv OnUvGrid(const std::array<float, 6>& uv) {
  GridUv grid;
  for (size_t k = 0; k < 6; ++k) grid[k] = std::llround(double(uv[k]) * kUvGrid);
  return grid;
}

inline std::int64_t TwiceGridArea(const GridUv& t) {
  return (t[2] - t[0]) * (t[5] - t[1]) - (t[3] - t[1]) * (t[4] - t[0]);
}

/// Interiors meet unless some edge's normal separates the two; exact. Triangles without area have no
/// interior.
inline bool InteriorsMeet(const GridUv& a, const GridUv& b) {
  if (TwiceGridArea(a) == 0 || TwiceGridArea(b) == 0) return false;
  for (const GridUv* t : {&a, &b})
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      const std::int64_t nx = (*t)[2 * j + 1] - (*t)[2 * i + 1], ny = (*t)[2 * i] - (*t)[2 * j];
      auto range = [&](const GridUv& s) {
        const std::int64_t p = nx * s[0] + ny * s[1], q = nx * s[2] + ny * s[3], r = nx * s[4] + ny * s[5];
        return std::make_pair(std::min({p, q, r}), std::max({p, q, r}));
      };
      const auto ra = range(a), rb = range(b);
      if (ra.second <= rb.first || rb.second <= ra.first) return false;
    }
  return true;
}

/// All pairs of overlapping triangles, found by comparing each with all whose x range meets its own.
inline std::vector<std::pair<int, int>> AllOverlaps(const std::vector<GridUv>& triangles) {
  struct Box {
    std::int64_t x0, x1, y0, y1;
    int face;
  };
  std::vector<Box> boxes;
  for (size_t f = 0; f < triangles.size(); ++f) {
    const GridUv& t = triangles[f];
    boxes.push_back({std::min({t[0], t[2], t[4]}), std::max({t[0], t[2], t[4]}), std::min({t[1], t[3], t[5]}),
                     std::max({t[1], t[3], t[5]}), static_cast<int>(f)});
  }
  std::sort(boxes.begin(), boxes.end(), [](const Box& a, const Box& b) { return a.x0 < b.x0; });
  std::vector<std::pair<int, int>> pairs;
  for (size_t i = 0; i < boxes.size(); ++i)
    for (size_t j = i + 1; j < boxes.size() && boxes[j].x0 < boxes[i].x1; ++j) {
      const Box &a = boxes[i], &b = boxes[j];
      if (a.y0 >= b.y1 || b.y0 >= a.y1 || !InteriorsMeet(triangles[a.face], triangles[b.face])) continue;
      pairs.push_back({std::min(a.face, b.face), std::max(a.face, b.face)});
    }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

/// L2 and Linf stretch of Sander et al. 2001, from the Jacobian in a frame of each triangle's own plane.
struct Stretch {
  double l2 = 1, linf = 1;
  double uncertain =
      0;  ///< relative error that rounding of coordinates may make, of the thinnest face's area
};
inline Stretch StretchOf(const SurfaceData& mesh, const std::vector<std::array<float, 6>>& uv) {
  double area3 = 0, area2 = 0, squares = 0, worst = 0, thinnest = 0;
  // Coordinates are rounded to digits of the mesh's size, not of the face's.
  const double area_floor = AreaFloor(mesh), size = std::sqrt(area_floor / kAreaFloorOfSquare);
  for (size_t f = 0; f < mesh.faces.size(); ++f) {
    const double area = FaceArea(mesh, f);
    if (!(area > area_floor)) continue;
    const Vec3& a = mesh.vertices[mesh.faces[f][0]];
    const Vec3 e = Minus(mesh.vertices[mesh.faces[f][1]], a), g = Minus(mesh.vertices[mesh.faces[f][2]], a);
    thinnest = std::max(thinnest, size * std::max(Norm(e), Norm(g)) / area);
    // Corners in the plane: (0, 0), (length of e, 0), (x, height).
    const double length = Norm(e), x = Dot(e, g) / length, height = 2 * area / length;
    const auto& t = uv[f];
    const double ux = double(t[2]) - t[0], uy = double(t[3]) - t[1], vx = double(t[4]) - t[0],
                 vy = double(t[5]) - t[1];
    const double det = ux * vy - uy * vx;
    // J maps (ux, uy) to (length, 0) and (vx, vy) to (x, height).
    const double a11 = (length * vy - x * uy) / det, a12 = (x * ux - length * vx) / det,
                 a21 = -height * uy / det, a22 = height * ux / det;
    const double largest = (std::hypot(a11 + a22, a21 - a12) + std::hypot(a11 - a22, a12 + a21)) / 2;
    area3 += area;
    area2 += std::abs(det) / 2;
    squares += area * (a11 * a11 + a12 * a12 + a21 * a21 + a22 * a22) / 2;
    worst = std::max(worst, largest);
  }
  if (!(area3 > 0)) return {};
  return {std::sqrt(squares / area3 * area2 / area3), worst * std::sqrt(area2 / area3), 1e-15 * thinnest};
}

/// The largest L2 stretch of a chart at its own scale.
inline double WorstChartStretch(const SurfaceData& mesh, const SurfaceChange& atlas) {
  double worst = 1;
  const int last = *std::max_element(atlas.chart_ids.begin(), atlas.chart_ids.end());
  for (int c = 0; c <= last; ++c) {
    SurfaceData chart;
    chart.vertices = mesh.vertices;
    std::vector<std::array<float, 6>> uv;
    for (size_t f = 0; f < mesh.faces.size(); ++f) {
      if (atlas.chart_ids[f] != c) continue;
      chart.faces.push_back(mesh.faces[f]);
      uv.push_back(atlas.wedge_texcoords[f]);
    }
    worst = std::max(worst, StretchOf(chart, uv).l2);
  }
  return worst;
}

/// What is promised of a finished atlas. Returns what is wrong, a line each; empty when all is well.
inline std::string WrongInAtlas(const SurfaceData& mesh, const SurfaceChange& atlas, bool disks) {
  std::ostringstream wrong;
  const size_t face_count = mesh.faces.size();
  const auto& uv = atlas.wedge_texcoords;
  if (uv.size() != face_count || atlas.chart_ids.size() != face_count || atlas.colors.size() != face_count) {
    wrong << "arrays of the wrong size\n";
    return wrong.str();
  }
  std::vector<GridUv> grid;
  int outside = 0, off_grid = 0, flipped = 0;
  const double area_floor = AreaFloor(mesh);
  for (size_t f = 0; f < face_count; ++f) {
    for (float x : uv[f]) {
      outside += !(x >= 0 && x <= 1);
      off_grid += x * kUvGrid != std::floor(x * kUvGrid);
    }
    grid.push_back(OnUvGrid(uv[f]));
    const std::int64_t area = TwiceGridArea(grid.back());
    flipped += area < 0 || (area == 0 && FaceArea(mesh, f) > area_floor);
  }
  if (outside > 0) wrong << outside << " texcoords outside [0,1]\n";
  if (off_grid > 0) wrong << off_grid << " texcoords that are no multiple of 2^-24\n";
  if (flipped > 0) wrong << flipped << " flipped or degenerate faces\n";
  if (outside + off_grid > 0) return wrong.str();
  const auto overlaps = AllOverlaps(grid);
  if (!overlaps.empty())
    wrong << overlaps.size() << " overlaps, the first of faces " << overlaps[0].first << " and "
          << overlaps[0].second << "\n";

  // Charts: ids 0..n-1, each one piece in the plane, and every piece of one id.
  const UvTopology topology = TopologyOf(mesh, uv);
  std::map<int, int> id_of_piece, piece_of_id;
  std::set<int> ids(atlas.chart_ids.begin(), atlas.chart_ids.end());
  if (*ids.begin() != 0 || *ids.rbegin() != static_cast<int>(ids.size()) - 1) wrong << "ids are not 0..n-1\n";
  if (!atlas.report.charts || *atlas.report.charts != static_cast<int>(ids.size()))
    wrong << "report.charts is not the number of charts\n";
  int torn = 0, joined = 0;
  for (size_t f = 0; f < face_count; ++f) {
    if (topology.chart[f] < 0) continue;
    torn += piece_of_id.emplace(atlas.chart_ids[f], topology.chart[f]).first->second != topology.chart[f];
    joined += id_of_piece.emplace(topology.chart[f], atlas.chart_ids[f]).first->second != atlas.chart_ids[f];
  }
  if (torn > 0) wrong << torn << " faces of a chart apart from its first piece\n";
  if (joined > 0) wrong << joined << " faces glued to another chart\n";
  for (size_t c = 0; c < topology.genus.size(); ++c) {
    if (topology.genus[c] != 0) wrong << "piece " << c << " has genus " << topology.genus[c] << "\n";
    if (topology.loops[c] < 1) wrong << "piece " << c << " has no boundary\n";
    if (disks && topology.loops[c] != 1)
      wrong << "piece " << c << " has " << topology.loops[c] << " boundary loops\n";
  }

  const Stretch stretch = StretchOf(mesh, uv);
  const double tolerance = 1e-6 + stretch.uncertain;
  auto differs = [tolerance](const std::optional<double>& reported, double measured) {
    return !reported || !(std::abs(*reported - measured) <= tolerance * measured);
  };
  if (flipped == 0 && differs(atlas.report.l2_stretch, stretch.l2))
    wrong << "l2_stretch is " << stretch.l2 << ", reported " << atlas.report.l2_stretch.value_or(-1) << "\n";
  if (flipped == 0 && differs(atlas.report.linf_stretch, stretch.linf))
    wrong << "linf_stretch is " << stretch.linf << ", reported " << atlas.report.linf_stretch.value_or(-1)
          << "\n";
  const double seams = topology.seam_length / std::sqrt(TotalArea(mesh));
  // Where all faces are needles, the area that it is divided by is known to few digits.
  const double seam_tolerance = 1e-6 + area_floor / TotalArea(mesh);
  if (!atlas.report.seam_length || std::abs(*atlas.report.seam_length - seams) > seam_tolerance * (1 + seams))
    wrong << "seam_length is " << seams << ", reported " << atlas.report.seam_length.value_or(-1) << "\n";
  if (atlas.report.flipped_faces.value_or(-1) != 0) wrong << "report.flipped_faces is not 0\n";
  if (atlas.report.degenerate_faces.value_or(-1) != 0) wrong << "report.degenerate_faces is not 0\n";
  if (atlas.report.overlapping_faces.value_or(-1) != 0) wrong << "report.overlapping_faces is not 0\n";
  if (atlas.report.unassigned_faces.value_or(-1) != 0) wrong << "report.unassigned_faces is not 0\n";
  return wrong.str();
}

}  // namespace dcharts::test
