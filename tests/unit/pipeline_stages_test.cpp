// SPDX-License-Identifier: GPL-3.0-or-later
/// One stage after the other gives what the one-shot filter gives, byte for byte.
#include "dcharts.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "atlas_checks.h"
#include "coarse_shapes.h"
#include "run_stages.h"

namespace dcharts {
namespace {

using test::Coarse;
using test::kAllStages;
using test::kCoarse;
using test::Kept;
using test::RunAll;
using test::Stage;
using test::Write;

class StageByStage : public testing::TestWithParam<Coarse> {};

INSTANTIATE_TEST_SUITE_P(Pipeline, StageByStage, testing::ValuesIn(kCoarse),
                         [](const testing::TestParamInfo<Coarse>& shape) { return shape.param.name; });

TEST(Stages, GiveTheSameBytesWithNearlyAsManySeedsAsFaces) {
  for (const SurfaceData& mesh : {shapes::BowTie(), shapes::NonManifoldFin()})
    for (int count : {20, 56, 1000}) {
      Params params;
      params.chart_count = count;
      Progress progress;
      const SurfaceChange once = TextureAtlas(mesh, params, progress);
      const SurfaceChange stages = RunAll(mesh, params, Kept::kFile, kAllStages);
      EXPECT_EQ(stages.chart_ids, once.chart_ids) << count;
      EXPECT_TRUE(stages.wedge_texcoords == once.wedge_texcoords) << count;
    }
}

TEST_P(StageByStage, GivesTheSameBytesAsOneShot) {
  const SurfaceData mesh = GetParam().make();
  for (bool to_disk : {false, true}) {
    Params params;
    params.chart_count = to_disk ? 5 : 0;
    params.cut_to_disk = to_disk;
    Progress progress;
    const SurfaceChange once = TextureAtlas(mesh, params, progress);
    for (Kept kept : {Kept::kFile, Kept::kAll}) {
      if (kept == Kept::kAll && !to_disk) continue;
      SCOPED_TRACE("chart_count " + std::to_string(params.chart_count) +
                   (kept == Kept::kFile ? ", as a file" : ", as a session"));
      const SurfaceChange stages = RunAll(mesh, params, kept, kAllStages);
      EXPECT_EQ(stages.chart_ids, once.chart_ids);
      EXPECT_EQ(stages.colors, once.colors);
      EXPECT_TRUE(stages.wedge_texcoords == once.wedge_texcoords);
      EXPECT_EQ(stages.report.l2_stretch, once.report.l2_stretch);
      EXPECT_EQ(stages.report.seam_length, once.report.seam_length);
    }
  }
}

TEST_P(StageByStage, StagesKeepTheirPromises) {
  SurfaceData mesh = GetParam().make();
  const auto faces = mesh.faces.size();
  const std::vector<const char*> names{"segment", "fill", "straighten", "merge", "cut", "parameterize"};
  Params params;
  params.chart_count = 5;
  for (size_t s = 0; s < kAllStages.size(); ++s) {
    SCOPED_TRACE(names[s]);
    mesh.seams.assign(faces, 0);  // an old attribute
    Progress progress;
    const SurfaceChange change = kAllStages[s](mesh, params, progress);
    ASSERT_EQ(change.chart_ids.size(), faces);
    ASSERT_EQ(change.colors.size(), faces);
    // Ids are 0..n-1, as many as reported; unassigned faces only after Segment.
    std::set<int> ids(change.chart_ids.begin(), change.chart_ids.end());
    const bool holes = ids.erase(-1) > 0;
    EXPECT_TRUE(!holes || s == 0);
    ASSERT_FALSE(ids.empty());
    EXPECT_EQ(*ids.begin(), 0);
    EXPECT_EQ(*ids.rbegin() + 1, static_cast<int>(ids.size()));
    EXPECT_EQ(change.report.charts, static_cast<int>(ids.size()));
    EXPECT_EQ(change.report.unassigned_faces,
              std::count(change.chart_ids.begin(), change.chart_ids.end(), -1));
    EXPECT_EQ(change.report.iterations.has_value(), s == 0);
    if (s < 4) {
      EXPECT_TRUE(change.remove_seams && change.seams.empty() && change.wedge_texcoords.empty());
    } else if (s == 4) {
      EXPECT_EQ(change.seams.size(), faces);
      EXPECT_TRUE(change.report.darts.has_value());
      // The provisional texcoords say the same as the attribute.
      const test::UvTopology topology = test::TopologyOf(mesh, change.wedge_texcoords);
      const std::vector<int> opposite = test::Opposites(mesh);
      for (size_t h = 0; h < opposite.size(); ++h)
        if (opposite[h] >= 0) {
          ASSERT_EQ(topology.glued[h] < 0, (change.seams[h / 3] >> (h % 3) & 1) == 1) << h;
        }
      for (const auto& t : change.wedge_texcoords)
        for (float x : t) ASSERT_TRUE(x >= 0 && x <= 1);
    } else {
      EXPECT_TRUE(change.remove_seams);
    }
    Write(change, Kept::kAll, mesh);
  }
}

TEST(Stages, FloatQualityIsEnough) {
  const SurfaceData mesh = shapes::Plush(32);
  Params params;
  params.chart_count = 12;
  Progress progress;
  SurfaceData between = mesh;
  const SurfaceChange segmented = Segment(mesh, params, progress);
  for (int id : segmented.chart_ids) between.face_quality.push_back(static_cast<float>(id));
  SurfaceData doubles = mesh;
  doubles.face_quality.assign(segmented.chart_ids.begin(), segmented.chart_ids.end());
  EXPECT_EQ(Fill(between, params, progress).chart_ids, Fill(doubles, params, progress).chart_ids);
}

TEST(Stages, EachStageRepeatedStaysSound) {
  for (SurfaceData mesh : {shapes::Cube(4), shapes::Torus(10), shapes::SphericalCap(6, 1.4)}) {
    Params params;
    params.chart_count = 6;
    const SurfaceChange twice = RunAll(
        mesh, params, Kept::kAll,
        {Segment, Fill, Fill, Straighten, Straighten, Merge, Merge, Cut, Cut, Parameterize, Parameterize});
    EXPECT_EQ(test::WrongInAtlas(mesh, twice, false), "");
  }
}

TEST(Stages, FillAndMergeTwiceChangeNothing) {
  for (SurfaceData mesh : {shapes::Cube(4), shapes::Torus(10), shapes::Sphere(5)}) {
    Params params;
    params.chart_count = 6;
    EXPECT_EQ(RunAll(mesh, params, Kept::kAll, {Segment, Fill, Fill}).chart_ids,
              RunAll(mesh, params, Kept::kAll, {Segment, Fill}).chart_ids);
    EXPECT_EQ(RunAll(mesh, params, Kept::kAll, {Segment, Fill, Merge, Merge}).chart_ids,
              RunAll(mesh, params, Kept::kAll, {Segment, Fill, Merge}).chart_ids);
  }
}

// Graph Cut may, for faces that fit their charts better.
TEST(Stages, ShortestPathNeverMakesBordersLonger) {
  for (const Coarse& shape : kCoarse) {
    const SurfaceData mesh = shape.make();
    Params params;
    params.chart_count = 6;
    params.straighten_by = StraightenMethod::kShortestPath;
    const SurfaceChange before = RunAll(mesh, params, Kept::kAll, {Segment, Fill});
    const SurfaceChange after = RunAll(mesh, params, Kept::kAll, {Segment, Fill, Straighten});
    EXPECT_LE(*after.report.seam_length, *before.report.seam_length * (1 + 1e-12)) << shape.name;
  }
}

TEST(Stages, StraightenKeepsTheNumberOfCharts) {
  for (const Coarse& shape : kCoarse)
    for (auto method : {StraightenMethod::kGraphCut, StraightenMethod::kShortestPath}) {
      const SurfaceData mesh = shape.make();
      Params params;
      params.chart_count = 6;
      params.straighten_by = method;
      const SurfaceChange before = RunAll(mesh, params, Kept::kAll, {Segment, Fill});
      const SurfaceChange after = RunAll(mesh, params, Kept::kAll, {Segment, Fill, Straighten});
      EXPECT_EQ(after.report.charts, before.report.charts) << shape.name;
    }
}

// With neither attribute nor texcoords, Parameterize cuts for itself and says so.
TEST(Stages, ParameterizeCutsWhatNobodyCut) {
  for (SurfaceData mesh : {shapes::OpenCylinder(16), shapes::Torus(10), shapes::Sphere(5)}) {
    std::string log;
    Progress progress({}, [&](const std::string& line) { log += line + "\n"; });
    const SurfaceChange atlas = Parameterize(mesh, Params(), progress);
    EXPECT_EQ(test::WrongInAtlas(mesh, atlas, false), "");
    EXPECT_NE(log.find("Cut"), std::string::npos) << log;
  }
}

TEST(Stages, ParameterizePartsWhatIsAboveMaxStretch) {
  for (SurfaceData mesh : {shapes::SphericalCap(8, 1.5), shapes::Torus(10), shapes::Cube(4)}) {
    mesh.face_quality.assign(mesh.faces.size(), 0);
    mesh.seams.assign(mesh.faces.size(), 0);
    Progress progress;
    Params params;
    const SurfaceChange parted = Parameterize(mesh, params, progress);
    EXPECT_EQ(test::WrongInAtlas(mesh, parted, false), "");
    EXPECT_LT(test::WorstChartStretch(mesh, parted), params.max_stretch + 1e-4);
    params.max_stretch = 0;
    const SurfaceChange whole = Parameterize(mesh, params, progress);
    EXPECT_GT(test::WorstChartStretch(mesh, whole), Params().max_stretch);
  }
}

TEST(Stages, DartsByFittingErrorLeaveNoChartAboveMaxStretch) {
  for (SurfaceData mesh : {shapes::SphericalCap(8, 1.5), shapes::Torus(10), shapes::Sphere(5)}) {
    Params params;
    params.dart_by = DartMethod::kFittingError;
    params.seed_percent = params.seam_weight = 0;
    const SurfaceChange atlas = RunAll(mesh, params, Kept::kAll, kAllStages);
    EXPECT_LT(test::WorstChartStretch(mesh, atlas), params.max_stretch + 1e-4);
  }
}

TEST(Stages, ParameterizeKeepsTheUsersSeams) {
  // A slit in a flat sheet that nobody needs: it is in the attribute, so it stays.
  SurfaceData mesh = shapes::Grid(8, 8);
  mesh.face_quality.assign(mesh.faces.size(), 0);
  mesh.seams.assign(mesh.faces.size(), 0);
  const std::vector<int> opposite = test::Opposites(mesh);
  int slit = 0;
  for (int h = 0; h < static_cast<int>(opposite.size()); ++h) {
    const test::Vec3& a = mesh.vertices[mesh.faces[h / 3][h % 3]];
    const test::Vec3& end = mesh.vertices[mesh.faces[h / 3][h % 3 == 2 ? 0 : h % 3 + 1]];
    if (opposite[h] < 0 || std::abs(a[0] - 0.5) > 1e-9 || std::abs(end[0] - 0.5) > 1e-9) continue;
    if (std::max(a[1], end[1]) > 0.5 + 1e-9) continue;
    mesh.seams[h / 3] = static_cast<std::uint8_t>(mesh.seams[h / 3] | 1 << (h % 3));
    ++slit;
  }
  ASSERT_EQ(slit, 8);  // four edges, both sides
  Progress progress;
  const SurfaceChange atlas = Parameterize(mesh, Params(), progress);
  EXPECT_EQ(test::WrongInAtlas(mesh, atlas, false), "");
  EXPECT_EQ(atlas.report.charts, 1);
  EXPECT_NEAR(*atlas.report.seam_length, 0.5, 1e-9);
}

}  // namespace
}  // namespace dcharts
