// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/packing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "common/errors.h"

namespace dcharts {
namespace {

constexpr double kPi = 3.14159265358979323846;

// Counterclockwise hull, by Andrew's monotone chain.
std::vector<Eigen::Vector2d> ConvexHull(const Points2& points) {
  std::vector<Eigen::Vector2d> p;
  for (Eigen::Index k = 0; k < points.rows(); ++k) p.push_back(points.row(k));
  auto less = [](const auto& a, const auto& b) { return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y()); };
  std::sort(p.begin(), p.end(), less);
  std::vector<Eigen::Vector2d> hull;
  for (int pass = 0; pass < 2; ++pass) {
    const size_t base = hull.size();
    for (const Eigen::Vector2d& q : p) {
      while (hull.size() >= base + 2) {
        const Eigen::Vector2d a = hull.back() - hull[hull.size() - 2], b = q - hull.back();
        if (a.x() * b.y() - a.y() * b.x() > 0) break;
        hull.pop_back();
      }
      hull.push_back(q);
    }
    hull.pop_back();
    std::reverse(p.begin(), p.end());
  }
  return hull;
}

// The turn that makes the smallest bounding box, longer side upright.
double UprightAngle(const Points2& outline) {
  const std::vector<Eigen::Vector2d> hull = ConvexHull(outline);
  double best_angle = 0, best_area = std::numeric_limits<double>::infinity();
  for (size_t k = 0; k < hull.size(); ++k) {
    const Eigen::Vector2d edge = hull[(k + 1) % hull.size()] - hull[k];
    if (!(edge.norm() > 0)) continue;
    const Eigen::Vector2d x = edge.normalized(), y(-x.y(), x.x());
    double low[2] = {1e300, 1e300}, high[2] = {-1e300, -1e300};
    for (const Eigen::Vector2d& p : hull) {
      const double c[2] = {p.dot(x), p.dot(y)};
      for (int d : {0, 1}) {
        low[d] = std::min(low[d], c[d]);
        high[d] = std::max(high[d], c[d]);
      }
    }
    const double w = high[0] - low[0], h = high[1] - low[1];
    if (w * h >= best_area * (1 - 1e-9)) continue;
    best_area = w * h;
    best_angle = -std::atan2(x.y(), x.x()) + (w > h ? kPi / 2 : 0);
  }
  return best_angle;
}

Points2 Turned(const Points2& points, double angle) {
  Eigen::Matrix2d r;
  r << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  return points * r.transpose();
}

/// A chart's outline seen column by column, in texels, padding included.
struct Profile {
  std::vector<double> low, high;  // per column
  double height = 0;
};

// `outline` in texels with its box's lower left corner at the origin. `margin` is added all around.
Profile ProfileOf(const Points2& outline, double margin) {
  const double width = outline.col(0).maxCoeff() + 2 * margin;
  const int columns = std::max(1, static_cast<int>(std::ceil(width)));
  Profile profile;
  profile.low.assign(columns, std::numeric_limits<double>::infinity());
  profile.high.assign(columns, -std::numeric_limits<double>::infinity());
  for (Eigen::Index e = 0; e + 1 < outline.rows(); e += 2) {
    Eigen::Vector2d a = outline.row(e), b = outline.row(e + 1);
    if (a.x() > b.x()) std::swap(a, b);
    // The edge with a square of the margin around it covers these columns...
    const int first = std::max(0, static_cast<int>(std::floor(a.x())));
    const int last = std::min(columns - 1, static_cast<int>(std::floor(b.x() + 2 * margin)));
    for (int c = first; c <= last; ++c) {
      // ... and in column c, edge points with x in [c - 2 margin, c + 1] count (margin is added to x below).
      const double from = std::clamp(c - 2 * margin, a.x(), b.x()), to = std::clamp(c + 1.0, a.x(), b.x());
      auto y_at = [&](double x) {
        const double dx = b.x() - a.x();
        return dx > 0 ? a.y() + (b.y() - a.y()) * (x - a.x()) / dx : a.y();
      };
      double low = std::min(y_at(from), y_at(to)), high = std::max(y_at(from), y_at(to));
      if (!(b.x() > a.x())) {
        low = std::min(a.y(), b.y());
        high = std::max(a.y(), b.y());
      }
      profile.low[c] = std::min(profile.low[c], low);
      profile.high[c] = std::max(profile.high[c], high + 2 * margin);
    }
  }
  for (int c = 0; c < columns; ++c) {
    if (profile.low[c] > profile.high[c]) profile.low[c] = profile.high[c] = 0;
    profile.height = std::max(profile.height, profile.high[c]);
  }
  return profile;
}

/// Drops charts onto a horizon in a square of `side` texels.
class Horizon {
 public:
  explicit Horizon(int side) : side_(side), height_(side, 0) {}

