// SPDX-License-Identifier: GPL-3.0-or-later
/// Pieces of paper, folded without stretching them, are the model again.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Dense>
#include <Eigen/Sparse>

#include "dcharts.h"
#include "pattern/pattern.h"
#include "shapes.h"

namespace dcharts {
namespace {

constexpr double kSize = 300;  // mm

double DistanceToEdge(const Point3& p, const Point3& a, const Point3& b) {
  const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (a + t * (b - a) - p).norm();
}

double DistanceToTriangle(const Point3& p, const Point3& a, const Point3& b, const Point3& c) {
  const Point3 normal = (b - a).cross(c - a);
  if ((b - a).cross(p - a).dot(normal) >= 0 && (c - b).cross(p - b).dot(normal) >= 0 &&
      (a - c).cross(p - c).dot(normal) >= 0)
    return std::abs((p - a).dot(normal)) / normal.norm();
  return std::min({DistanceToEdge(p, a, b), DistanceToEdge(p, b, c), DistanceToEdge(p, c, a)});
}

// A sheet of stiff triangles in space. Starts from the model's own surface, which is a little stretched
// against the flat piece, and gives way until it is not: then it is a folding of the piece.
class PaperSheet {
 public:
  PaperSheet(const FlatMesh& flat, const SurfaceData& mesh, double scale) : flat_(flat) {
    start_.resize(static_cast<Eigen::Index>(flat.vertices.size()), 3);
    for (size_t t = 0; t < flat.triangles.size(); ++t)
      for (size_t k = 0; k < 3; ++k) {
        const auto& v = mesh.vertices[static_cast<size_t>(mesh.faces[static_cast<size_t>(flat.face[t])][k])];
        start_.row(flat.triangles[t][k]) = scale * Eigen::RowVector3d(v[0], v[1], v[2]);
      }
    positions_ = start_;
    std::vector<Eigen::Triplet<double>> entries;
    for (size_t t = 0; t < flat.triangles.size(); ++t) {
      const auto& corners = flat.triangles[t];
      const Point2 &a = flat.vertices[static_cast<size_t>(corners[0])],
                   &b = flat.vertices[static_cast<size_t>(corners[1])],
                   &c = flat.vertices[static_cast<size_t>(corners[2])];
      Eigen::Matrix2d edges;
      edges << b - a, c - a;
      Eigen::Matrix<double, 3, 2> gradient;
      gradient.bottomRows<2>() = edges.inverse();
      gradient.row(0) = -gradient.bottomRows<2>().colwise().sum();
      gradients_.push_back(gradient);
      areas_.push_back(std::abs(edges.determinant()) / 2);
      const Eigen::Matrix3d part = areas_.back() * gradient * gradient.transpose();
      for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) entries.emplace_back(corners[i], corners[k], part(i, k));
    }
    // Something must hold it in space.
    constexpr double kHold = 1e-9;
    for (Eigen::Index v = 0; v < start_.rows(); ++v) entries.emplace_back(v, v, kHold);
    Eigen::SparseMatrix<double> matrix(start_.rows(), start_.rows());
    matrix.setFromTriplets(entries.begin(), entries.end());
    solver_.compute(matrix);
    hold_ = kHold * start_;
  }

  void Relax(int rounds) {
    for (int round = 0; round < rounds; ++round) {
      Eigen::MatrixXd right = hold_;
      for (size_t t = 0; t < gradients_.size(); ++t) {
        const Eigen::JacobiSVD<Eigen::Matrix<double, 3, 2>, Eigen::FullPivHouseholderQRPreconditioner> svd(
            Bent(t), Eigen::ComputeFullU | Eigen::ComputeFullV);
        const Eigen::Matrix<double, 3, 2> stiff = svd.matrixU().leftCols<2>() * svd.matrixV().transpose();
        const Eigen::Matrix3d part = areas_[t] * gradients_[t] * stiff.transpose();
        for (int k = 0; k < 3; ++k) right.row(flat_.triangles[t][k]) += part.row(k);
      }
      positions_ = solver_.solve(right);
    }
  }

  // Root of the mean square of what lengths differ by, as a share.
  double Strain() const {
    double sum = 0, area = 0;
    for (size_t t = 0; t < gradients_.size(); ++t) {
      const Eigen::Vector2d stretch = Bent(t).jacobiSvd().singularValues();
      sum += areas_[t] * (stretch.array() - 1).square().mean();
      area += areas_[t];
    }
    return std::sqrt(sum / area);
  }

  // Hausdorff distance of the folded piece and its part of the model, by their vertices.
  double DistanceFromModel() const {
    return std::max(FarthestVertex(positions_, start_), FarthestVertex(start_, positions_));
  }

