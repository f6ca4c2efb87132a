// SPDX-License-Identifier: GPL-3.0-or-later
/// Writes the reference of filters and parameters, Markdown: write_reference FILE.md
#include <fstream>
#include <iostream>
#include <string>

#include "filter_table.h"

namespace dcharts {

namespace {

// The little HTML of the help texts, as Markdown.
std::string Markdown(const std::string& html) {
  const std::pair<const char*, const char*> replacements[] = {
      {"<i>", "*"}, {"</i>", "*"}, {"<br>", " "}, {"|", "\\|"}};
  std::string text = html;
  for (const auto& [from, to] : replacements)
    for (std::size_t at = text.find(from); at != std::string::npos;
         at = text.find(from, at + std::string(to).size()))
      text.replace(at, std::string(from).size(), to);
  return text;
}

std::string MenuText(const FilterSpec& filter) {
  std::string text;
  const std::pair<unsigned, const char*> menus[] = {{kMenuTexture, "Texture"},
                                                    {kMenuFaceColoring, "Color Creation and Processing"},
                                                    {kMenuMeasure, "Quality Measure and Computations"}};
  for (const auto& [menu, name] : menus)
    if ((filter.menus & menu) != 0)
      text += (text.empty() ? "*Filters > " : ", *Filters > ") + std::string(name) + "*";
  return text;
}

std::string WritesText(const FilterSpec& filter) {
  std::string text;
  const std::pair<unsigned, const char*> attributes[] = {
      {kWritesQuality, "face quality (the chart's number)"},
      {kWritesColor, "face colour"},
      {kWritesTexcoords, "wedge texture coordinates"}};
  for (const auto& [attribute, name] : attributes)
    if ((filter.writes & attribute) != 0) text += (text.empty() ? "" : ", ") + std::string(name);
  return text.empty() ? "nothing" : text;
}

std::string DefaultText(const ParamSpec& param) {
  if (IsFile(param)) return "empty";
  if (IsEnum(param)) return "'" + ChoiceText(param, Params()) + "'";
  const double value = ValueOf(param, Params());
  if (std::holds_alternative<bool Params::*>(param.field)) return value != 0 ? "true" : "false";
  return NumberText(value);
}

void WriteFilter(const FilterSpec& filter, std::ostream& out) {
  out << "\n### " << filter.name << "\n\nPython: `MeshSet." << filter.python_name
      << "`. Menu: " << MenuText(filter) << ". Writes: " << WritesText(filter) << ".\n\n"
      << Markdown(HelpText(filter)) << "\n\nParameters: ";
  const char* separator = "";
  for (const ParamSpec* param : filter.params) {
    out << separator << "[`" << param->name << "`](#" << param->name << ")";
    separator = ", ";
  }
  out << (filter.params.empty() ? "none.\n" : ".\n");
}

void WriteParam(const ParamSpec& param, std::ostream& out) {
  out << "\n### " << param.name << "\n\n*" << param.label << "*: " << RangeText(param)
      << ". Default: " << DefaultText(param) << ".\n\n"
      << Markdown(param.tooltip) << "\n\nOf: ";
  const char* separator = "";
  for (const FilterSpec& filter : AllFilters())
    for (const ParamSpec* other : filter.params)
      if (std::string(other->name) == param.name) {
        out << separator << std::string(filter.name).substr(std::string("D-Charts: ").size());
        separator = ", ";
      }
  out << ".\n";
}

}  // namespace

}  // namespace dcharts

int main(int argc, char** argv) {
  using namespace dcharts;
  if (argc != 2) {
    std::cerr << "usage: write_reference FILE.md\n";
    return 2;
  }
  std::ofstream file(argv[1], std::ios::binary);
  file << "# Filters and parameters\n\n"
          "Made by `write_reference` from `filter_dcharts/filter_table.cpp`; a test keeps it current. The "
          "names are the\n"
          "same in MeshLab, in .mlx scripts (where a choice is its number, from 0) and in Python (where it "
          "is its text).\n"
          "`filters.json` has the same for programs.\n\n## Filters\n";
  for (const FilterSpec& filter : AllFilters()) WriteFilter(filter, file);
  file << "\n## Parameters\n";
  for (const ParamSpec& param : AllParams()) WriteParam(param, file);
  file.close();
  if (!file) {
    std::cerr << "could not write " << argv[1] << "\n";
    return 1;
  }
  return 0;
}
