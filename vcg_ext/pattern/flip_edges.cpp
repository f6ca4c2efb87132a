// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/flip_edges.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "pattern/half_edges.h"

namespace dcharts {
namespace {

double Cross(const Point2& a, const Point2& b) { return a.x() * b.y() - a.y() * b.x(); }

class EdgeFlipper {
 public:
  EdgeFlipper(const std::vector<std::pair<int, int>>& kept, FlatChart& chart)
      : chart_(chart), opposite_(OppositeHalfEdges(chart)) {
    for (const auto& [a, b] : kept) kept_.insert(std::minmax(a, b));
  }

  void Run() {
    std::vector<int> open;
    for (int h = 0; h < static_cast<int>(opposite_.size()); ++h)
      if (h < opposite_[h]) open.push_back(h);
    // Rounding must not keep it going.
    size_t most = 20 * opposite_.size();
    while (!open.empty() && most-- > 0) {
      const int h = open.back();
      open.pop_back();
      if (opposite_[h] < 0 || !Improves(h)) continue;
      const int g = opposite_[h];
      Flip(h);
      for (const int around : {h, Next(Next(h)), g, Next(Next(g))}) open.push_back(around);
    }
  }

 private:
  static int Next(int h) { return 3 * (h / 3) + (h + 1) % 3; }
  int Apex(int h) const { return EndOf(chart_, Next(h)); }
  Point2 At(int v) const { return chart_.uv.row(v).transpose(); }
  Eigen::RowVector3d OnModel(int v) const { return chart_.mesh.positions.row(v); }

  bool Improves(int h) const {
    const int g = opposite_[h];
    if (chart_.source_face[h / 3] != chart_.source_face[g / 3]) return false;
    const int a = StartOf(chart_, h), b = EndOf(chart_, h), c = Apex(h), d = Apex(g);
    if (c == d || kept_.count(std::minmax(a, b)) > 0) return false;
    const Point2 pa = At(a), pb = At(b), pc = At(c), pd = At(d);
    const double longest =
        std::max({(pa - pb).squaredNorm(), (pa - pc).squaredNorm(), (pb - pc).squaredNorm(),
                  (pa - pd).squaredNorm(), (pb - pd).squaredNorm(), (pc - pd).squaredNorm()});
    // Both new triangles must be ones: the four corners are convex.
    constexpr double kFlat = 1e-9, kGain = 1e-9;
    const double at_a = Cross(pd - pa, pc - pa), at_b = Cross(pc - pb, pd - pb);
    if (!(std::min(at_a, at_b) > kFlat * longest)) return false;
    // The angles at c and d are more than half a turn together.
    const double sine =
        Cross(pa - pc, pb - pc) * (pb - pd).dot(pa - pd) + Cross(pb - pd, pa - pd) * (pa - pc).dot(pb - pc);
    if (!(sine < -kGain * longest * longest)) return false;
    return IsOneMap(a, b, c, d, at_a / (at_a + at_b));
  }

  // Both diagonals cross in the same point of the model, so that the four corners lie in one plane and are
  // mapped alike. `along`: of the edge ab, where the other diagonal crosses it.
  bool IsOneMap(int a, int b, int c, int d, double along) const {
    constexpr double kOff = 1e-9;
    const Point2 at = (1 - along) * At(a) + along * At(b), way = At(d) - At(c);
    const double across = way.dot(at - At(c)) / way.squaredNorm();
    const Eigen::RowVector3d one = (1 - along) * OnModel(a) + along * OnModel(b),
                             other = (1 - across) * OnModel(c) + across * OnModel(d);
    const double size = (OnModel(a) - OnModel(b)).norm() + (OnModel(c) - OnModel(d)).norm();
    return (one - other).norm() <= kOff * size;
  }

  // The triangles abc and bad become adc and bcd.
  void Flip(int h) {
    const int g = opposite_[h], c = Apex(h), d = Apex(g);
    const int outer_h = opposite_[Next(h)], outer_g = opposite_[Next(g)];  // beyond bc and ad
    Corner(Next(h)) = d;
    Corner(Next(g)) = c;
    // Now h is ad and g is bc; the new edge is Next(h) and Next(g).
    Link(h, outer_g);
    Link(g, outer_h);
    Link(Next(h), Next(g));
  }

  int& Corner(int h) { return chart_.mesh.triangles(h / 3, h % 3); }
  void Link(int h, int g) {
    opposite_[h] = g;
    if (g >= 0) opposite_[g] = h;
  }

  FlatChart& chart_;
  std::vector<int> opposite_;
  std::set<std::pair<int, int>> kept_;
};

}  // namespace

void FlipEdges(const std::vector<std::pair<int, int>>& kept, FlatChart& chart) {
  EdgeFlipper(kept, chart).Run();
}

}  // namespace dcharts