 private:
  // Of the vertices at `from`, the farthest from the triangles at `to`. A vertex's own place is near already.
  double FarthestVertex(const Eigen::MatrixXd& from, const Eigen::MatrixXd& to) const {
    std::vector<Point3> middles;
    std::vector<double> radii;
    for (const auto& t : flat_.triangles) {
      const Point3 a = to.row(t[0]), b = to.row(t[1]), c = to.row(t[2]), middle = (a + b + c) / 3;
      middles.push_back(middle);
      radii.push_back(std::max({(a - middle).norm(), (b - middle).norm(), (c - middle).norm()}));
    }
    double farthest = 0;
    for (Eigen::Index v = 0; v < from.rows(); ++v) {
      const Point3 p = from.row(v);
      double nearest = (p - Point3(to.row(v))).norm();
      for (size_t t = 0; t < middles.size(); ++t) {
        const double reach = nearest + radii[t];
        if ((p - middles[t]).squaredNorm() >= reach * reach) continue;
        const auto& corners = flat_.triangles[t];
        nearest = std::min(nearest,
                           DistanceToTriangle(p, to.row(corners[0]), to.row(corners[1]), to.row(corners[2])));
      }
      farthest = std::max(farthest, nearest);
    }
    return farthest;
  }

  // How triangle t, from the flat piece to space, is turned and stretched.
  Eigen::Matrix<double, 3, 2> Bent(size_t t) const {
    Eigen::Matrix3d corners;
    for (int k = 0; k < 3; ++k) corners.col(k) = positions_.row(flat_.triangles[t][k]).transpose();
    return corners * gradients_[t];
  }

  const FlatMesh& flat_;
  Eigen::MatrixXd start_, positions_, hold_;
  std::vector<Eigen::Matrix<double, 3, 2>> gradients_;
  std::vector<double> areas_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver_;
};

struct Folded {
  double strain = 0;    // of the worst piece
  double distance = 0;  // mm, of the worst piece
};

Folded FoldPaperOf(const char* name, int rounds) {
  const shapes::Shape shape = shapes::ShapeByName(name);
  Params params;
  params.material = PatternMaterial::kPaper;
  params.size = kSize;
  params.print_texture = true;  // keeps the mesh's own triangles, whose places on the model are known
  Progress progress;
  const Pattern pattern = MakePattern(shape.mesh, params, progress).pattern;
  Folded worst;
  for (const Piece& piece : pattern.pieces) {
    PaperSheet sheet(piece.flat, shape.mesh, pattern.scale);
    sheet.Relax(rounds);
    worst.strain = std::max(worst.strain, sheet.Strain());
    worst.distance = std::max(worst.distance, sheet.DistanceFromModel());
  }
  return worst;
}

class PaperOfDevelopable : public ::testing::TestWithParam<const char*> {};

TEST_P(PaperOfDevelopable, FoldsToTheModel) {
  const Folded folded = FoldPaperOf(GetParam(), 100);
  EXPECT_LT(folded.strain, 0.001);
  EXPECT_LT(folded.distance, 0.005 * kSize);
}

INSTANTIATE_TEST_SUITE_P(Shapes, PaperOfDevelopable,
                         ::testing::Values("cube", "closed_cylinder", "frustum", "open_cone", "closed_cone",
                                           "plane_with_hole"),
                         [](const auto& test) { return std::string(test.param); });

// A double curved model can't be folded exactly: pieces straighten a little across. Without any stretch they
// would be farther off still; half a percent is what a damp sheet gives.
class PaperOfDoubleCurved : public ::testing::TestWithParam<const char*> {};

TEST_P(PaperOfDoubleCurved, ComesNearTheModel) {
  const Folded folded = FoldPaperOf(GetParam(), 100);
  EXPECT_LT(folded.strain, 0.006);
  EXPECT_LT(folded.distance, 0.02 * kSize);
}

INSTANTIATE_TEST_SUITE_P(Shapes, PaperOfDoubleCurved, ::testing::Values("cad_part", "torus"),
                         [](const auto& test) { return std::string(test.param); });

// The measure itself: a bent strip laid flat too long is stretched on the model, and folded it is not.
TEST(PaperSheet, GivesWayUntilNothingIsStretched) {
  const SurfaceData mesh = shapes::OpenCylinder(24);
  FlatMesh flat;
  for (const auto& v : mesh.vertices) {
    double angle = std::atan2(v[1], v[0]);
    flat.vertices.push_back(1.01 * Point2(0.5 * angle, v[2]));
  }
  for (size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto& face = mesh.faces[f];
    double low = 10, high = -10;
    for (int v : face) {
      low = std::min(low, flat.vertices[static_cast<size_t>(v)].x());
      high = std::max(high, flat.vertices[static_cast<size_t>(v)].x());
    }
    if (high - low > 1) continue;  // a slit where the angle jumps
    flat.triangles.push_back({face[0], face[1], face[2]});
    flat.face.push_back(static_cast<int>(f));
  }
  PaperSheet sheet(flat, mesh, 1);
  EXPECT_EQ(sheet.DistanceFromModel(), 0);
  EXPECT_NEAR(sheet.Strain(), 0.01, 0.002);
  sheet.Relax(200);
  EXPECT_LT(sheet.Strain(), 0.0005);
  EXPECT_GT(sheet.DistanceFromModel(), 0.003);
  EXPECT_LT(sheet.DistanceFromModel(), 0.05);
}

}  // namespace
}  // namespace dcharts
