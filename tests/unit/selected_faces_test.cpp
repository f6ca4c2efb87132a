// SPDX-License-Identifier: GPL-3.0-or-later
/// selected_only: a stage on the selected faces alone.
#include "surface/selected_faces.h"

#include <algorithm>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "atlas_checks.h"
#include "dcharts.h"
#include "run_stages.h"
#include "runner.h"
#include "selected_part.h"
#include "shapes.h"

namespace dcharts {
namespace {

using test::kAllStages;
using test::Kept;
using test::OfSelected;
using test::RunAll;
using test::SelectedPart;
using test::Stage;

// A torus of which the faces with x above 0 are selected.
SurfaceData HalfSelected() {
  SurfaceData mesh = shapes::Torus(12);
  double middle = 0;
  for (const auto& v : mesh.vertices) middle += v[0] / static_cast<double>(mesh.vertices.size());
  for (const auto& face : mesh.faces) {
    double x = 0;
    for (int v : face) x += mesh.vertices[v][0] / 3;
    mesh.selected.push_back(x > middle ? 1 : 0);
  }
  return mesh;
}

SurfaceChange OnSelected(FilterId filter, const SurfaceData& mesh) {
  Params params;
  params.selected_only = true;
  Progress progress;
  return RunFilter(GetFilter(filter), &mesh, params, progress);
}

TEST(SelectedFaces, AreTreatedAsIfThereWereNoOthers) {
  SurfaceData mesh = HalfSelected();
  mesh.face_quality.assign(mesh.faces.size(), -1);  // no numbers are taken
  const SurfaceData part = SelectedPart(mesh);
  Progress progress;
  const SurfaceChange alone = TextureAtlas(part, {}, progress);
  const SurfaceChange change = OnSelected(FilterId::kTextureAtlas, mesh);
  EXPECT_EQ(change.written, mesh.selected);
  EXPECT_EQ(OfSelected(change.chart_ids, mesh), alone.chart_ids);
  EXPECT_EQ(OfSelected(change.colors, mesh), alone.colors);
  EXPECT_TRUE(OfSelected(change.wedge_texcoords, mesh) == alone.wedge_texcoords);
  EXPECT_EQ(test::WrongInAtlas(part, alone, false), "");
  EXPECT_EQ(change.report.seam_length, alone.report.seam_length);
}

TEST(SelectedFaces, GetNumbersThatNoOtherFaceHas) {
  SurfaceData mesh = HalfSelected();
  const double odd[] = {std::numeric_limits<double>::quiet_NaN(), -7, 1e30, 0.5, 0, 2, 5};
  for (size_t f = 0; f < mesh.faces.size(); ++f) mesh.face_quality.push_back(odd[f % 7]);
  const SurfaceChange change = OnSelected(FilterId::kTextureAtlas, mesh);
  std::set<int> ids;
  for (int id : OfSelected(change.chart_ids, mesh)) ids.insert(id);
  std::vector<int> free{1, 3, 4, 6, 7, 8, 9, 10, 11, 12};
  ASSERT_LE(ids.size(), free.size());
  EXPECT_EQ(std::vector<int>(ids.begin(), ids.end()),
            std::vector<int>(free.begin(), free.begin() + ids.size()));
}

TEST(SelectedFaces, StageByStageIsTheSame) {
  SurfaceData mesh = HalfSelected();
  const SurfaceChange once = OnSelected(FilterId::kTextureAtlas, mesh);
  std::vector<Stage> stages;
  for (const Stage& stage : kAllStages)
    stages.push_back([stage](const SurfaceData& data, const Params& params, Progress& progress) {
      return OnSelectedFaces(data, [&](const SurfaceData& part) { return stage(part, params, progress); });
    });
  for (const Kept kept : {Kept::kAll, Kept::kFile}) {
    const SurfaceChange change = RunAll(mesh, {}, kept, stages);
    EXPECT_EQ(OfSelected(change.chart_ids, mesh), OfSelected(once.chart_ids, mesh));
    EXPECT_TRUE(OfSelected(change.wedge_texcoords, mesh) == OfSelected(once.wedge_texcoords, mesh));
  }
}

TEST(SelectedFaces, ThereMustBeSome) {
  SurfaceData mesh = HalfSelected();
  for (const bool known : {true, false}) {
    mesh.selected.assign(known ? mesh.faces.size() : 0, 0);
    try {
      OnSelected(FilterId::kSegment, mesh);
      FAIL() << "not refused";
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("no face is selected"), std::string::npos) << error.what();
    }
  }
}

TEST(SelectedFaces, AnEmptyMeshIsCalledThat) {
  try {
    OnSelected(FilterId::kSegment, {});
    FAIL() << "not refused";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("empty"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace dcharts
