// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <stdexcept>
#include <utility>

#include <boost/polygon/voronoi.hpp>

namespace dcharts::shapes {
namespace {

using Loops = std::vector<std::vector<Eigen::Vector2d>>;

double Cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Even-odd rule over all loops.
bool Inside(const Loops& loops, const Eigen::Vector2d& p) {
  bool inside = false;
  for (const auto& loop : loops)
    for (size_t i = 0, j = loop.size() - 1; i < loop.size(); j = i++) {
      const Eigen::Vector2d &a = loop[i], &b = loop[j];
      if ((a.y() > p.y()) != (b.y() > p.y()) &&
          p.x() < a.x() + (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y()))
        inside = !inside;
    }
  return inside;
}

double DistanceToLoops(const Loops& loops, const Eigen::Vector2d& p) {
  double best = std::numeric_limits<double>::infinity();
  for (const auto& loop : loops)
    for (size_t i = 0, j = loop.size() - 1; i < loop.size(); j = i++) {
      const Eigen::Vector2d edge = loop[i] - loop[j];
      const double t = std::clamp((p - loop[j]).dot(edge) / edge.squaredNorm(), 0.0, 1.0);
      best = std::min(best, (p - loop[j] - t * edge).norm());
    }
  return best;
}

/// Delaunay triangles as the dual of the Voronoi diagram.
std::vector<std::array<int, 3>> Delaunay(const std::vector<Eigen::Vector2d>& points, double scale) {
  using Site = boost::polygon::point_data<std::int32_t>;
  std::vector<Site> sites;
  for (const auto& p : points)
    sites.emplace_back(static_cast<std::int32_t>(std::lround(p.x() * scale)),
                       static_cast<std::int32_t>(std::lround(p.y() * scale)));
  boost::polygon::voronoi_diagram<double> diagram;
  boost::polygon::construct_voronoi(sites.begin(), sites.end(), &diagram);
  std::vector<std::array<int, 3>> faces;
  for (const auto& vertex : diagram.vertices()) {
    std::vector<int> around;
    const auto* edge = vertex.incident_edge();
    do {
      around.push_back(static_cast<int>(edge->cell()->source_index()));
      edge = edge->rot_next();
    } while (edge != vertex.incident_edge());
    for (size_t i = 2; i < around.size(); ++i) {
      std::array<int, 3> face{around[0], around[i - 1], around[i]};
      const auto& a = points[static_cast<size_t>(face[0])];
      const double area =
          Cross(points[static_cast<size_t>(face[1])] - a, points[static_cast<size_t>(face[2])] - a);
      if (area < 0) std::swap(face[1], face[2]);
      faces.push_back(face);
    }
  }
  return faces;
}

}  // namespace

PlanarMesh FillPolygon(const Loops& loops, double edge_length) {
  PlanarMesh mesh;
  Eigen::Vector2d low = loops[0][0], high = low;
  std::set<std::pair<int, int>> border;
  for (const auto& loop : loops) {
    const int first = static_cast<int>(mesh.points.size()), count = static_cast<int>(loop.size());
    for (int i = 0; i < count; ++i) border.insert(std::minmax(first + i, first + (i + 1) % count));
    for (const auto& p : loop) {
      mesh.points.push_back(p);
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
  }
  const double row_height = edge_length * std::sqrt(0.75);
  const int rows = static_cast<int>((high.y() - low.y()) / row_height);
  const int columns = static_cast<int>((high.x() - low.x()) / edge_length);
  for (int r = 0; r <= rows; ++r)
    for (int c = 0; c <= columns; ++c) {
      const Eigen::Vector2d p =
          low + Eigen::Vector2d((c + (r % 2 ? 0.5 : 0.0)) * edge_length, r * row_height);
      if (Inside(loops, p) && DistanceToLoops(loops, p) > 0.7 * edge_length) mesh.points.push_back(p);
    }

  // Move the inner points to the middle of their neighbours a few times: evens out the rim of the lattice.
  const double scale = 1e8 / std::max((high - low).maxCoeff(), high.cwiseAbs().maxCoeff());
  const size_t fixed = border.size();
  const auto triangulate = [&] {
    mesh.faces = Delaunay(mesh.points, scale);
    const auto outside = [&](const std::array<int, 3>& f) {
      const Eigen::Vector2d middle =
          (mesh.points[static_cast<size_t>(f[0])] + mesh.points[static_cast<size_t>(f[1])] +
           mesh.points[static_cast<size_t>(f[2])]) /
          3;
      return !Inside(loops, middle);
    };
    mesh.faces.erase(std::remove_if(mesh.faces.begin(), mesh.faces.end(), outside), mesh.faces.end());
  };
  for (int round = 0; round < 10; ++round) {
    triangulate();
    std::vector<Eigen::Vector2d> sum(mesh.points.size(), Eigen::Vector2d::Zero());
    std::vector<int> count(mesh.points.size(), 0);
    for (const auto& f : mesh.faces)
      for (size_t i = 0; i < 3; ++i) {
        sum[static_cast<size_t>(f[i])] += mesh.points[static_cast<size_t>(f[(i + 1) % 3])];
        ++count[static_cast<size_t>(f[i])];
      }
    for (size_t v = fixed; v < mesh.points.size(); ++v) mesh.points[v] = sum[v] / count[v];
  }
  triangulate();

  std::set<std::pair<int, int>> once;  // edges with one face: they must be the loops' own
  for (const auto& f : mesh.faces)
    for (size_t i = 0; i < 3; ++i) {
      const std::pair<int, int> edge = std::minmax(f[i], f[(i + 1) % 3]);
      if (!once.insert(edge).second) once.erase(edge);
    }
  if (once != border)
    throw std::invalid_argument("The loops need shorter edges to be filled with triangles.");
  return mesh;
}

}  // namespace dcharts::shapes
