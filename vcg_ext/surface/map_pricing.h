// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "common/parallel.h"
#include "surface/chart_maps.h"
#include "surface/charts.h"
#include "surface/guest_pricing.h"

namespace dcharts {

/// A Pricing for BorderGraphCut: faces cost the stretch that they have in their own chart's map, or would
/// have where the other chart's map is continued over them.
template <class MeshType>
class MapPricing {
 public:
  explicit MapPricing(const SurfaceGraph<MeshType>& surface)
      : maps_(surface), into_a_(surface), into_b_(surface) {}

  /// Charts without a map keep all their faces and get none.
  ChartMaps<MeshType>& Maps() { return maps_; }

  static double Reach() { return 0; }

  void Prepare(int a, int b, const std::vector<int>&, const std::vector<int>& band, const ChartIds& ids) {
    price_.assign(band.size(), 0);
    const auto price = [&](int k) {
      if (k == 0)
        into_a_.Price(maps_, a, b, band, ids, 1, price_);
      else
        into_b_.Price(maps_, b, a, band, ids, -1, price_);
    };
    constexpr std::size_t kManyFaces = 4000;  // fewer are done before a thread has begun
    if (band.size() >= kManyFaces) {
      InParallel(2, {}, [&](int k, const std::function<void()>&) { price(k); });
      return;
    }
    price(0);
    price(1);
  }

  double operator()(int k) const { return price_[k]; }

 private:
  ChartMaps<MeshType> maps_;
  GuestPricing<MeshType> into_a_, into_b_;
  std::vector<double> price_;  // per face of the band
};

}  // namespace dcharts
