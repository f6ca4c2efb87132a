// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace dcharts {

using Points3 = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
using Points2 = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;
using Triangles = Eigen::Matrix<int, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// One chart, cut open along its seams: the vertices on a dart stand there once per side.
/// Connected, manifold, consistently oriented, genus 0 with at least one boundary loop.
struct ChartMesh {
  Points3 positions;    ///< #V by 3, model units
  Triangles triangles;  ///< #F by 3, indices into positions; zero-area triangles may occur
};

}  // namespace dcharts
