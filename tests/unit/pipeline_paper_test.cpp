// SPDX-License-Identifier: GPL-3.0-or-later
/// What the paper shows in its figures, on shapes of ours.
#include "dcharts.h"

#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>

#include "atlas_checks.h"
#include "shapes.h"

namespace dcharts {
namespace {

struct Outcome {
  int charts;
  double seam_length;
};

Outcome SegmentedAndFilled(SurfaceData mesh, const Params& params) {
  Progress progress;
  const SurfaceChange grown = Segment(mesh, params, progress);
  mesh.face_quality.assign(grown.chart_ids.begin(), grown.chart_ids.end());
  const Report report = Fill(mesh, params, progress).report;
  return {*report.charts, *report.seam_length};
}

// Figure 3, the sphere with alpha 1, gamma 0, and beta 0 or 0.7, after the iterations. Seams of the most
// compact charts there are, the sides of regular solids, follow no mesh edges; ours do before straightening,
// which makes them longer. Seeds far apart make charts round by themselves, so both are only printed beside
// each other; what beta does while charts grow is in surface_paper_sphere_test.cpp.
TEST(Paper, ChartsOfASphereAreNearlyAsCompactAsCanBe) {
  const SurfaceData sphere = shapes::Sphere(12);
  struct Solid {
    int charts, edges;
    double arc;  // radians
  };
  const Solid solids[] = {{4, 6, std::acos(-1. / 3)}, {6, 12, std::acos(1. / 3)}, {12, 30, 0.7297276562}};
  for (const Solid& solid : solids) {
    Params params;
    params.chart_count = solid.charts;
    params.fitting_weight = 1;
    params.straightness_weight = 0;
    params.compactness_weight = 0;
    const Outcome loose = SegmentedAndFilled(sphere, params);
    params.compactness_weight = 0.7;
    const Outcome compact = SegmentedAndFilled(sphere, params);
    const double best = solid.edges * solid.arc / std::sqrt(4 * std::acos(-1.));
    std::printf("%2d charts on a sphere: seams %.3f with beta 0, %.3f with beta 0.7, at best %.3f\n",
                solid.charts, loose.seam_length, compact.seam_length, best);
    EXPECT_EQ(compact.charts, solid.charts);
    EXPECT_LT(compact.seam_length, 1.35 * best);
  }
}

// Figure 5: mechanical parts stay strictly developable with eta 1e-5, L2 below 1.00075 in spite of fillets,
// whatever the number of charts to start from.
TEST(Paper, MechanicalPartsStayDevelopable) {
  for (int edges : {32, 48}) {
    const SurfaceData part = shapes::CadPart(edges);
    for (int count : {0, 6, 40}) {
      Params params;
      params.chart_count = count;
      params.merge_by = MergeMethod::kBoundaryRegion;
      params.merge_threshold = 1e-5;
      Progress progress;
      const SurfaceChange atlas = TextureAtlas(part, params, progress);
      EXPECT_EQ(test::WrongInAtlas(part, atlas, false), "");
      const double l2 = test::StretchOf(part, atlas.wedge_texcoords).l2;
      std::printf("mechanical part of %zu faces from %d charts: %d charts, L2 %.5f\n", part.faces.size(),
                  count, *atlas.report.charts, l2);
      EXPECT_LT(l2, 1.00075) << edges << " " << count;
      EXPECT_LT(*atlas.report.charts, 40) << "flat neighbours and rounded edges merge";
    }
  }
}

}  // namespace
}  // namespace dcharts
