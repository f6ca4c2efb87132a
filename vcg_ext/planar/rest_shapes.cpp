// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/rest_shapes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace dcharts {
namespace {

constexpr double kThin = 1e-4;            // height / longest edge below which a small triangle is a sliver
constexpr double kHopelesslyThin = 1e-9;  // below which any triangle is one: its height is rounding noise
constexpr double kTiny = 1e-4;            // longest edge / sqrt(mean area) below which a triangle is a sliver
constexpr double kSmall = 1e-2;           // area / mean area up to which a thin triangle counts as a sliver:
                                          // a rod of long thin triangles has real shapes to keep
constexpr double kSliverWeight = 1e-3;    // of the mean weight
// Texture coordinates of a chart that fills the unit square are rounded by up to 3e-8 in float32, and its
// share of an atlas is smaller. Both relative to the chart's extent; rest shapes aim higher than what must be
// reached.
constexpr double kWantedHeight = 8e-6;
constexpr double kNeededHeight = 2e-6;

struct Triangle {
  Complex corner[3];
  int base = 0;  // the longest edge runs from this corner to the next
  double longest = 0, height = 0;
};

Triangle TriangleIn(const PlanePoints& uv, const Triangles& triangles, Eigen::Index t) {
  Triangle triangle;
  for (int k = 0; k < 3; ++k) triangle.corner[k] = uv[static_cast<std::size_t>(triangles(t, k))];
  for (int k = 0; k < 3; ++k) {
    const double length = std::abs(triangle.corner[(k + 1) % 3] - triangle.corner[k]);
    if (length > triangle.longest) triangle.longest = length, triangle.base = k;
  }
  const Complex* c = triangle.corner;
  triangle.height = Cross(c[1] - c[0], c[2] - c[0]) / triangle.longest;
  return triangle;
}

// Its shape, at least as high as `height` over its longest edge.
RestShape ThickShape(Triangle triangle, double height) {
  Complex* c = triangle.corner;
  const int base = triangle.base, next = (base + 1) % 3, apex = (base + 2) % 3;
  const Complex along = (c[next] - c[base]) / triangle.longest;
  if (triangle.longest < height) c[next] = c[base] + along * height;
  if (triangle.height < height) c[apex] += Complex(0, 1) * along * (height - triangle.height);
  return ShapeFromCorners(c[0], c[1], c[2]);
}

double Extent(const PlanePoints& uv) {
  double low[2] = {uv[0].real(), uv[0].imag()}, high[2] = {low[0], low[1]};
  for (const Complex& z : uv) {
    low[0] = std::min(low[0], z.real());
    low[1] = std::min(low[1], z.imag());
    high[0] = std::max(high[0], z.real());
    high[1] = std::max(high[1], z.imag());
  }
  return std::max(high[0] - low[0], high[1] - low[1]);
}

}  // namespace

RestShape ShapeFromCorners(const Complex& r0, const Complex& r1, const Complex& r2) {
  RestShape shape;
  const Complex e1 = r1 - r0, e2 = r2 - r0;
  shape.twice_area = Cross(e1, e2);
  // The gradients of the hat functions are the opposite edges turned by 90 degrees over twice the area.
  const double scale = 0.5 / shape.twice_area;
  shape.a1 = {e2.imag() * scale, e2.real() * scale};
  shape.a2 = {-e1.imag() * scale, -e1.real() * scale};
  return shape;
}

RestFloors RestFloorsOf(const ChartMesh& chart) {
  const Eigen::RowVector3d size = chart.positions.colwise().maxCoeff() - chart.positions.colwise().minCoeff();
  RestFloors floors;
  floors.mean_area = 1.0 / static_cast<double>(chart.triangles.rows());
  floors.height = kWantedHeight * size.maxCoeff();
  floors.edge = std::max(kTiny * std::sqrt(floors.mean_area), floors.height);
  return floors;
}

RestShape RestShapeOf(const Eigen::Vector3d corner[3], const RestFloors& floors) {
  int base = 0;  // the longest edge runs from corner `base` to the next
  double longest = -1;
  for (int k = 0; k < 3; ++k) {
    const double length = (corner[(k + 1) % 3] - corner[k]).norm();
    if (length > longest) longest = length, base = k;
  }
  const Eigen::Vector3d along = corner[(base + 1) % 3] - corner[base];
  const Eigen::Vector3d side = corner[(base + 2) % 3] - corner[base];
  const double twice_area = along.cross(side).norm();
  double foot = 0.5 * floors.edge, height = floors.edge;
  bool sliver = true;
  if (longest > 0) {
    foot = along.dot(side) / longest;
    height = twice_area / longest;
    const bool tiny = longest < floors.edge;
    const bool thin = height < kThin * longest && 0.5 * twice_area < kSmall * floors.mean_area;
    sliver = tiny || thin || height < kHopelesslyThin * longest || height < floors.height;
    if (tiny) {
      const double grow = floors.edge / longest;
      foot *= grow;
      height *= grow;
      longest = floors.edge;
    }
    if (sliver) height = std::max({height, kThin * longest, floors.height});
  } else {
    longest = floors.edge;
  }
  Complex r[3];
  r[base] = 0;
  r[(base + 1) % 3] = longest;
  r[(base + 2) % 3] = {foot, height};
  RestShape shape = ShapeFromCorners(r[0], r[1], r[2]);
  shape.sliver = sliver;
  shape.weight = sliver ? kSliverWeight * floors.mean_area : 0.5 * twice_area;
  return shape;
}

RestShapes RestShapesOf(const ChartMesh& chart) {
  const RestFloors floors = RestFloorsOf(chart);
  RestShapes shapes(static_cast<std::size_t>(chart.triangles.rows()));
  for (Eigen::Index t = 0; t < chart.triangles.rows(); ++t) {
    Eigen::Vector3d corner[3];
    for (int k = 0; k < 3; ++k) corner[k] = chart.positions.row(chart.triangles(t, k)).transpose();
    shapes[static_cast<std::size_t>(t)] = RestShapeOf(corner, floors);
  }
  return shapes;
}

void RelaxSlivers(const Triangles& triangles, const PlanePoints& uv, RestShapes& shapes) {
  const double wanted_height = kWantedHeight * Extent(uv);
  for (std::size_t t = 0; t < shapes.size(); ++t) {
    if (!shapes[t].sliver) continue;
    RestShape relaxed = ThickShape(TriangleIn(uv, triangles, static_cast<Eigen::Index>(t)), wanted_height);
    relaxed.weight = shapes[t].weight;
    relaxed.sliver = true;
    shapes[t] = relaxed;
  }
}

int ThickenThinTriangles(const Triangles& triangles, const PlanePoints& uv, double weight,
                         RestShapes& shapes) {
  const double extent = Extent(uv);
  int count = 0;
  for (std::size_t t = 0; t < shapes.size(); ++t) {
    const Triangle triangle = TriangleIn(uv, triangles, static_cast<Eigen::Index>(t));
    if (triangle.height >= kNeededHeight * extent) continue;
    shapes[t] = ThickShape(triangle, kWantedHeight * extent);
    shapes[t].weight = weight / static_cast<double>(shapes.size());
    shapes[t].sliver = true;
    ++count;
  }
  return count;
}

}  // namespace dcharts
