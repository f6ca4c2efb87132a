// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/extend_map.h"

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

  // Every triangle turned rigidly to fit its corners best; every free vertex to the mean of its triangles'.
  void Relax() {
    std::vector<Complex> sum(uv_.size());
    std::vector<double> weight(uv_.size(), 0);
    for (int t = 0; t < static_cast<int>(flat_.size()); ++t) {
      if (flat_[t].length == 0 || !IsPlaced(t)) continue;
      const Complex rest = (corner_[t][0] + corner_[t][1] + corner_[t][2]) / 3.0,
                    image = (At(t, 0) + At(t, 1) + At(t, 2)) / 3.0;
      Complex turn = 0;
      for (int i = 0; i < 3; ++i) turn += std::conj(corner_[t][i] - rest) * (At(t, i) - image);
      const double size = std::abs(turn);
      if (!(size > 0)) continue;
      turn /= size;
      const double area = flat_[t].length * flat_[t].third.imag();
      for (int i = 0; i < 3; ++i) {
        const int v = mesh_.triangles(t, i);
        sum[v] += area * (image + turn * (corner_[t][i] - rest));
        weight[v] += area;
      }
    }
    for (size_t v = 0; v < uv_.size(); ++v)
      if (!fixed_[v] && weight[v] > 0) uv_[v] = sum[v] / weight[v];
  }

  const ChartMesh& mesh_;
  const std::vector<bool>& fixed_;
  std::vector<bool>& placed_;
  PlanePoints& uv_;
  std::vector<FlatTriangle> flat_;
  std::vector<std::array<Complex, 3>> corner_;
};

}  // namespace

std::vector<double> ExtendMap(MapEdge& edge) { return Extension(edge).Run(); }

double DirichletExcess(const Eigen::Vector3d& e1, const Eigen::Vector3d& e2, const Complex& z1,
                       const Complex& z2) {
  const FlatTriangle flat = LayFlat(e1, e2);
  return flat.length > 0 ? Energy(flat, z1, z2) : 0;
}

}  // namespace dcharts
