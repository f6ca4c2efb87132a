// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/slits.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace dcharts {
namespace {

double TwiceAreaOf(const Points2& uv, const Triangles& triangles, int f) {
  const Eigen::RowVector2d a = uv.row(triangles(f, 0)), b = uv.row(triangles(f, 1)) - a,
                           c = uv.row(triangles(f, 2)) - a;
  return b.x() * c.y() - b.y() * c.x();
}

}  // namespace

void OpenSlits(const ChartPatch& patch, const std::vector<int>& twin, double gap, Points2& uv) {
  std::map<int, std::vector<int>> sides;
  for (int h = 0; h < patch.HalfEdgeCount(); ++h)
    if (patch.opposite[h] < 0) sides[twin[patch.Vertex(h)]].push_back(patch.Vertex(h));
  std::vector<char> touching(patch.VertexCount(), 0);
  bool any = false;
  for (const auto& entry : sides)
    for (size_t i = 0; i < entry.second.size(); ++i)
      for (size_t j = i + 1; j < entry.second.size(); ++j) {
        const int v = entry.second[i], w = entry.second[j];
        if ((uv.row(v) - uv.row(w)).norm() >= gap) continue;
        touching[v] = touching[w] = 1;
        any = true;
      }
  if (!any) return;

  // Inwards: the mean of the normals of the boundary edges at the vertex.
  Points2 inward = Points2::Zero(uv.rows(), 2);
  std::vector<double> shortest(patch.VertexCount(), 1e300);
  std::vector<std::vector<int>> faces_at(patch.VertexCount());
  for (int h = 0; h < patch.HalfEdgeCount(); ++h) {
    const int v = patch.Vertex(h), w = patch.Vertex(Next(h));
    const Eigen::RowVector2d edge = uv.row(w) - uv.row(v);
    for (int end : {v, w}) shortest[end] = std::min(shortest[end], edge.norm());
    if (touching[v]) faces_at[v].push_back(h / 3);
    if (patch.opposite[h] >= 0 || !(edge.norm() > 0)) continue;
    const Eigen::RowVector2d normal(-edge.y() / edge.norm(), edge.x() / edge.norm());
    inward.row(v) += normal;
    inward.row(w) += normal;
  }
  constexpr double kShare = 0.05;  // of the shortest edge at the vertex
  for (int v = 0; v < patch.VertexCount(); ++v) {
    if (!touching[v] || !(inward.row(v).norm() > 1e-9)) continue;
    const Eigen::RowVector2d old = uv.row(v), direction = inward.row(v).normalized();
    std::vector<double> area;
    for (int f : faces_at[v]) area.push_back(TwiceAreaOf(uv, patch.mesh.triangles, f));
    double step = kShare * shortest[v];
    for (int attempt = 0; attempt < 8; ++attempt, step /= 2) {
      uv.row(v) = old + step * direction;
      bool good = true;
      for (size_t k = 0; k < area.size() && good; ++k)
        good = TwiceAreaOf(uv, patch.mesh.triangles, faces_at[v][k]) > 0.5 * area[k];
      if (good) break;
      uv.row(v) = old;
    }
  }
}

}  // namespace dcharts
