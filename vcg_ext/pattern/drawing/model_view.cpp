// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/drawing/model_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "common/pi.h"
#include "pattern/drawing/flat_layer.h"

namespace dcharts {

namespace {

constexpr int kFiner = 2;  // pixels are means of this many squared
constexpr int kNothing = -1;

// The piece seen at each fine pixel, and how much light falls there (0..1).
struct Raster {
  int side = 0;
  std::vector<float> depth;
  std::vector<int> piece;
  std::vector<float> light;
};

void DrawTriangle(const std::array<Eigen::Vector3d, 3>& p, int piece, float light, Raster& raster) {
  const double area =
      (p[1].x() - p[0].x()) * (p[2].y() - p[0].y()) - (p[2].x() - p[0].x()) * (p[1].y() - p[0].y());
  if (area == 0) return;
  const auto low = [&](int d) { return std::min({p[0][d], p[1][d], p[2][d]}); };
  const auto high = [&](int d) { return std::max({p[0][d], p[1][d], p[2][d]}); };
  const int x0 = std::max(0, static_cast<int>(std::ceil(low(0) - 0.5)));
  const int x1 = std::min(raster.side - 1, static_cast<int>(std::floor(high(0) - 0.5)));
  const int y0 = std::max(0, static_cast<int>(std::ceil(low(1) - 0.5)));
  const int y1 = std::min(raster.side - 1, static_cast<int>(std::floor(high(1) - 0.5)));
  for (int y = y0; y <= y1; ++y)
    for (int x = x0; x <= x1; ++x) {
      std::array<double, 3> weight;
      for (int k = 0; k < 3; ++k) {
        const auto &a = p[(k + 1) % 3], &b = p[(k + 2) % 3];
        weight[k] = ((b.x() - a.x()) * (y + 0.5 - a.y()) - (b.y() - a.y()) * (x + 0.5 - a.x())) / area;
      }
      if (*std::min_element(weight.begin(), weight.end()) < 0) continue;
      const auto depth =
          static_cast<float>(weight[0] * p[0].z() + weight[1] * p[1].z() + weight[2] * p[2].z());
      const std::size_t i = static_cast<std::size_t>(y) * raster.side + x;
      if (depth <= raster.depth[i]) continue;
      raster.depth[i] = depth;
      raster.piece[i] = piece;
      raster.light[i] = light;
    }
}

Raster DrawFaces(const SurfaceData& mesh, const std::vector<int>& piece_of_face, int up, double azimuth,
                 double elevation, int side) {
  const double a = azimuth * kPi / 180, e = elevation * kPi / 180;
  Eigen::Matrix3d view;  // rows: right, down, towards the eye
  view.row(2) << std::sin(a) * std::cos(e), std::sin(e), std::cos(a) * std::cos(e);
  view.row(0) << std::cos(a), 0, -std::sin(a);
  view.row(1) = view.row(0).cross(view.row(2));
  std::vector<Eigen::Vector3d> turned;
  turned.reserve(mesh.vertices.size());
  Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const auto& v : mesh.vertices)
    turned.push_back(view *
                     (up == 1 ? Eigen::Vector3d(v[0], v[1], v[2]) : Eigen::Vector3d(v[0], v[2], -v[1])));
  for (const auto& face : mesh.faces)
    for (int v : face) {
      low = low.cwiseMin(turned[v]);
      high = high.cwiseMax(turned[v]);
    }
  const double margin = 0.03 * side;
  const double scale = (side - 2 * margin) / std::max({high.x() - low.x(), high.y() - low.y(), 1e-300});
  const Eigen::Vector3d middle = (low + high) / 2, to(side / 2.0, side / 2.0, 0);

  Raster raster{side, {}, {}, {}};
  const std::size_t count = static_cast<std::size_t>(side) * side;
  raster.depth.assign(count, -std::numeric_limits<float>::infinity());
  raster.piece.assign(count, kNothing);
  raster.light.assign(count, 1);
  const Eigen::Vector3d lamp = Eigen::Vector3d(-0.4, -0.6, 0.8).normalized();
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    if (piece_of_face[f] < 0) continue;
    std::array<Eigen::Vector3d, 3> p;
    for (int k = 0; k < 3; ++k) p[k] = (turned[mesh.faces[f][k]] - middle) * scale + to;
    Eigen::Vector3d normal = (p[1] - p[0]).cross(p[2] - p[0]);
    if (normal.squaredNorm() == 0) continue;
    normal.normalize();
    if (normal.z() < 0) normal = -normal;  // of an open model also the inside is seen
    DrawTriangle(p, piece_of_face[f], static_cast<float>(0.55 + 0.45 * std::max(0.0, normal.dot(lamp))),
                 raster);
  }
  return raster;
}

// Dark between pieces and around the model.
bool IsBorder(const Raster& raster, int x, int y) {
  const int piece = raster.piece[static_cast<std::size_t>(y) * raster.side + x];
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx) {
      const int u = x + dx, v = y + dy;
      if (u < 0 || v < 0 || u >= raster.side || v >= raster.side) continue;
      if (raster.piece[static_cast<std::size_t>(v) * raster.side + u] != piece) return true;
    }
  return false;
}

