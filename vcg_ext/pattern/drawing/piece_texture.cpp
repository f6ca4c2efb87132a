// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/drawing/piece_texture.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dcharts {

namespace {

constexpr double kPixelsPerMm = 6;  // about 150 dpi
constexpr int kMostPixels = 3000;   // along the longer side

using Color = std::array<double, 3>;

// Texture coordinates beyond [0, 1] repeat; v points upwards.
Color Sample(const TextureImage& image, double u, double v) {
  const auto index = [](double t, int size) {
    return std::clamp(static_cast<int>((t - std::floor(t)) * size), 0, size - 1);
  };
  const std::size_t i =
      3 * (static_cast<std::size_t>(index(1 - v, image.height)) * image.width + index(u, image.width));
  return {double(image.rgb[i]), double(image.rgb[i + 1]), double(image.rgb[i + 2])};
}

// The colour of a face at a point given by its weights.
Color ColorAt(const SurfaceData& mesh, int face, const std::array<double, 3>& weight) {
  const int texture = mesh.wedge_texture_index.empty() ? -1 : mesh.wedge_texture_index[face];
  if (texture >= 0 && texture < static_cast<int>(mesh.textures.size()) &&
      !mesh.textures[texture].rgb.empty()) {
    double u = 0, v = 0;
    for (int k = 0; k < 3; ++k) {
      u += weight[k] * mesh.wedge_texcoords[face][2 * k];
      v += weight[k] * mesh.wedge_texcoords[face][2 * k + 1];
    }
    return Sample(mesh.textures[texture], u, v);
  }
  Color color = {255, 255, 255};
  if (mesh.corner_colors.empty()) return color;
  for (int c = 0; c < 3; ++c) {
    color[c] = 0;
    for (int k = 0; k < 3; ++k) color[c] += weight[k] * mesh.corner_colors[face][k][c];
  }
  return color;
}

}  // namespace

Picture PieceTexture(const SurfaceData& mesh, const PlacedPiece& placed) {
  Picture picture;
  if (mesh.textures.empty() && mesh.corner_colors.empty()) return picture;
  const auto [low, high] = BoxOf(placed.net);
  const Point2 size = high - low;
  const double per_mm = std::min(kPixelsPerMm, kMostPixels / std::max(size.maxCoeff(), 1e-9));
  picture.width = std::max(1, static_cast<int>(std::ceil(size.x() * per_mm)));
  picture.height = std::max(1, static_cast<int>(std::ceil(size.y() * per_mm)));
  picture.at = low;
  picture.size = Point2(picture.width, picture.height) / per_mm;
  picture.clip = placed.net;
  picture.rgb.assign(3 * static_cast<std::size_t>(picture.width) * picture.height, 255);

  const FlatMesh& flat = placed.piece->flat;
  for (std::size_t t = 0; t < flat.triangles.size(); ++t) {
    std::array<Point2, 3> p;
    for (int k = 0; k < 3; ++k) {
      const Point2 on_sheet = placed.placement(flat.vertices[flat.triangles[t][k]]) - low;
      p[k] = {on_sheet.x() * per_mm, picture.height - on_sheet.y() * per_mm};
    }
    const Point2 ab = p[1] - p[0], ac = p[2] - p[0];
    const double area = ab.x() * ac.y() - ab.y() * ac.x();
    if (area == 0) continue;
    const auto bound = [&](int d, int limit) {
      const auto [from, to] = std::minmax({p[0][d], p[1][d], p[2][d]});
      return std::make_pair(std::max(0, static_cast<int>(std::floor(from))),
                            std::min(limit - 1, static_cast<int>(std::ceil(to))));
    };
    const auto [x0, x1] = bound(0, picture.width);
    const auto [y0, y1] = bound(1, picture.height);
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x) {
        std::array<double, 3> weight;
        for (int k = 0; k < 3; ++k) {
          const Point2 &a = p[(k + 1) % 3], &b = p[(k + 2) % 3];
          weight[k] = ((b.x() - a.x()) * (y + 0.5 - a.y()) - (b.y() - a.y()) * (x + 0.5 - a.x())) / area;
        }
        // A little beyond the edges, so that no gaps are between triangles.
        if (*std::min_element(weight.begin(), weight.end()) < -1e-6) continue;
        const Color color = ColorAt(mesh, flat.face[t], weight);
        const std::size_t i = 3 * (static_cast<std::size_t>(y) * picture.width + x);
        for (int c = 0; c < 3; ++c)
          picture.rgb[i + c] = static_cast<std::uint8_t>(std::lround(std::clamp(color[c], 0.0, 255.0)));
      }
  }
  return picture;
}

}  // namespace dcharts
