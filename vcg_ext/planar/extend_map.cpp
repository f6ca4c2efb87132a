// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/extend_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

namespace dcharts {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

// Edges 01 and 02 of a triangle laid into the plane, the first along the real axis.
struct FlatTriangle {
  double length = 0;  // of edge 01; 0 when the triangle has no area
  Complex third;
};

FlatTriangle LayFlat(const Eigen::Vector3d& e1, const Eigen::Vector3d& e2) {
  FlatTriangle flat;
  const double twice_area = e1.cross(e2).norm();
  constexpr double kThin = 1e-9;
  if (!(twice_area > kThin * (e1.squaredNorm() + e2.squaredNorm()))) return flat;
  flat.length = e1.norm();
  flat.third = Complex(e1.dot(e2), twice_area) / flat.length;
  return flat;
}

double Energy(const FlatTriangle& flat, const Complex& z1, const Complex& z2) {
  const double height = flat.third.imag();
  const double det = Cross(z1, z2) / (flat.length * height);
  if (!(det > 0)) return kNever;
  const Complex x = z1 / flat.length, y = (z2 - flat.third.real() * x) / height;  // the Jacobian's columns
  const double norm = std::norm(x) + std::norm(y);
  return (norm + norm / (det * det)) / 4 - 1;
}

class Extension {
 public:
  explicit Extension(MapEdge& edge)
      : mesh_(edge.mesh), fixed_(edge.fixed), placed_(edge.placed), uv_(edge.uv) {
    for (int t = 0; t < mesh_.triangles.rows(); ++t) {
      const Eigen::Vector3d p = mesh_.positions.row(mesh_.triangles(t, 0)),
                            q = mesh_.positions.row(mesh_.triangles(t, 1)),
                            r = mesh_.positions.row(mesh_.triangles(t, 2));
      flat_.push_back(LayFlat(q - p, r - p));
      corner_.push_back({Complex(0), Complex(flat_.back().length), flat_.back().third});
    }
  }

  std::vector<double> Run() {
    Unfold();
    ListPlaced();
    constexpr int kRelaxations = 30;
    for (int i = 0; i < kRelaxations; ++i) Relax();
    std::vector<double> energy(flat_.size(), 0);
    for (int t = 0; t < static_cast<int>(flat_.size()); ++t) {
      if (flat_[t].length == 0) continue;
      const Complex &z0 = At(t, 0), &z1 = At(t, 1), &z2 = At(t, 2);
      energy[t] = IsPlaced(t) ? Energy(flat_[t], z1 - z0, z2 - z0) : kNever;
    }
    return energy;
  }

 private:
  const Complex& At(int t, int i) const { return uv_[mesh_.triangles(t, i)]; }
  bool IsPlaced(int t) const {
    return placed_[mesh_.triangles(t, 0)] && placed_[mesh_.triangles(t, 1)] && placed_[mesh_.triangles(t, 2)];
  }

  // Ring by ring: a vertex is placed where the triangles with a placed edge want it, at their mean.
  void Unfold() {
    std::vector<int> open;
    for (int t = 0; t < static_cast<int>(flat_.size()); ++t)
      if (flat_[t].length > 0 && !IsPlaced(t)) open.push_back(t);
    std::vector<Complex> sum(uv_.size());
    std::vector<int> count(uv_.size(), 0), reached, left;
    for (bool any = true; any;) {
      reached.clear();
      left.clear();
      for (int t : open) {
        int free = -1, free_count = 0;
        for (int i = 0; i < 3; ++i)
          if (!placed_[mesh_.triangles(t, i)]) {
            free = i;
            ++free_count;
          }
        if (free_count == 0) continue;
        left.push_back(t);
        if (free_count != 1) continue;
        const int j = (free + 1) % 3, k = (free + 2) % 3, v = mesh_.triangles(t, free);
        const Complex turn = (At(t, k) - At(t, j)) / (corner_[t][k] - corner_[t][j]);
        const double size = std::abs(turn);
        if (!(size > 0)) continue;
        const Complex middle = 0.5 * (At(t, j) + At(t, k));
        sum[v] += middle + turn / size * (corner_[t][free] - 0.5 * (corner_[t][j] + corner_[t][k]));
        if (count[v]++ == 0) reached.push_back(v);
      }
      for (int v : reached) {
        uv_[v] = sum[v] / static_cast<double>(count[v]);
        placed_[v] = true;
      }
      any = !reached.empty();
      open.swap(left);
    }
  }

  // A triangle with all corners placed, and where they are from its centre when it is laid flat.
  struct Placed {
    std::array<int, 3> vertex;
    std::array<Complex, 3> from_centre;
    double area;
  };

  void ListPlaced() {
    for (int t = 0; t < static_cast<int>(flat_.size()); ++t) {
      if (flat_[t].length == 0 || !IsPlaced(t)) continue;
      const std::array<Complex, 3>& corner = corner_[t];
      const Complex centre = (corner[0] + corner[1] + corner[2]) / 3.0;
      Placed triangle{{}, {}, flat_[t].length * flat_[t].third.imag()};
      for (int i = 0; i < 3; ++i) {
        triangle.vertex[i] = mesh_.triangles(t, i);
        triangle.from_centre[i] = corner[i] - centre;
      }
      placed_triangles_.push_back(triangle);
    }
    sum_.resize(uv_.size());
    weight_.resize(uv_.size());
  }

  // Every triangle turned rigidly to fit its corners best; every free vertex to the mean of its triangles'.
  void Relax() {
    std::fill(sum_.begin(), sum_.end(), Complex(0));
    std::fill(weight_.begin(), weight_.end(), 0);
    for (const Placed& triangle : placed_triangles_) {
      Complex at[3];
      for (int i = 0; i < 3; ++i) at[i] = uv_[triangle.vertex[i]];
      const Complex image = (at[0] + at[1] + at[2]) / 3.0;
      Complex turn = 0;
      for (int i = 0; i < 3; ++i) turn += ConjMul(triangle.from_centre[i], at[i] - image);
      const double square = std::norm(turn);  // a root takes less time than std::abs
      const double size = std::isnormal(square) ? std::sqrt(square) : std::abs(turn);
      if (!(size > 0)) continue;
      turn /= size;
      for (int i = 0; i < 3; ++i) {
        sum_[triangle.vertex[i]] += triangle.area * (image + Mul(turn, triangle.from_centre[i]));
        weight_[triangle.vertex[i]] += triangle.area;
      }
    }
    for (size_t v = 0; v < uv_.size(); ++v)
      if (!fixed_[v] && weight_[v] > 0) uv_[v] = sum_[v] / weight_[v];
  }

  const ChartMesh& mesh_;
  const std::vector<bool>& fixed_;
  std::vector<bool>& placed_;
  PlanePoints& uv_;
  std::vector<FlatTriangle> flat_;
  std::vector<std::array<Complex, 3>> corner_;
  std::vector<Placed> placed_triangles_;
  std::vector<Complex> sum_;  // of Relax, per vertex
  std::vector<double> weight_;
};

}  // namespace

std::vector<double> ExtendMap(MapEdge& edge) { return Extension(edge).Run(); }

double DirichletExcess(const Eigen::Vector3d& e1, const Eigen::Vector3d& e2, const Complex& z1,
                       const Complex& z2) {
  const FlatTriangle flat = LayFlat(e1, e2);
  return flat.length > 0 ? Energy(flat, z1, z2) : 0;
}

}  // namespace dcharts