Picture ShrunkPicture(const Raster& raster, int pixels) {
  Picture picture;
  picture.width = picture.height = pixels;
  picture.rgb.resize(static_cast<std::size_t>(pixels) * pixels * 3);
  for (int y = 0; y < pixels; ++y)
    for (int x = 0; x < pixels; ++x) {
      std::array<double, 3> sum = {0, 0, 0};
      for (int v = kFiner * y; v < kFiner * (y + 1); ++v)
        for (int u = kFiner * x; u < kFiner * (x + 1); ++u) {
          const std::size_t i = static_cast<std::size_t>(v) * raster.side + u;
          const int piece = raster.piece[i];
          std::array<double, 3> color = {1, 1, 1};
          if (IsBorder(raster, u, v)) {
            color = {0.15, 0.15, 0.15};
          } else if (piece >= 0) {
            const auto rgb = PieceColor(piece);
            for (int c = 0; c < 3; ++c) color[c] = rgb[c] / 255.0 * raster.light[i];
          }
          for (int c = 0; c < 3; ++c) sum[c] += color[c];
        }
      for (int c = 0; c < 3; ++c)
        picture.rgb[(static_cast<std::size_t>(y) * pixels + x) * 3 + c] =
            static_cast<std::uint8_t>(std::lround(255 * sum[c] / (kFiner * kFiner)));
    }
  return picture;
}

// The pixel of each piece that is farthest from all that is not of the piece, by steps along rows, columns
// and diagonals.
std::vector<ModelView::Spot> WidestSpots(const std::vector<int>& piece, int side, int piece_count) {
  std::vector<int> room(piece.size(), 0);
  const auto at = [side](int x, int y) { return static_cast<std::size_t>(y) * side + x; };
  const auto step = [&](int x, int y, int dx, int dy) {
    const std::size_t i = at(x, y);
    for (int k = 0; k < 4; ++k) {
      const int u = x + (k == 3 ? -dx : k == 2 ? 0 : dx), v = y + (k == 0 ? 0 : dy);
      const bool same = u >= 0 && v >= 0 && u < side && v < side && piece[at(u, v)] == piece[i];
      room[i] = std::min(room[i], same ? room[at(u, v)] + 1 : 1);
    }
  };
  std::fill(room.begin(), room.end(), side);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) step(x, y, -1, -1);
  for (int y = side - 1; y >= 0; --y)
    for (int x = side - 1; x >= 0; --x) step(x, y, 1, 1);
  std::vector<ModelView::Spot> spots(piece_count);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const int p = piece[at(x, y)];
      if (p < 0 || room[at(x, y)] <= spots[p].radius) continue;
      spots[p] = {{x + 0.5, y + 0.5}, static_cast<double>(room[at(x, y)])};
    }
  return spots;
}

}  // namespace

int GuessUp(const SurfaceData& mesh) {
  constexpr double kGround = 0.03;  // of the height: what stands on the ground
  Eigen::Array3d low = Eigen::Array3d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  std::vector<Eigen::Array3d> points;
  for (const auto& face : mesh.faces)
    for (int v : face) {
      points.emplace_back(mesh.vertices[v][0], mesh.vertices[v][1], mesh.vertices[v][2]);
      low = low.min(points.back());
      high = high.max(points.back());
    }
  const Eigen::Array3d size = (high - low).max(1e-300);
  std::array<double, 3> score = {0, 0, 0};
  for (int up : {1, 2}) {
    Eigen::Array3d ground_low = high, ground_high = low, sum = Eigen::Array3d::Zero();
    for (const Eigen::Array3d& p : points) {
      sum += p;
      if (p[up] > low[up] + kGround * size[up]) continue;
      ground_low = ground_low.min(p);
      ground_high = ground_high.max(p);
    }
    const int other = 3 - up;
    score[up] =
        (ground_high[0] - ground_low[0]) * (ground_high[other] - ground_low[other]) / (size[0] * size[other]);
    // What does not fall over has its middle above the ground that it stands on.
    const Eigen::Array3d middle = sum / static_cast<double>(std::max<std::size_t>(1, points.size()));
    for (int d : {0, other})
      if (middle[d] < ground_low[d] || middle[d] > ground_high[d]) score[up] *= 0.3;
  }
  return score[2] > score[1] ? 2 : 1;
}

ModelView ViewModel(const SurfaceData& mesh, const std::vector<int>& piece_of_face, int piece_count, int up,
                    double azimuth, double elevation, int pixels) {
  const Raster raster = DrawFaces(mesh, piece_of_face, up, azimuth, elevation, kFiner * pixels);
  ModelView view;
  view.picture = ShrunkPicture(raster, pixels);
  std::vector<int> coarse(static_cast<std::size_t>(pixels) * pixels);
  for (int y = 0; y < pixels; ++y)
    for (int x = 0; x < pixels; ++x)
      coarse[static_cast<std::size_t>(y) * pixels + x] =
          raster.piece[static_cast<std::size_t>(kFiner * y) * raster.side + kFiner * x];
  view.spots = WidestSpots(coarse, pixels, piece_count);
  for (int piece : coarse) view.empty.push_back(piece == kNothing);
  return view;
}

}  // namespace dcharts
