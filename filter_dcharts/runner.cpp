// SPDX-License-Identifier: GPL-3.0-or-later
#include "runner.h"

#include <charconv>
#include <chrono>
#include <cmath>
#include <locale>
#include <sstream>

#include "dcharts.h"
#include "pattern/drawing/flat_layer.h"
#include "pattern/drawing/write_pattern.h"
#include "surface/selected_faces.h"

namespace dcharts {

namespace {

std::string ValueText(const ParamSpec& spec, const Params& params) {
  const double value = ValueOf(spec, params);
  return std::isnan(value) ? "a value that is not a number" : NumberText(value);
}

bool InRange(const ParamSpec& spec, double value) {
  if (!std::isfinite(value)) return false;
  return (spec.min_exclusive ? value > spec.min : value >= spec.min) && value <= spec.max;
}

bool Has(const FilterSpec& filter, const std::string& name) {
  for (const ParamSpec* param : filter.params)
    if (param->name == name) return true;
  return false;
}

// The file is written last, so that a failure before leaves none.
SurfaceChange MakePatternLayerAndFile(const SurfaceData& mesh, const Params& params, Progress& progress) {
  PatternResult result = MakePattern(mesh, params, progress);
  SurfaceChange change;
  change.report = std::move(result.report);
  change.pieces = LayerOf(result.pattern);
  if (!params.output_file.empty())
    for (const std::string& line : WritePattern(result.pattern, mesh, params)) progress.Log(line);
  return change;
}

SurfaceChange Call(FilterId id, const SurfaceData& mesh, const Params& params, Progress& progress) {
  switch (id) {
    case FilterId::kSegment:
      return Segment(mesh, params, progress);
    case FilterId::kFill:
      return Fill(mesh, params, progress);
    case FilterId::kStraighten:
      return Straighten(mesh, params, progress);
    case FilterId::kMerge:
      return Merge(mesh, params, progress);
    case FilterId::kCut:
      return Cut(mesh, params, progress);
    case FilterId::kParameterize:
      return Parameterize(mesh, params, progress);
    case FilterId::kTextureAtlas:
      return TextureAtlas(mesh, params, progress);
    case FilterId::kPattern:
      return MakePatternLayerAndFile(mesh, params, progress);
    case FilterId::kMeasure:
      return Measure(mesh, params, progress);
  }
  throw Error("This filter is not known to D-Charts.");
}

std::string FigureText(const std::variant<int, double>& value) {
  return std::visit([](auto number) { return NumberText(number); }, value);
}

}  // namespace

void CheckParams(const FilterSpec& filter, const Params& params) {
  for (const ParamSpec* spec : filter.params) {
    if (IsFile(*spec) || InRange(*spec, ValueOf(*spec, params))) continue;
    throw Error(std::string(spec->name) + " must be " + RangeText(*spec) + "; you gave " +
                ValueText(*spec, params) + ".");
  }
  if (Has(filter, "output_file") && !params.output_file.empty()) CheckOutputFile(params.output_file);
  if (Has(filter, "padding") && params.padding > params.texture_size / 4)
    throw Error("padding must be at most a quarter of texture_size, here " +
                std::to_string(params.texture_size / 4) + "; you gave " + std::to_string(params.padding) +
                ".");
}

SurfaceChange RunFilter(const FilterSpec& filter, const SurfaceData* mesh, const Params& params,
                        Progress& progress) {
  return WithSentences([&] {
    CheckParams(filter, params);
    if (mesh == nullptr) throw Error("There is no mesh. Open or create one first.");
    const auto start = std::chrono::steady_clock::now();
    const auto stage = [&](const SurfaceData& data) { return Call(filter.id, data, params, progress); };
    SurfaceChange change = params.selected_only ? OnSelectedFaces(*mesh, stage) : stage(*mesh);
    change.report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return change;
  });
}

std::vector<Figure> Figures(const Report& report) {
  std::vector<Figure> figures;
  const auto add = [&figures](const char* name, const auto& figure) {
    if (figure) figures.emplace_back(name, *figure);
  };
  add("charts", report.charts);
  add("unassigned_faces", report.unassigned_faces);
  add("iterations", report.iterations);
  add("l2_stretch", report.l2_stretch);
  add("linf_stretch", report.linf_stretch);
  add("l2_shear", report.l2_shear);
  add("seam_length", report.seam_length);
  add("darts", report.darts);
  add("flipped_faces", report.flipped_faces);
  add("degenerate_faces", report.degenerate_faces);
  add("overlapping_faces", report.overlapping_faces);
  add("packing_efficiency", report.packing_efficiency);
  add("seconds", report.seconds);
  for (const auto& [stage, seconds] : report.stage_seconds) figures.emplace_back("seconds_" + stage, seconds);
  return figures;
}

std::vector<std::string> LogLines(const Report& report) {
  std::vector<std::string> lines;
  for (const auto& [name, value] : Figures(report)) lines.push_back(name + ": " + FigureText(value));
  return lines;
}

double FromHostFloat(float value) {
  if (!std::isfinite(value)) return value;
  char digits[32];
  const auto end =
      std::to_chars(digits, digits + sizeof digits, value).ptr;  // shortest text that reads back as value
  std::istringstream in(std::string(digits, end));
  in.imbue(std::locale::classic());
  double result = value;
  in >> result;
  return result;
}

}  // namespace dcharts
