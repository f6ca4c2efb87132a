// SPDX-License-Identifier: GPL-3.0-or-later
/// The parts that flattening is made of, against closed forms, finite differences and dense algebra.
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <tuple>
#include <utility>
#include <vector>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "flatten_charts.h"
#include "planar/boundary_loops.h"
#include "planar/distortion.h"
#include "planar/line_search.h"
#include "planar/map_region.h"
#include "planar/plane_points.h"
#include "planar/rest_shapes.h"
#include "planar/stretch_descent.h"
#include "planar/stretch_energy.h"
#include "planar/vertex_block_system.h"
#include "thread_count.h"

namespace dcharts {
namespace {

Points2 MappedPlane(const ChartMesh& chart, const Eigen::Matrix2d& map) {
  return (chart.positions.leftCols<2>() * map.transpose()).eval();
}

TEST(Distortion, AffineMapsOfAPlane) {
  const ChartMesh chart = GridChart(5, 4, PlanePoint);
  Eigen::Matrix2d map;
  map << 2, 0, 0, 1;
  StretchFigures figures = MeasureStretch(chart, MappedPlane(chart, map));
  EXPECT_NEAR(figures.L2(), std::sqrt(1.25), 1e-12);
  EXPECT_NEAR(figures.Linf(), std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(figures.Shear(), 0.2, 1e-12);
  EXPECT_NEAR(figures.SurfaceArea(), 2, 1e-12);
  EXPECT_NEAR(figures.UvArea(), 4, 1e-12);
  map << 1, 1, 0, 1;
  figures = MeasureStretch(chart, MappedPlane(chart, map));
  EXPECT_NEAR(figures.L2(), std::sqrt(1.5), 1e-12);
  const double largest = (3 + std::sqrt(5.0)) / 2;  // squared
  EXPECT_NEAR(figures.Linf(), std::sqrt(largest), 1e-12);
  EXPECT_NEAR(figures.Shear(), 1 - 2 * largest / (largest * largest + 1), 1e-12);
  map << 0, -3, 3, 0;  // turned and enlarged: nothing
  figures = MeasureStretch(chart, MappedPlane(chart, map));
  EXPECT_NEAR(figures.L2(), 1, 1e-12);
  EXPECT_NEAR(figures.Linf(), 1, 1e-12);
  EXPECT_NEAR(figures.Shear(), 0, 1e-12);
}

TEST(Distortion, FlippedAndDegenerateTrianglesAreInfinite) {
  const ChartMesh chart = GridChart(3, 3, PlanePoint);
  Eigen::Matrix2d mirror;
  mirror << -1, 0, 0, 1;
  const StretchFigures mirrored = MeasureStretch(chart, MappedPlane(chart, mirror));
  EXPECT_EQ(mirrored.FlippedOrDegenerate(), 18);
  EXPECT_EQ(mirrored.L2(), std::numeric_limits<double>::infinity());
  EXPECT_EQ(mirrored.Linf(), std::numeric_limits<double>::infinity());
  const StretchFigures line = MeasureStretch(chart, MappedPlane(chart, Eigen::Matrix2d::Zero()));
  EXPECT_EQ(line.FlippedOrDegenerate(), 18);
}

TEST(Distortion, TrianglesWithoutSurfaceAreaCountNowhere) {
  ChartMesh chart = GridChart(2, 1, PlanePoint);
  chart.positions.row(chart.triangles(0, 0)) = chart.positions.row(chart.triangles(0, 1)).eval();
  const Points2 uv = MappedPlane(GridChart(2, 1, PlanePoint), Eigen::Matrix2d::Identity());
  EXPECT_EQ(MeasureStretch(chart, uv).FlippedOrDegenerate(), 0);
  EXPECT_TRUE(std::isfinite(MeasureStretch(chart, uv).L2()));
}

TEST(BoundaryLoops, RectangleWithTwoHoles) {
  const ChartMesh chart =
      GridChart(12, 5, PlanePoint, [](int i, int j) { return !((i == 3 || i == 8 || i == 9) && j == 2); });
  const std::vector<std::vector<int>> loops = BoundaryLoops(chart.triangles);
  ASSERT_EQ(loops.size(), 3u);
  EXPECT_EQ(loops[0].size(), 34u);
  EXPECT_EQ(loops[1].size(), 4u);
  EXPECT_EQ(loops[2].size(), 6u);
  EXPECT_TRUE(WhyNotAChart(chart).empty());
}

TEST(BoundaryLoops, HolesThatTouchInAVertexAreNoChart) {
  const ChartMesh chart =
      GridChart(6, 6, PlanePoint, [](int i, int j) { return !((i == 2 && j == 2) || (i == 3 && j == 3)); });
  EXPECT_FALSE(WhyNotAChart(chart).empty());
}

// A plane chart's own points, and a random direction for each.
std::pair<PlanePoints, PlanePoints> FlatAndRandom(const ChartMesh& chart, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::pair<PlanePoints, PlanePoints> points;
  for (Eigen::Index v = 0; v < chart.positions.rows(); ++v) {
    points.first.emplace_back(chart.positions(v, 0), chart.positions(v, 1));
    points.second.emplace_back(uniform(random), uniform(random));
  }
  return points;
}

TEST(LineSearch, FirstFlipIsWhereAnAreaVanishes) {
  const ChartMesh chart = GridChart(4, 4, PlanePoint);
  std::mt19937 random(3);
  for (int trial = 0; trial < 50; ++trial) {
    const auto points = FlatAndRandom(chart, random);
    const PlanePoints &uv = points.first, &direction = points.second;
    const double first = FirstFlip(chart.triangles, uv, direction);
    ASSERT_TRUE(std::isfinite(first));
    const auto smallest_area = [&](double t) {
      double smallest = std::numeric_limits<double>::infinity();
      for (Eigen::Index i = 0; i < chart.triangles.rows(); ++i) {
        Complex z[3];
        for (int k = 0; k < 3; ++k) {
          const std::size_t v = static_cast<std::size_t>(chart.triangles(i, k));
          z[k] = uv[v] + t * direction[v];
        }
        smallest = std::min(smallest, Cross(z[1] - z[0], z[2] - z[0]));
      }
      return smallest;
    };
    EXPECT_NEAR(smallest_area(first), 0, 1e-12);
    for (int i = 1; i < 100; ++i) EXPECT_GT(smallest_area(first * i / 100), 0);
  }
}

TEST(LineSearch, AFlipBeyondABoundIsNotLookedFor) {
  const ChartMesh chart = GridChart(6, 6, PlanePoint);
  std::mt19937 random(4);
  for (int trial = 0; trial < 50; ++trial) {
    const auto [uv, direction] = FlatAndRandom(chart, random);
    const double first = FirstFlip(chart.triangles, uv, direction);
    EXPECT_EQ(FirstFlip(chart.triangles, uv, direction, 1.001 * first), first);
    EXPECT_EQ(FirstFlip(chart.triangles, uv, direction, 0.999 * first),
              std::numeric_limits<double>::infinity());
  }
}

TEST(LineSearch, AStepWithoutFlipsIsNotBounded) {
  const ChartMesh chart = GridChart(2, 2, PlanePoint);
  PlanePoints uv, growing;
  for (Eigen::Index v = 0; v < chart.positions.rows(); ++v) {
    uv.emplace_back(chart.positions(v, 0), chart.positions(v, 1));
    growing.push_back(uv.back());
  }
  EXPECT_EQ(FirstFlip(chart.triangles, uv, growing), std::numeric_limits<double>::infinity());
}

class EnergyDerivatives : public testing::TestWithParam<std::pair<StretchEnergy::Kind, int>> {};

// Energy of a triangle as a function of alpha and beta.
double EnergyOf(const StretchEnergy& energy, const RestShape& shape, const Complex& alpha,
                const Complex& beta) {
  // edges of the rest triangle (0, 1, i) that `shape` was made from
  const Complex one(1, 0), i(0, 1);
  return shape.weight *
         TriangleEnergy(energy, shape, alpha * one + beta * one, alpha * i + beta * std::conj(i));
}

TEST_P(EnergyDerivatives, AgreeWithFiniteDifferences) {
  StretchEnergy energy;
  std::tie(energy.kind, energy.exponent) = GetParam();
  energy.reference = 0.3;
  RestShape shape = ShapeFromCorners(0, 1, Complex(0, 1));
  shape.weight = 0.7;
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-1, 1);
  int convex = 0;
  for (int trial = 0; trial < 40; ++trial) {
    const Complex alpha = std::polar(1 + 0.3 * uniform(random), 3 * uniform(random));
    const Complex beta = std::polar(0.2 + 0.15 * uniform(random), 3 * uniform(random));
    const Complex i(0, 1);
    const TriangleDerivatives d =
        ProjectedDerivatives(energy, shape, alpha + beta, alpha * i + beta * std::conj(i));
    const auto at = [&](const Eigen::Vector4d& x) {
      return EnergyOf(energy, shape, alpha + Complex(x[0], x[1]), beta + Complex(x[2], x[3]));
    };
    const double h = 1e-4;
    Eigen::Vector4d gradient;
    Eigen::Matrix4d hessian;
    for (int a = 0; a < 4; ++a) {
      const Eigen::Vector4d step_a = h * Eigen::Vector4d::Unit(a);
      gradient[a] = (at(step_a) - at(-step_a)) / (2 * h);
      for (int b = 0; b < 4; ++b) {
        const Eigen::Vector4d step_b = h * Eigen::Vector4d::Unit(b);
        hessian(a, b) =
            (at(step_a + step_b) - at(step_a - step_b) - at(step_b - step_a) + at(-step_a - step_b)) /
            (4 * h * h);
      }
    }
    const double size = hessian.norm() + gradient.norm();
    EXPECT_NEAR(d.gradient_alpha.real(), gradient[0], 1e-5 * size);
    EXPECT_NEAR(d.gradient_alpha.imag(), gradient[1], 1e-5 * size);
    EXPECT_NEAR(d.gradient_beta.real(), gradient[2], 1e-5 * size);
    EXPECT_NEAR(d.gradient_beta.imag(), gradient[3], 1e-5 * size);

    Eigen::Matrix4d given;
    for (int b = 0; b < 4; ++b) {
      const Complex x(b == 0, b == 1), y(b == 2, b == 3);
      const Complex by_alpha =
          d.m_alpha * x + d.d_alpha * std::conj(x) + d.cross_linear * y + d.cross_antilinear * std::conj(y);
      const Complex by_beta = d.m_beta * y + d.d_beta * std::conj(y) + std::conj(d.cross_linear) * x +
                              d.cross_antilinear * std::conj(x);
      given.col(b) << by_alpha.real(), by_alpha.imag(), by_beta.real(), by_beta.imag();
    }
    EXPECT_NEAR((given - given.transpose()).norm(), 0, 1e-12 * size);
    // The projection of the true Hessian on the positive semidefinite matrices.
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> eigen(0.5 * (hessian + hessian.transpose()));
    const Eigen::Matrix4d projected = eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0).asDiagonal() *
                                      eigen.eigenvectors().transpose();
    EXPECT_NEAR((given - projected).norm(), 0, 1e-4 * size);
    if (eigen.eigenvalues().minCoeff() > 0) ++convex;
  }
  EXPECT_LT(convex, 40);  // some had something to clamp
}

INSTANTIATE_TEST_SUITE_P(Kinds, EnergyDerivatives,
                         testing::Values(std::make_pair(StretchEnergy::Kind::kSymmetricDirichlet, 6),
                                         std::make_pair(StretchEnergy::Kind::kSander, 6),
                                         std::make_pair(StretchEnergy::Kind::kSanderTail, 6),
                                         std::make_pair(StretchEnergy::Kind::kSanderTail, 12)));

TEST(StretchEnergy, ReweightedGradientIsTheTrueOne) {
  RestShape shape = ShapeFromCorners(0, 1, Complex(0, 1));
  shape.weight = 2;
  const Complex e1(1.4, 0.2), e2(-0.3, 0.5);
  const TriangleDerivatives newton = ProjectedDerivatives({}, shape, e1, e2);
  const TriangleDerivatives reweighted = ReweightedDerivatives(shape, e1, e2);
  EXPECT_NEAR(std::abs(newton.gradient_alpha - reweighted.gradient_alpha), 0, 1e-14);
  EXPECT_NEAR(std::abs(newton.gradient_beta - reweighted.gradient_beta), 0, 1e-14);
}

PlanePoints RandomPoints(int count, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  PlanePoints points;
  for (int v = 0; v < count; ++v) points.emplace_back(uniform(random), uniform(random));
  return points;
}

Eigen::VectorXd AsVector(const PlanePoints& points) {
  Eigen::VectorXd vector(2 * points.size());
  for (std::size_t v = 0; v < points.size(); ++v)
    vector.segment<2>(static_cast<Eigen::Index>(2 * v)) << points[v].real(), points[v].imag();
  return vector;
}

TEST(VertexBlockSystem, SolvesLikeADenseMatrix) {
  const ChartMesh chart = GridChart(4, 3, PlanePoint);
  const int vertices = static_cast<int>(chart.positions.rows());
  VertexBlockSystem system(vertices, chart.triangles);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(2 * vertices, 2 * vertices);
  for (Eigen::Index t = 0; t < chart.triangles.rows(); ++t) {
    // b b^T of a random 6 x 2 matrix
    const Eigen::MatrixXd b = Eigen::MatrixXd::NullaryExpr(6, 2, [&] { return uniform(random); });
    const Eigen::MatrixXd local = b * b.transpose();
    for (int k = 0; k < 3; ++k) {
      for (int l = 0; l < 3; ++l) {
        dense.block<2, 2>(2 * chart.triangles(t, k), 2 * chart.triangles(t, l)) +=
            local.block<2, 2>(2 * k, 2 * l);
        if (l < k) continue;
        const Eigen::Matrix2d block = local.block<2, 2>(2 * k, 2 * l);
        system.Add(t, k, l, {block(0, 0), block(0, 1), block(1, 0), block(1, 1)});
      }
    }
  }
  const double shift = 0.1 * dense.diagonal().mean();
  dense.diagonal().array() += shift;
  system.Regularize(0.1);
  PlanePoints right_hand_side = RandomPoints(vertices, random);
  Eigen::VectorXd dense_right = AsVector(right_hand_side);
  ASSERT_TRUE(system.Factorize());
  PlanePoints solution = system.Solve(right_hand_side);
  Eigen::VectorXd expected = dense.ldlt().solve(dense_right);
  for (int v = 0; v < vertices; ++v) {
    EXPECT_NEAR(solution[static_cast<std::size_t>(v)].real(), expected[2 * v], 1e-9);
    EXPECT_NEAR(solution[static_cast<std::size_t>(v)].imag(), expected[2 * v + 1], 1e-9);
  }

  const int pinned = 7;
  system.Pin(pinned, Complex(3, -2), right_hand_side);
  ASSERT_TRUE(system.Factorize());
  solution = system.Solve(right_hand_side);
  const Eigen::Vector2d value(3, -2);
  dense_right -= dense.middleCols<2>(2 * pinned) * value;
  dense.middleCols<2>(2 * pinned).setZero();
  dense.middleRows<2>(2 * pinned).setZero();
  dense.block<2, 2>(2 * pinned, 2 * pinned).setIdentity();
  dense_right.segment<2>(2 * pinned) = value;
  expected = dense.ldlt().solve(dense_right);
  for (int v = 0; v < vertices; ++v) {
    EXPECT_NEAR(solution[static_cast<std::size_t>(v)].real(), expected[2 * v], 1e-9);
    EXPECT_NEAR(solution[static_cast<std::size_t>(v)].imag(), expected[2 * v + 1], 1e-9);
  }
}

// As large as is factorized in two groups of columns.
TEST(VertexBlockSystem, ALargeMatrixIsSolvedTheSameOnAnyNumberOfThreads) {
  const ChartMesh chart = GridChart(120, 100, PlanePoint);
  const int vertices = static_cast<int>(chart.positions.rows());
  const PlanePoints known = [&] {
    std::mt19937 random(3);
    return RandomPoints(vertices, random);
  }();
  std::vector<PlanePoints> solutions;
  for (const int count : {1, 2}) {
    const test::Threads threads(count);
    VertexBlockSystem system(vertices, chart.triangles);
    PlanePoints right_hand_side(known.size(), Complex(0, 0));
    // Springs along the edges, and to where each vertex is.
    for (Eigen::Index t = 0; t < chart.triangles.rows(); ++t)
      for (const auto& [k, l] : {std::pair{0, 1}, std::pair{0, 2}, std::pair{1, 2}}) {
        const auto a = static_cast<std::size_t>(chart.triangles(t, k)),
                   b = static_cast<std::size_t>(chart.triangles(t, l));
        const double stiffness = 1 + static_cast<double>((a + b) % 3);
        system.Add(t, k, k, Block2{stiffness, 0, 0, stiffness});
        system.Add(t, l, l, Block2{stiffness, 0, 0, stiffness});
        system.Add(t, k, l, Block2{-stiffness, 0, 0, -stiffness});
        right_hand_side[a] += stiffness * (known[a] - known[b]);
        right_hand_side[b] += stiffness * (known[b] - known[a]);
      }
    for (std::size_t v = 0; v < known.size(); ++v) {
      system.AddDiagonal(static_cast<Eigen::Index>(v), 0.1);
      right_hand_side[v] += 0.1 * known[v];
    }
    ASSERT_TRUE(system.Factorize());
    solutions.push_back(system.Solve(right_hand_side));
    for (std::size_t v = 0; v < known.size(); ++v)
      ASSERT_NEAR(std::abs(solutions.back()[v] - known[v]), 0, 1e-9);
    system.AddDiagonal(vertices / 3, -1000.0);
    EXPECT_FALSE(system.Factorize());
  }
  EXPECT_TRUE(solutions[0] == solutions[1]);
}

Block2 ToBlock(const Eigen::Matrix2d& m) { return {m(0, 0), m(0, 1), m(1, 0), m(1, 1)}; }

TEST(VertexBlockSystem, BlocksOfEdgesAndUnknownsAmongTheFirstVertices) {
  const ChartMesh chart = GridChart(5, 4, PlanePoint);
  const int vertices = static_cast<int>(chart.positions.rows());
  for (const int free_count : {vertices, 17, 1}) {
    std::mt19937 random(static_cast<unsigned>(free_count));
    std::uniform_real_distribution<double> uniform(-1, 1);
    VertexBlockSystem system(vertices, free_count, chart.triangles);
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(2 * vertices, 2 * vertices);
    for (Eigen::Index t = 0; t < chart.triangles.rows(); ++t) {
      const Eigen::MatrixXd root = Eigen::MatrixXd::NullaryExpr(4, 4, [&] { return uniform(random); });
      const Eigen::Matrix4d of_edges = root * root.transpose();
      system.AddTriangle(t, ToBlock(of_edges.topLeftCorner<2, 2>()), ToBlock(of_edges.topRightCorner<2, 2>()),
                         ToBlock(of_edges.bottomRightCorner<2, 2>()));
      Eigen::MatrixXd edges = Eigen::MatrixXd::Zero(4, 2 * vertices);  // from vertices
      for (int e : {0, 1}) {
        edges.block<2, 2>(2 * e, 2 * chart.triangles(t, e + 1)).setIdentity();
        edges.block<2, 2>(2 * e, 2 * chart.triangles(t, 0)) = -Eigen::Matrix2d::Identity();
      }
      dense += edges.transpose() * of_edges * edges;
    }
    Eigen::MatrixXd free = dense.topLeftCorner(2 * free_count, 2 * free_count);
    free.diagonal().array() += 0.01 * free.diagonal().mean();
    system.Regularize(0.01);
    PlanePoints right_hand_side = RandomPoints(vertices, random);
    Eigen::VectorXd dense_right = AsVector(right_hand_side);
    ASSERT_TRUE(system.Factorize());
    const PlanePoints solution = system.Solve(right_hand_side);
    const Eigen::VectorXd expected = free.ldlt().solve(dense_right.head(2 * free_count));
    ASSERT_EQ(solution.size(), static_cast<std::size_t>(vertices));
    for (int v = 0; v < vertices; ++v) {
      const Complex is = solution[static_cast<std::size_t>(v)];
      const Complex wanted = v < free_count ? Complex(expected[2 * v], expected[2 * v + 1]) : Complex(0, 0);
      EXPECT_NEAR(std::abs(is - wanted), 0, 1e-9) << v << " of " << free_count;
    }
  }
}

TEST(MapRegion, OnlyWhatMovesChangesAndTheWholeIsMeasured) {
  const ChartMesh chart = GridChart(12, 9, [](double x, double y) -> Eigen::RowVector3d {
    return {x, y, 0.3 * std::exp(-20 * ((x - 0.5) * (x - 0.5) + (y - 0.5) * (y - 0.5)))};
  });
  PlanePoints uv;
  std::vector<char> moves;
  for (Eigen::Index v = 0; v < chart.positions.rows(); ++v) {
    uv.emplace_back(chart.positions(v, 0), chart.positions(v, 1));
    moves.push_back(std::abs(uv.back() - Complex(0.5, 0.5)) < 0.25);
  }
  const RestShapes shapes = RestShapesOf(chart);
  VertexBlockSystem system(static_cast<int>(uv.size()), chart.triangles);
  MapRegion region(chart, shapes, uv, moves, system);
  EXPECT_FALSE(region.IsWhole());
  EXPECT_NE(&region.System(), &system);
  EXPECT_NEAR(region.Measure(region.Uv()).L2(), MeasureStretch(chart, ToPoints(uv, 1)).L2(), 1e-12);
  EXPECT_NEAR(region.Measure(region.Uv()).Linf(), MeasureStretch(chart, ToPoints(uv, 1)).Linf(), 1e-12);
  PlanePoints lower = region.Uv(), after = uv;
  Descend({StretchEnergy::Kind::kSander}, {}, region.LocalTriangles(), region.Shapes(), region.System(), {},
          lower);
  region.Write(lower, after);
  int moved = 0;
  for (std::size_t v = 0; v < uv.size(); ++v) {
    moved += after[v] != uv[v];
    if (!moves[v]) {
      EXPECT_EQ(after[v], uv[v]);
    }
  }
  EXPECT_EQ(moved, std::count(moves.begin(), moves.end(), 1));
  EXPECT_NEAR(region.Measure(lower).L2(), MeasureStretch(chart, ToPoints(after, 1)).L2(), 1e-12);
  EXPECT_LT(region.Measure(lower).L2(), region.Measure(region.Uv()).L2());

  MapRegion whole(chart, shapes, uv, std::vector<char>(uv.size(), 1), system);
  EXPECT_TRUE(whole.IsWhole());
  EXPECT_EQ(&whole.System(), &system);
}

TEST(VertexBlockSystem, SaysWhenAMatrixIsNotPositiveDefinite) {
  const ChartMesh chart = GridChart(1, 1, PlanePoint);
  VertexBlockSystem system(4, chart.triangles);
  EXPECT_FALSE(system.Factorize());
  for (int v = 0; v < 4; ++v) system.AddDiagonal(v, v == 2 ? -1 : 1);
  EXPECT_FALSE(system.Factorize());
}

}  // namespace
}  // namespace dcharts
