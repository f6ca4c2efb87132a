// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "common/progress.h"
#include "planar/cone_proxy.h"
#include "surface/border_graph_cut.h"

namespace dcharts {

/// Faces priced by their fitting error (Eq. 1) to the charts' proxies near the border: charts, large ones
/// above all, are cones near each border rather than as a whole.
template <class MeshType>
class ProxyPricing {
 public:
  explicit ProxyPricing(const SurfaceGraph<MeshType>& surface) : surface_(surface) {}

  /// A proxy is fitted to the faces up to here from the border, on a surface of area 1.
  static double Reach() { return 0.1; }

  void Prepare(int a, int, const std::vector<int>& nearby, const std::vector<int>& band,
               const ChartIds& ids) {
    NormalMoments of_a, of_b;
    for (int f : nearby) (ids[f] == a ? of_a : of_b).Add(surface_.Area(f), surface_.Normal(f));
    proxy_a_ = FitCone(of_a);
    proxy_b_ = FitCone(of_b);
    band_ = &band;
  }

  double operator()(int k) const {
    const Eigen::Vector3d& normal = surface_.Normal((*band_)[k]);
    return FittingError(proxy_b_, normal) - FittingError(proxy_a_, normal);
  }

 private:
  const SurfaceGraph<MeshType>& surface_;
  ConeProxy proxy_a_, proxy_b_;
  const std::vector<int>* band_ = nullptr;
};

/// Straightening borders by graph cuts, in place of Section 3.3's shortest paths.
template <class MeshType>
class GraphCutStraightener {
 public:
  GraphCutStraightener(const SurfaceGraph<MeshType>& surface, const BorderCutOptions& options,
                       Progress& progress)
      : pricing_(surface), cut_(surface, options, pricing_, progress) {}

  /// What BorderGraphCut::Run() says.
  void Run(ChartIds& ids) { cut_.Run(ids); }

 private:
  ProxyPricing<MeshType> pricing_;
  BorderGraphCut<MeshType, ProxyPricing<MeshType>> cut_;
};

}  // namespace dcharts
