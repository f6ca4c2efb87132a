// SPDX-License-Identifier: GPL-3.0-or-later
/// Folds the pieces of a paper pattern back to the model, glued together.
#pragma once

#include <algorithm>
#include <cmath>
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

/// The paper's edges are springs that keep their length in the plane. What is glued together is the model's
/// vertices, held where they are by weak springs, as by hand. Of a pattern made on the faces of `mesh`.
inline FoldedBack FoldBack(const SurfaceData& mesh, const Pattern& pattern) {
  constexpr double kHeld = 0.01, kShortest = 0.2;  // springs per mm; mm
  constexpr int kRounds = 200;
  struct Spring {
    int a, b;
    double length, weight;
  };
  std::vector<Spring> springs;
  for (const Piece& piece : pattern.pieces)
    for (size_t t = 0; t < piece.flat.triangles.size(); ++t)
      for (int k = 0; k < 3; ++k) {
        const auto &corner = piece.flat.triangles[t], &face = mesh.faces[piece.flat.face[t]];
        const double length =
            (piece.flat.vertices[corner[k]] - piece.flat.vertices[corner[(k + 1) % 3]]).norm();
        springs.push_back({face[k], face[(k + 1) % 3], length, 1 / std::max(length, kShortest)});
      }
  SurfaceData model = mesh;
  for (auto& v : model.vertices)
    for (double& x : v) x *= pattern.scale;
  const auto count = static_cast<Eigen::Index>(model.vertices.size());
  Eigen::MatrixX3d at_model(count, 3);
  for (int v = 0; v < count; ++v) at_model.row(v) = PositionOf(model, v);
  std::vector<Eigen::Triplet<double>> entries;
  for (const Spring& s : springs)
    for (const auto& [i, j] : {std::pair(s.a, s.b), std::pair(s.b, s.a)}) {
      entries.emplace_back(i, i, s.weight);
      entries.emplace_back(i, j, -s.weight);
    }
  for (int v = 0; v < count; ++v) entries.emplace_back(v, v, kHeld);
  Eigen::SparseMatrix<double> matrix(count, count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(matrix);
  Eigen::MatrixX3d paper = at_model;
  for (int round = 0; round < kRounds; ++round) {
    Eigen::MatrixX3d right = kHeld * at_model;
    for (const Spring& s : springs) {
      const Eigen::RowVector3d way = paper.row(s.a) - paper.row(s.b);
      const Eigen::RowVector3d pull = s.weight * s.length / std::max(way.norm(), 1e-12) * way;
      right.row(s.a) += pull;
      right.row(s.b) -= pull;
    }
    paper = solver.solve(right);
  }
  FoldedBack result;
  double squares = 0;
  for (const Spring& s : springs) {
    const double strain = (paper.row(s.a) - paper.row(s.b)).norm() / std::max(s.length, kShortest) - 1;
    if (s.length > kShortest) squares += strain * strain;
  }
  result.strain = std::sqrt(squares / static_cast<double>(springs.size()));
  SurfaceData folded = model;
  for (int v = 0; v < count; ++v) folded.vertices[v] = {paper(v, 0), paper(v, 1), paper(v, 2)};
  double farthest = 0;
  const auto measure = [&](const SurfaceData& from, const FaceTree& to) {
    for (const auto& [a, b, c] : from.faces) {
      const Eigen::Vector3d p = PositionOf(from, a), q = PositionOf(from, b), r = PositionOf(from, c);
      for (const Eigen::Vector3d& sample :
           {p, Eigen::Vector3d((p + q) / 2), Eigen::Vector3d((p + q + r) / 3)})
        farthest = std::max(farthest, to.Find(sample).distance);
    }
  };
  measure(model, FaceTree(folded));
  measure(folded, FaceTree(model));
  result.hausdorff = farthest / LongestSide(model);
  return result;
}

}  // namespace dcharts::test
