// SPDX-License-Identifier: GPL-3.0-or-later
#include "runner.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace dcharts {
namespace {

const double kNan = std::numeric_limits<double>::quiet_NaN();
const double kInfinity = std::numeric_limits<double>::infinity();

// The sentence that `work` throws; empty when it throws none.
template <class Work>
std::string Sentence(Work work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

std::string CheckSentence(FilterId id, const Params& params) {
  return Sentence([&] { CheckParams(GetFilter(id), params); });
}

std::string RunSentence(FilterId id, const SurfaceData* mesh, const Params& params = {}) {
  Progress progress;
  return Sentence([&] { RunFilter(GetFilter(id), mesh, params, progress); });
}

// A value just outside the range, on the given side; NaN where there is no bound.
double Outside(const ParamSpec& spec, bool above) {
  if (above) return spec.max + 1;
  return spec.min_exclusive ? spec.min : spec.min - 1;
}

Params With(const ParamSpec& spec, double value) {
  Params params;
  SetValue(spec, value, params);
  return params;
}

// Two triangles that make a square.
SurfaceData Square() {
  SurfaceData mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.faces = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

TEST(Runner, DefaultsAreAccepted) {
  for (const FilterSpec& filter : AllFilters()) EXPECT_NO_THROW(CheckParams(filter, Params())) << filter.name;
}

TEST(Runner, EveryParameterOutOfRangeIsRefusedWithItsNameAndRange) {
  for (const FilterSpec& filter : AllFilters())
    for (const ParamSpec* spec : filter.params) {
      if (std::holds_alternative<bool Params::*>(spec->field) || IsFile(*spec)) continue;
      for (bool above : {false, true}) {
        const double value = Outside(*spec, above);
        if (!std::isfinite(value)) continue;
        const std::string sentence = Sentence([&] { CheckParams(filter, With(*spec, value)); });
        EXPECT_EQ(sentence.rfind(std::string(spec->name) + " must be " + RangeText(*spec), 0), 0u)
            << filter.name << ", " << spec->name << " = " << value << ": " << sentence;
      }
    }
}

TEST(Runner, SaysWhatWasGiven) {
  Params params;
  params.chart_count = -3;
  EXPECT_EQ(CheckSentence(FilterId::kSegment, params), "chart_count must be 0 or more; you gave -3.");
  params = Params();
  params.max_fitting_error = 0;
  EXPECT_EQ(CheckSentence(FilterId::kStraighten, params),
            "max_fitting_error must be above 0 and at most 4; you gave 0.");
}

TEST(Runner, RefusesNumbersThatAreNone) {
  for (const ParamSpec& spec : AllParams()) {
    if (!std::holds_alternative<double Params::*>(spec.field)) continue;
    for (double value : {kNan, kInfinity, -kInfinity})
      EXPECT_TRUE(CheckSentence(FilterId::kTextureAtlas, With(spec, value)) != "" ||
                  CheckSentence(FilterId::kPattern, With(spec, value)) != "")
          << spec.name << " = " << value;
  }
}

TEST(Runner, PaddingIsAtMostAQuarterOfTheTexture) {
  Params params;
  params.texture_size = 64;
  params.padding = 16;
  EXPECT_EQ(CheckSentence(FilterId::kParameterize, params), "");
  params.padding = 17;
  EXPECT_EQ(CheckSentence(FilterId::kParameterize, params),
            "padding must be at most a quarter of texture_size, here 16; you gave 17.");
}

TEST(Runner, AFileToWriteMustHaveAKnownEndingAndAFolder) {
  Params params;
  params.output_file = "pattern.txt";
  EXPECT_EQ(CheckSentence(FilterId::kPattern, params),
            "output_file must end in .svg, .pdf or .dxf; you gave 'pattern.txt'.");
  params.output_file = "no such folder/pattern.svg";
  EXPECT_EQ(CheckSentence(FilterId::kPattern, params),
            "output_file is in a folder that does not exist: 'no such folder'.");
  for (const char* name : {"", "pattern.svg", "pattern.PDF", "my.pattern.dxf"}) {
    params.output_file = name;
    EXPECT_EQ(CheckSentence(FilterId::kPattern, params), "") << name;
  }
}

TEST(Runner, AFilterIgnoresParametersItDoesNotHave) {
  Params params;
  params.chart_count = -3;
  EXPECT_EQ(CheckSentence(FilterId::kMerge, params), "");
}

TEST(Runner, RefusesNoMeshNoFacesAndNothingAtAll) {
  SurfaceData empty, points;
  points.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  for (const FilterSpec& filter : AllFilters()) {
    EXPECT_NE(RunSentence(filter.id, nullptr).find("no mesh"), std::string::npos) << filter.name;
    EXPECT_NE(RunSentence(filter.id, &empty).find("empty"), std::string::npos) << filter.name;
    EXPECT_NE(RunSentence(filter.id, &points).find("Surface Reconstruction: Ball Pivoting"),
              std::string::npos)
        << filter.name;
  }
}

TEST(Runner, RunsAFilterAndMeasuresItsSeconds) {
  const SurfaceData mesh = Square();
  Progress progress;
  const SurfaceChange change = RunFilter(GetFilter(FilterId::kTextureAtlas), &mesh, Params(), progress);
  EXPECT_EQ(change.chart_ids.size(), mesh.faces.size());
  EXPECT_EQ(change.wedge_texcoords.size(), mesh.faces.size());
  ASSERT_TRUE(change.report.seconds.has_value());
  EXPECT_GE(*change.report.seconds, 0);
}

TEST(Runner, APatternLogsEachThingOnce) {
  // A strip beside a square: narrower than the allowance, so there is a warning too.
  SurfaceData mesh = Square();
  mesh.vertices.insert(mesh.vertices.end(), {{3, 0, 0}, {3.04, 0, 0}, {3.04, 1, 0}});
  mesh.faces.push_back({4, 5, 6});
  Params params;
  params.size = 200;
  std::vector<std::string> log;
  Progress progress({}, [&](const std::string& line) { log.push_back(line); });
  RunFilter(GetFilter(FilterId::kPattern), &mesh, params, progress);
  std::sort(log.begin(), log.end());
  EXPECT_EQ(std::adjacent_find(log.begin(), log.end()), log.end());
  int points = 0, narrow = 0;
  for (const std::string& line : log) {
    points += line.find("oints") != std::string::npos;
    narrow += line.find("Narrower than the seam allowance") != std::string::npos;
  }
  EXPECT_EQ(points, 1);
  EXPECT_EQ(narrow, 1);
}

TEST(Runner, ACallbackThatReturnsFalseCancels) {
  const SurfaceData mesh = Square();
  Progress progress([](int, const char*) { return false; });
  EXPECT_THROW(RunFilter(GetFilter(FilterId::kTextureAtlas), &mesh, Params(), progress), Cancelled);
}

TEST(Runner, EveryExceptionBecomesASentence) {
  EXPECT_NE(Sentence([] { WithSentences([]() -> int { throw std::bad_alloc(); }); }).find("memory"),
            std::string::npos);
  EXPECT_NE(Sentence([] {
              WithSentences([]() -> int { throw std::runtime_error("the reason"); });
            }).find("the reason"),
            std::string::npos);
  EXPECT_NE(Sentence([] { WithSentences([]() -> int { throw 5; }); }), "");
  EXPECT_EQ(Sentence([] { WithSentences([]() -> int { throw Error("Said already."); }); }), "Said already.");
  EXPECT_THROW(WithSentences([]() -> int { throw Cancelled(); }), Cancelled);
  EXPECT_EQ(WithSentences([] { return 7; }), 7);
}

TEST(Runner, ReportsTheFiguresThatAreKnown) {
  Report report;
  EXPECT_TRUE(Figures(report).empty());
  report.charts = 12;
  report.l2_stretch = 1.0025;
  report.linf_stretch = kInfinity;
  report.stage_seconds = {{"fill", 0.25}};
  const std::vector<Figure> expected = {
      {"charts", 12}, {"l2_stretch", 1.0025}, {"linf_stretch", kInfinity}, {"seconds_fill", 0.25}};
  EXPECT_EQ(Figures(report), expected);
  const std::vector<std::string> lines = {"charts: 12", "l2_stretch: 1.0025", "linf_stretch: inf",
                                          "seconds_fill: 0.25"};
  EXPECT_EQ(LogLines(report), lines);
}

TEST(Runner, ReportsEveryFigureOfAFullReport) {
  Report report;
  report.charts = report.unassigned_faces = report.iterations = report.darts = 1;
  report.flipped_faces = report.overlapping_faces = 1;
  report.l2_stretch = report.linf_stretch = report.l2_shear = report.seam_length = 1.;
  report.packing_efficiency = report.seconds = 1.;
  std::vector<std::string> names;
  for (const Figure& figure : Figures(report)) names.push_back(figure.first);
  const std::vector<std::string> expected = {
      "charts",        "unassigned_faces",  "iterations",         "l2_stretch",
      "linf_stretch",  "l2_shear",          "seam_length",        "darts",
      "flipped_faces", "overlapping_faces", "packing_efficiency", "seconds"};
  EXPECT_EQ(names, expected);
}

TEST(Runner, AFloatFromAHostMeansTheNumberAPersonWrote) {
  for (double number : {0.2, 0.7, 1e-5, 0.01, 50.0, 1.01, 0.0, -3.5, 12345.678, 1e30}) {
    EXPECT_EQ(FromHostFloat(static_cast<float>(number)), number);
  }
  EXPECT_TRUE(std::isnan(FromHostFloat(static_cast<float>(kNan))));
  EXPECT_EQ(FromHostFloat(static_cast<float>(kInfinity)), kInfinity);
}

}  // namespace
}  // namespace dcharts
