// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/map_region.h"

#include <algorithm>

namespace dcharts {
namespace {

std::size_t At(Eigen::Index i) { return static_cast<std::size_t>(i); }

}  // namespace

MapRegion::MapRegion(const ChartMesh& chart, const RestShapes& shapes, const PlanePoints& uv,
                     const std::vector<char>& moves, VertexBlockSystem& system)
    : chart_(chart), system_(system) {
  const Eigen::RowVector3d box = chart.positions.colwise().maxCoeff() - chart.positions.colwise().minCoeff();
  area_floor_ = kAreaFloor * box.squaredNorm();
  // Those that move come first, as a system wants it.
  std::vector<int> local(moves.size(), -1);
  const auto add_vertex = [&](int v) {
    local[At(v)] = static_cast<int>(vertices_.size());
    vertices_.push_back(v);
  };
  for (std::size_t v = 0; v < moves.size(); ++v)
    if (moves[v]) add_vertex(static_cast<int>(v));
  const int free_count = static_cast<int>(vertices_.size());
  for (int t = 0; t < static_cast<int>(chart.triangles.rows()); ++t) {
    Complex corner[3];
    bool any_moves = false;
    for (int i = 0; i < 3; ++i) {
      corner[i] = uv[At(chart.triangles(t, i))];
      any_moves |= moves[At(chart.triangles(t, i))] != 0;
    }
    if (!any_moves) {
      Add(t, corner, of_rest_);
      continue;
    }
    faces_.push_back(t);
    for (int i = 0; i < 3; ++i)
      if (local[At(chart.triangles(t, i))] < 0) add_vertex(chart.triangles(t, i));
  }
  triangles_.resize(static_cast<Eigen::Index>(faces_.size()), 3);
  shapes_.reserve(faces_.size());
  for (std::size_t k = 0; k < faces_.size(); ++k) {
    for (int i = 0; i < 3; ++i)
      triangles_(static_cast<Eigen::Index>(k), i) = local[At(chart.triangles(faces_[k], i))];
    shapes_.push_back(shapes[At(faces_[k])]);
  }
  for (const int v : vertices_) uv_.push_back(uv[At(v)]);
  if (free_count < static_cast<int>(moves.size()))
    own_system_.emplace(static_cast<int>(vertices_.size()), free_count, triangles_);
}

StretchFigures MapRegion::Measure(const PlanePoints& uv) const {
  StretchFigures figures = of_rest_;
  for (std::size_t k = 0; k < faces_.size(); ++k) {
    const auto corner = [&](int i) { return uv[At(triangles_(static_cast<Eigen::Index>(k), i))]; };
    Add(faces_[k], {corner(0), corner(1), corner(2)}, figures);
  }
  return figures;
}

void MapRegion::Write(const PlanePoints& uv, PlanePoints& of_chart) const {
  for (std::size_t k = 0; k < vertices_.size(); ++k) of_chart[At(vertices_[k])] = uv[k];
}

void MapRegion::Add(int face, const Complex (&corner)[3], StretchFigures& figures) const {
  Eigen::Matrix3d corners;
  Eigen::Matrix<double, 3, 2> flat;
  for (int i = 0; i < 3; ++i) {
    corners.row(i) = chart_.positions.row(chart_.triangles(face, i));
    flat.row(i) << corner[i].real(), corner[i].imag();
  }
  figures.Add(StretchOfTriangle(corners, flat), area_floor_);
}

}  // namespace dcharts
