// SPDX-License-Identifier: GPL-3.0-or-later
/// Writes the example filter scripts from the table of filters: write_examples FOLDER
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include "filter_table.h"

namespace dcharts {

namespace {

// The settings of the paper's examples, whatever our defaults are: section 2.1.2 (weights), 3.1 (k = 10, 5 %,
// fewer than 100 iterations), 3.3 (eta of the free-form models) and table 1 (F_max).
Params PaperParams() {
  Params params;
  params.max_fitting_error = 0.2;
  params.fitting_weight = 1;
  params.compactness_weight = 0.7;
  params.straightness_weight = 0.5;
  params.max_iterations = 100;
  params.reassigned_percent = 5;
  params.seed_candidates = 10;
  params.seed_percent = 0;
  params.target_charts = 0;
  params.max_stretch = 0;
  params.straighten_by = StraightenMethod::kShortestPath;
  params.merge_by = MergeMethod::kBoundaryRegion;
  params.merge_threshold = 0.01;
  params.dart_by = DartMethod::kFittingError;
  params.method = FlattenMethod::kStretchMinimizing;
  return params;
}

// A stuffed toy of 30 cm, on pages to print.
Params PatternParams() {
  Params params;
  params.size = 300;
  params.page = PageFormat::kA4;
  params.output_file = "pattern.pdf";
  return params;
}

std::string Escape(const std::string& text) {
  std::string escaped;
  for (char c : text) {
    if (c == '&')
      escaped += "&amp;";
    else if (c == '<')
      escaped += "&lt;";
    else if (c == '>')
      escaped += "&gt;";
    else if (c == '"')
      escaped += "&quot;";
    else
      escaped += c;
  }
  return escaped;
}

std::string ParamElement(const ParamSpec& spec, const Params& params) {
  if (IsFile(spec))
    return "  <Param name=\"" + std::string(spec.name) + "\" type=\"RichSaveFile\" value=\"" +
           Escape(params.output_file) + "\" ext=\"SVG, PDF, DXF (*.svg *.pdf *.dxf)\" description=\"" +
           Escape(spec.label) + "\" tooltip=\"" + Escape(TooltipText(spec)) + "\"/>\n";
  const double number = ValueOf(spec, params);
  std::string type = "RichFloat", value = NumberText(number);
  if (std::holds_alternative<int Params::*>(spec.field)) type = "RichInt";
  if (std::holds_alternative<bool Params::*>(spec.field)) {
    type = "RichBool";
    value = number != 0 ? "true" : "false";
  }
  std::string choices;
  if (IsEnum(spec)) {
    type = "RichEnum";
    for (std::size_t i = 0; i < spec.choices.size(); ++i)
      choices += " enum_val" + std::to_string(i) + "=\"" + Escape(spec.choices[i]) + "\"";
    choices += " enum_cardinality=\"" + std::to_string(spec.choices.size()) + "\"";
  }
  return "  <Param name=\"" + std::string(spec.name) + "\" type=\"" + type + "\" value=\"" + value +
         "\" description=\"" + Escape(spec.label) + "\" tooltip=\"" + Escape(TooltipText(spec)) + "\"" +
         choices + "/>\n";
}

// MeshLab 2020.09 needs every parameter of a filter.
std::string Script(const std::vector<FilterId>& filters, const Params& params) {
  std::string text = "<!DOCTYPE FilterScript>\n<FilterScript>\n";
  for (FilterId id : filters) {
    const FilterSpec& filter = GetFilter(id);
    text += " <filter name=\"" + Escape(filter.name) + "\">\n";
    for (const ParamSpec* param : filter.params) text += ParamElement(*param, params);
    text += " </filter>\n";
  }
  return text + "</FilterScript>\n";
}

bool WriteFile(const std::string& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file) std::cerr << "could not write " << path << "\n";
  return static_cast<bool>(file);
}

}  // namespace

}  // namespace dcharts

int main(int argc, char** argv) {
  using namespace dcharts;
  if (argc != 2) {
    std::cerr << "usage: write_examples FOLDER\n";
    return 2;
  }
  const std::string folder = argv[1];
  const std::vector<FilterId> stages = {FilterId::kSegment, FilterId::kFill, FilterId::kStraighten,
                                        FilterId::kMerge,   FilterId::kCut,  FilterId::kParameterize};
  const bool ok = WriteFile(folder + "/texture_atlas.mlx", Script({FilterId::kTextureAtlas}, Params())) &&
                  WriteFile(folder + "/stages.mlx", Script(stages, Params())) &&
                  WriteFile(folder + "/paper.mlx", Script({FilterId::kTextureAtlas}, PaperParams())) &&
                  WriteFile(folder + "/pattern.mlx", Script({FilterId::kPattern}, PatternParams()));
  return ok ? 0 : 1;
}
