// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/choose_segmentation.h"

#include <vector>

#include <gtest/gtest.h>

#include "surface_fixture.h"

namespace dcharts {
namespace {

using test::TestSurface;

TEST(ChooseSegmentation, WithATargetTheOneThatMergesBetter) {
  const TestSurface surface(shapes::DoubleTorus(32));
  Progress progress;
  Params params;
  params.target_charts = 4;
  const int enough = Lloyd<SurfaceMesh>::EnoughCharts(params, surface->FaceCount());
  std::vector<ChartIds> candidates;
  std::vector<double> cost;
  for (int count : {SegmentationChooser<SurfaceMesh>::Fewer(enough), enough}) {
    Params counted = params;
    counted.chart_count = count;
    ChartIds ids = Lloyd<SurfaceMesh>(*surface, counted, progress).Run().ids;
    candidates.push_back(ids);
    HoleFiller<SurfaceMesh>(*surface, params, progress).Run(ids);
    StraightenBorders(*surface, params, progress, ids);
    cost.push_back(TrialMerger<SurfaceMesh>(*surface, params, progress).CoarseCost(ids));
  }
  ASSERT_NE(cost[0], cost[1]);
  const ChartIds chosen = SegmentationChooser<SurfaceMesh>(*surface, params, progress).Run().ids;
  EXPECT_EQ(chosen, candidates[cost[1] < cost[0] ? 1 : 0]);
}

TEST(ChooseSegmentation, WithoutATargetOrWithACountThereIsOne) {
  const TestSurface surface(shapes::Cube(6));
  Progress progress;
  Params params;
  EXPECT_EQ(SegmentationChooser<SurfaceMesh>(*surface, params, progress).Run().ids,
            Lloyd<SurfaceMesh>(*surface, params, progress).Run().ids);
  params.target_charts = 2;
  params.chart_count = 7;
  EXPECT_EQ(SegmentationChooser<SurfaceMesh>(*surface, params, progress).Run().ids,
            Lloyd<SurfaceMesh>(*surface, params, progress).Run().ids);
}

}  // namespace
}  // namespace dcharts
