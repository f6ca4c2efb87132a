// SPDX-License-Identifier: GPL-3.0-or-later
/// Folds the pieces of a paper pattern back to the model, glued together.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include <Eigen/SparseCholesky>

#include "common/surface_data.h"
#include "pattern/pattern.h"
#include "pattern/surface/data_coordinates.h"
#include "pattern/surface/face_tree.h"

namespace dcharts::test {

struct FoldedBack {
  double strain = 0;     ///< root mean square over the paper's edges: 0.01 is 1 %
  double hausdorff = 0;  ///< between what was folded and the model, as a share of its longest side
};

/// The pieces glued along their seams, and where each point of them belongs.
struct GluedPaper {
  SurfaceData model;  ///< mm
  /// Per face of the model the lengths of its edges in the plane, edge k from corner k to the next; mm.
  std::vector<std::array<double, 3>> lengths;
};

/// Of a pattern made on the faces of `mesh`.
inline GluedPaper Glue(const SurfaceData& mesh, const Pattern& pattern) {
  GluedPaper paper;
  paper.model = mesh;
  for (auto& v : paper.model.vertices)
    for (double& x : v) x *= pattern.scale;
  paper.lengths.resize(mesh.faces.size());
  for (const Piece& piece : pattern.pieces)
    for (size_t t = 0; t < piece.flat.triangles.size(); ++t)
      for (int k = 0; k < 3; ++k) {
        const auto& corner = piece.flat.triangles[t];
        paper.lengths[piece.flat.face[t]][k] =
            (piece.flat.vertices[corner[k]] - piece.flat.vertices[corner[(k + 1) % 3]]).norm();
      }
  return paper;
}

/// Has every point belong at the nearest place of `model`, which the pattern was made for, but not on; and
/// where a tip of it is far from all those places, the point next to it nearly at the tip.
inline void BringTo(const SurfaceData& model, GluedPaper& paper) {
  constexpr double kFar = 0.0035, kNear = 0.001;  // of the model's size
  const FaceTree tree(model);
  const auto bring = [&](int point, const Eigen::Vector3d& p) {
    paper.model.vertices[point] = {p.x(), p.y(), p.z()};
  };
  for (int v = 0; v < static_cast<int>(paper.model.vertices.size()); ++v)
    bring(v, tree.Find(PositionOf(paper.model, v)).point);
  const SurfaceData brought = paper.model;
  const FaceTree brought_tree(brought);
  const double far = kFar * LongestSide(model), near = kNear * LongestSide(model);
  for (const auto& face : model.faces)
    for (int tip : face) {
      const Eigen::Vector3d p = PositionOf(model, tip);
      const auto nearest = brought_tree.Find(p);
      if (nearest.distance < far) continue;
      const auto is_nearer = [&](int v, int w) {
        return (PositionOf(brought, v) - p).norm() < (PositionOf(brought, w) - p).norm();
      };
      const auto& corners = brought.faces[nearest.face];
      const int v = *std::min_element(corners.begin(), corners.end(), is_nearer);
      bring(v, PositionOf(brought, v) + (1 - near / nearest.distance) * (p - nearest.point));
    }
}

/// Each triangle in four, so that the paper can bend between the model's edges, too. `folded` gets places for
/// the new points.
inline GluedPaper Refined(const GluedPaper& paper, Eigen::MatrixX3d& folded) {
  GluedPaper fine;
  fine.model.vertices = paper.model.vertices;
  std::vector<std::pair<int, int>> ends;
  std::map<std::pair<int, int>, int> middles;
  const auto middle = [&](int a, int b) {
    const auto [at, is_new] = middles.try_emplace(std::minmax(a, b), fine.model.vertices.size());
    if (!is_new) return at->second;
    const auto p = fine.model.vertices[a], q = fine.model.vertices[b];
    fine.model.vertices.push_back({(p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2});
    ends.emplace_back(a, b);
    return at->second;
  };
  for (size_t f = 0; f < paper.model.faces.size(); ++f) {
    const auto [a, b, c] = paper.model.faces[f];
    const double x = paper.lengths[f][0] / 2, y = paper.lengths[f][1] / 2, z = paper.lengths[f][2] / 2;
    const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    fine.model.faces.insert(fine.model.faces.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {bc, ca, ab}});
    fine.lengths.insert(fine.lengths.end(), {{x, y, z}, {x, y, z}, {x, y, z}, {x, y, z}});
  }
  const Eigen::Index old = folded.rows();
  folded.conservativeResize(old + static_cast<Eigen::Index>(ends.size()), 3);
  for (size_t k = 0; k < ends.size(); ++k)
    folded.row(old + static_cast<Eigen::Index>(k)) =
        (folded.row(ends[k].first) + folded.row(ends[k].second)) / 2;
  return fine;
}

/// The paper's edges are springs that keep their length in the plane. A point is free near its place on the
/// model, and soon held the harder the farther it is. Newton's method.
class PaperFolder {
 public:
  explicit PaperFolder(const GluedPaper& paper)
      : at_model_(paper.model.vertices.size(), 3), free_(kFree * LongestSide(paper.model)) {
    for (Eigen::Index v = 0; v < at_model_.rows(); ++v)
      at_model_.row(v) = PositionOf(paper.model, static_cast<int>(v));
    std::map<std::pair<int, int>, std::pair<double, int>> edges;  // sum and number of the sides' lengths
    for (size_t f = 0; f < paper.model.faces.size(); ++f)
      for (int k = 0; k < 3; ++k) {
        const auto& face = paper.model.faces[f];
        auto& [sum, sides] = edges[std::minmax(face[k], face[(k + 1) % 3])];
        sum += paper.lengths[f][k];
        ++sides;
      }
    for (const auto& [ends, sides] : edges)
      springs_.push_back({ends.first, ends.second, sides.first / sides.second});
    double length = 0;
    for (const Spring& s : springs_) length += s.length / static_cast<double>(springs_.size());
    held_ = kHeld * length;
  }

