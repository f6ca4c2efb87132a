// SPDX-License-Identifier: GPL-3.0-or-later
/// A finished atlas rasterized as a graphics card does it: a texel belongs to the chart that covers its
/// middle.
#include "dcharts.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "shapes.h"

namespace dcharts {
namespace {

constexpr int kFree = -1, kTwoCharts = -2;

// Chart id per texel, row by row.
std::vector<int> Rasterize(const SurfaceChange& atlas, int size) {
  std::vector<int> owner(static_cast<size_t>(size) * static_cast<size_t>(size), kFree);
  for (size_t f = 0; f < atlas.wedge_texcoords.size(); ++f) {
    double x[3], y[3];
    for (size_t i = 0; i < 3; ++i) {
      x[i] = size * static_cast<double>(atlas.wedge_texcoords[f][2 * i]);
      y[i] = size * static_cast<double>(atlas.wedge_texcoords[f][2 * i + 1]);
    }
    const auto texel = [size](double t) { return std::clamp(static_cast<int>(t), 0, size - 1); };
    for (int row = texel(*std::min_element(y, y + 3)); row <= texel(*std::max_element(y, y + 3)); ++row)
      for (int column = texel(*std::min_element(x, x + 3)); column <= texel(*std::max_element(x, x + 3));
           ++column) {
        bool inside = true;
        for (int i = 0; i < 3; ++i) {
          const int j = (i + 1) % 3;
          inside = inside && (x[j] - x[i]) * (row + 0.5 - y[i]) >= (y[j] - y[i]) * (column + 0.5 - x[i]);
        }
        int& mine = owner[static_cast<size_t>(row) * static_cast<size_t>(size) + static_cast<size_t>(column)];
        if (inside) mine = mine == kFree || mine == atlas.chart_ids[f] ? atlas.chart_ids[f] : kTwoCharts;
      }
  }
  return owner;
}

// The least number of free texels between two charts, in a row, a column or askew, or `most`.
int LeastGap(const std::vector<int>& owner, int size, int most) {
  const auto at = [&](int row, int column) {
    return owner[static_cast<size_t>(row) * static_cast<size_t>(size) + static_cast<size_t>(column)];
  };
  int least = most;
  for (int row = 0; row < size; ++row)
    for (int column = 0; column + 1 < size; ++column) {
      const int mine = at(row, column);
      if (mine == kTwoCharts) return -1;
      const bool rim = mine != kFree && (at(row, column + 1) != mine || column == 0 || row == 0 ||
                                         row + 1 == size || at(row, column - 1) != mine ||
                                         at(row - 1, column) != mine || at(row + 1, column) != mine);
      if (!rim) continue;
      for (int r = std::max(0, row - least); r <= std::min(size - 1, row + least); ++r)
        for (int c = std::max(0, column - least); c <= std::min(size - 1, column + least); ++c)
          if (at(r, c) != kFree && at(r, c) != mine)
            least = std::min(least, std::max(std::abs(r - row), std::abs(c - column)) - 1);
    }
  return least;
}

TEST(Padding, ChartsAreApartInTheRasterizedTexture) {
  SurfaceData mesh = shapes::Plush(32);
  Params params;
  params.chart_count = params.target_charts = 12;
  Progress progress;
  const SurfaceChange first = TextureAtlas(mesh, params, progress);
  ASSERT_GT(*first.report.charts, 4);
  mesh.face_quality.assign(first.chart_ids.begin(), first.chart_ids.end());
  mesh.wedge_texcoords = first.wedge_texcoords;
  for (int size : {256, 1000, 4096})
    for (int padding : {0, 2, 8}) {
      SCOPED_TRACE("texture_size " + std::to_string(size) + ", padding " + std::to_string(padding));
      params.texture_size = size;
      params.padding = padding;
      const SurfaceChange atlas = Parameterize(mesh, params, progress);
      const std::vector<int> owner = Rasterize(atlas, size);
      EXPECT_GE(LeastGap(owner, size, padding + 2), padding);
      // Along the texture's edge there is half the padding.
      for (int row = 0; row < size; ++row)
        for (int column = 0; column < size; ++column) {
          const int edge = std::min({row, column, size - 1 - row, size - 1 - column});
          if (edge < padding / 2) {
            ASSERT_EQ(
                owner[static_cast<size_t>(row) * static_cast<size_t>(size) + static_cast<size_t>(column)],
                kFree)
                << row << ", " << column;
          }
        }
      EXPECT_GT(std::count_if(owner.begin(), owner.end(), [](int id) { return id != kFree; }),
                0.3 * size * size);
    }
}

}  // namespace
}  // namespace dcharts