  /// The lowest place for the profile; false when it doesn't fit. Ties go to the place that wastes least.
  bool Find(const Profile& p, int* x, double* y, double* top) const {
    const int columns = static_cast<int>(p.low.size());
    double best_top = std::numeric_limits<double>::infinity(), best_waste = best_top;
    for (int left = 0; left + columns <= side_; ++left) {
      double rest = 0;
      for (int c = 0; c < columns; ++c) rest = std::max(rest, height_[left + c] - p.low[c]);
      const double top_here = rest + p.height;
      if (top_here > side_ || top_here > best_top + 1) continue;
      double waste = 0;
      for (int c = 0; c < columns; ++c) waste += rest + p.low[c] - height_[left + c];
      if (top_here > best_top - 1 && waste >= best_waste) continue;
      best_top = top_here;
      best_waste = waste;
      *x = left;
      *y = rest;
    }
    *top = best_top + 1e-3 * best_waste / side_;
    return best_top <= side_;
  }

  void Place(const Profile& p, int x, double y) {
    for (size_t c = 0; c < p.low.size(); ++c) height_[x + c] = std::max(height_[x + c], y + p.high[c]);
  }

 private:
  int side_;
  std::vector<double> height_;
};

class Packer {
 public:
  Packer(const std::vector<Points2>& outlines, bool rotate, int side) : outlines_(outlines), side_(side) {
    for (const Points2& outline : outlines) {
      std::vector<double> angles{0};
      if (rotate) {
        const double upright = UprightAngle(outline);
        angles = {upright, upright + kPi, upright + kPi / 2, upright - kPi / 2};
      }
      angles_.push_back(angles);
      const Points2 turned = Turned(outline, angles[0]);
      height_.push_back(turned.col(1).maxCoeff() - turned.col(1).minCoeff());
    }
    order_.resize(outlines.size());
    std::iota(order_.begin(), order_.end(), 0);
    std::stable_sort(order_.begin(), order_.end(), [&](int a, int b) { return height_[a] > height_[b]; });
  }

  /// Texels per unit `scale`, `margin` texels around each chart. Placements are in texels.
  bool Try(double scale, double margin, std::vector<Placement>* placements) const {
    Horizon horizon(side_);
    placements->assign(outlines_.size(), {});
    for (int k : order_) {
      double best_top = std::numeric_limits<double>::infinity(), best_y = 0;
      int best_x = -1;
      Profile best_profile;
      for (double angle : angles_[k]) {
        Points2 texels = scale * Turned(outlines_[k], angle);
        const Eigen::RowVector2d corner = texels.colwise().minCoeff();
        texels.rowwise() -= corner;
        Profile profile = ProfileOf(texels, margin);
        int x = 0;
        double y = 0, top = 0;
        if (!horizon.Find(profile, &x, &y, &top) || top >= best_top) continue;
        best_top = top;
        best_x = x;
        best_y = y;
        best_profile = std::move(profile);
        (*placements)[k].angle = angle;
        (*placements)[k].offset = Eigen::Vector2d(x + margin, y + margin) - corner.transpose();
      }
      if (best_x < 0) return false;
      horizon.Place(best_profile, best_x, best_y);
    }
    return true;
  }

 private:
  const std::vector<Points2>& outlines_;
  int side_;
  std::vector<std::vector<double>> angles_;
  std::vector<double> height_;
  std::vector<int> order_;
};

double BoxArea(const Points2& p) {
  const Eigen::RowVector2d size = p.colwise().maxCoeff() - p.colwise().minCoeff();
  return size.x() * size.y();
}

}  // namespace

Packing Pack(const std::vector<Points2>& outlines, const PackOptions& options) {
  Packing packing;
  if (outlines.empty()) return packing;
  // Columns finer than this gain nothing; coarser ones waste room when charts are many.
  const int finest = outlines.size() > 1500 ? 2048 : 1024;
  const int side = std::clamp(options.texture_size, 256, finest);
  const Packer packer(outlines, options.rotate, side);
  double area = 0;
  for (const Points2& outline : outlines) area += BoxArea(outline);

  // The largest scale, to half a per cent, from one that certainly doesn't fit. Padding gives way when
  // nothing fits.
  double padding = options.padding;
  const double upper = 2.0 * side / std::sqrt(std::max(area, 1e-300));
  std::vector<Placement> found, trial;
  double scale = 0;
  for (int attempt = 0; scale == 0; ++attempt, padding /= 2) {
    if (attempt == 30)
      throw Error("The charts don't fit into the texture: raise texture_size or lower padding.");
    // Charts keep a hair more than the padding, so that rounding doesn't eat into it.
    const double margin = (padding + 0.05) * side / options.texture_size / 2;
    double low = 0, high = upper;
    for (int step = 0; step < 60 && (low == 0 || high / low > 1.004); ++step) {
      const double middle = low == 0 ? high * 0.8 : std::sqrt(low * high);
      if (packer.Try(middle, margin, &trial)) {
        low = middle;
        found = trial;
      } else {
        high = middle;
      }
    }
    if (low > upper * 1e-3 || padding < 1e-3) scale = low;
    packing.padding = padding;
  }
  packing.scale = scale / side;
  for (Placement& p : found) p.offset /= side;
  packing.placements = std::move(found);
  return packing;
}

}  // namespace dcharts