  Eigen::MatrixX3d AtModel() const { return at_model_; }

  void Fold(int most_steps, Eigen::MatrixX3d& folded) {
    constexpr double kNothing = 1e-9;
    double energy = Energy(folded);
    if (energy < kNothing) return;
    for (int step = 0; step < most_steps; ++step) {
      const Eigen::MatrixX3d way = NewtonStep(folded);
      double share = 1, next = 0;
      constexpr double kLeastShare = 1e-3, kLeastGain = 1e-3;
      while ((next = Energy(folded + share * way)) >= energy && share > kLeastShare) share /= 2;
      if (next >= energy) return;
      folded += share * way;
      const bool settled = energy - next < kLeastGain * next && share == 1;
      energy = next;
      if (settled) return;
    }
  }

  double Strain(const Eigen::MatrixX3d& folded) const {
    double squares = 0;
    for (const Spring& s : springs_)
      if (s.length > kShortest)
        squares += std::pow((folded.row(s.a) - folded.row(s.b)).norm() / s.length - 1, 2);
    return std::sqrt(squares / static_cast<double>(springs_.size()));
  }

 private:
  static constexpr double kShortest = 0.2;  // mm
  static constexpr double kFree = 0.0033;   // of the model's size
  static constexpr double kHeld = 1e-3;     // against a spring of the mean length
  static constexpr int kHalfPower = 6;      // of the distance: so high that it is much like a wall
  struct Spring {
    int a, b;
    double length;
  };

  static double Stiffness(const Spring& s) { return 1 / std::max(s.length, kShortest); }

  double Energy(const Eigen::MatrixX3d& folded) const {
    double energy = 0;
    for (const Spring& s : springs_)
      energy += Stiffness(s) / 2 * std::pow((folded.row(s.a) - folded.row(s.b)).norm() - s.length, 2);
    for (Eigen::Index v = 0; v < folded.rows(); ++v) {
      const double far = (folded.row(v) - at_model_.row(v)).squaredNorm() / (free_ * free_);
      energy += held_ * free_ * free_ / (2 * kHalfPower) * std::pow(far, kHalfPower);
    }
    return energy;
  }

  Eigen::MatrixX3d NewtonStep(const Eigen::MatrixX3d& folded) {
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(21 * springs_.size() + 6 * folded.rows());
    const auto add = [&](int v, int w, const Eigen::Matrix3d& block) {  // of the lower triangle, v >= w
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < (v == w ? i + 1 : 3); ++j)
          entries.emplace_back(3 * v + i, 3 * w + j, block(i, j));
    };
    Eigen::VectorXd pull = Eigen::VectorXd::Zero(3 * folded.rows());
    for (const Spring& s : springs_) {
      const Eigen::Vector3d way = folded.row(s.b) - folded.row(s.a);
      const double length = std::max(way.norm(), 1e-9), stiffness = Stiffness(s);
      const Eigen::Vector3d along = way / length;
      // One that is pressed would rather turn, which is left out: the matrix stays positive definite.
      const double across = std::max(0.0, 1 - s.length / length);
      const Eigen::Matrix3d block =
          stiffness * (across * Eigen::Matrix3d::Identity() + (1 - across) * along * along.transpose());
      add(s.a, s.a, block);
      add(s.b, s.b, block);
      add(std::max(s.a, s.b), std::min(s.a, s.b), -block);
      const Eigen::Vector3d force = stiffness * (length - s.length) * along;
      pull.segment<3>(3 * s.a) += force;
      pull.segment<3>(3 * s.b) -= force;
    }
    constexpr double kSteady = 1e-6;
    for (int v = 0; v < folded.rows(); ++v) {
      const Eigen::Vector3d off = (folded.row(v) - at_model_.row(v)) / free_;
      const double square = off.squaredNorm(), held = held_ * std::pow(square, kHalfPower - 2);
      add(v, v,
          (held * square + kSteady) * Eigen::Matrix3d::Identity() +
              (2 * kHalfPower - 2) * held * off * off.transpose());
      pull.segment<3>(3 * v) -= held * square * free_ * off;
    }
    Eigen::SparseMatrix<double> matrix(pull.size(), pull.size());
    matrix.setFromTriplets(entries.begin(), entries.end());
    if (!analyzed_) solver_.analyzePattern(matrix);
    analyzed_ = true;
    solver_.factorize(matrix);
    const Eigen::VectorXd way = solver_.solve(pull);
    return Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>>(way.data(),
                                                                                       folded.rows(), 3);
  }

  std::vector<Spring> springs_;
  Eigen::MatrixX3d at_model_;
  double free_, held_ = 0;  // mm; springs per mm
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver_;
  bool analyzed_ = false;
};

/// Both ways, between the points and the middles of edges and faces of each and the surface of the other.
inline double HausdorffDistance(const SurfaceData& a, const SurfaceData& b) {
  double farthest = 0;
  const auto measure = [&](const SurfaceData& from, const FaceTree& to) {
    for (const auto& [i, j, k] : from.faces) {
      const Eigen::Vector3d p = PositionOf(from, i), q = PositionOf(from, j), r = PositionOf(from, k);
      for (const Eigen::Vector3d& sample :
           {p, Eigen::Vector3d((p + q) / 2), Eigen::Vector3d((p + q + r) / 3)})
        farthest = std::max(farthest, to.Find(sample).distance);
    }
  };
  measure(a, FaceTree(b));
  measure(b, FaceTree(a));
  return farthest;
}

/// Of a pattern made on the faces of `mesh`, which stands for `model`.
inline FoldedBack FoldBack(const SurfaceData& mesh, const Pattern& pattern, SurfaceData model) {
  constexpr int kSteps = 60, kFineSteps = 12;
  for (auto& v : model.vertices)
    for (double& x : v) x *= pattern.scale;
  GluedPaper paper = Glue(mesh, pattern);
  BringTo(model, paper);
  PaperFolder coarse(paper);
  Eigen::MatrixX3d folded = coarse.AtModel();
  coarse.Fold(kSteps, folded);
  paper = Refined(paper, folded);
  BringTo(model, paper);
  PaperFolder fine(paper);
  fine.Fold(kFineSteps, folded);
  SurfaceData at = paper.model;
  for (size_t v = 0; v < at.vertices.size(); ++v)
    for (int d : {0, 1, 2}) at.vertices[v][d] = folded(static_cast<Eigen::Index>(v), d);
  return {fine.Strain(folded), HausdorffDistance(at, model) / LongestSide(model)};
}

}  // namespace dcharts::test
