// SPDX-License-Identifier: GPL-3.0-or-later
/// Writes the table of filters for programs (docstrings of the Python package, scripts/check_mlx.py):
/// write_python_texts FILE.json
#include <cmath>
#include <fstream>
#include <iostream>
#include <string>

#include "filter_table.h"

namespace dcharts {

namespace {

std::string Quote(const std::string& text) {
  std::string quoted = "\"";
  for (char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + "\"";
}

std::string ParamObject(const ParamSpec& spec) {
  if (IsFile(spec))
    return "{\"name\": " + Quote(spec.name) +
           ", \"type\": \"str\", \"default\": \"\", \"text\": " + Quote(TooltipText(spec)) + "}";
  const double number = ValueOf(spec, Params());
  std::string type = "float", value = NumberText(number);
  if (std::holds_alternative<int Params::*>(spec.field)) type = "int";
  if (std::holds_alternative<bool Params::*>(spec.field)) {
    type = "bool";
    value = number != 0 ? "true" : "false";
  }
  if (IsEnum(spec)) {
    type = "str";
    value = Quote(ChoiceText(spec, Params()));
  }
  std::string range;
  if (IsEnum(spec)) {
    for (const char* choice : spec.choices) range += (range.empty() ? "" : ", ") + Quote(choice);
    range = ", \"options\": [" + range + "]";
  } else if (type != "bool") {
    if (std::isfinite(spec.min))
      range += std::string(", \"") + (spec.min_exclusive ? "above" : "min") + "\": " + NumberText(spec.min);
    if (std::isfinite(spec.max)) range += ", \"max\": " + NumberText(spec.max);
  }
  return "{\"name\": " + Quote(spec.name) + ", \"type\": " + Quote(type) + ", \"default\": " + value + range +
         ", \"text\": " + Quote(TooltipText(spec)) + "}";
}

std::string FilterObject(const FilterSpec& filter) {
  std::string text = "{\"name\": " + Quote(filter.python_name) + ", \"menu_name\": " + Quote(filter.name) +
                     ", \"text\": " + Quote(filter.summary) + ", \"parameters\": [";
  for (std::size_t i = 0; i < filter.params.size(); ++i)
    text += (i == 0 ? "\n  " : ",\n  ") + ParamObject(*filter.params[i]);
  return text + "]}";
}

}  // namespace

}  // namespace dcharts

int main(int argc, char** argv) {
  using namespace dcharts;
  if (argc != 2) {
    std::cerr << "usage: write_python_texts FILE.json\n";
    return 2;
  }
  std::ofstream file(argv[1], std::ios::binary);
  const char* separator = "[\n";
  for (const FilterSpec& filter : AllFilters()) {
    file << separator << FilterObject(filter);
    separator = ",\n";
  }
  file << "\n]\n";
  file.close();
  if (!file) {
    std::cerr << "could not write " << argv[1] << "\n";
    return 1;
  }
  return 0;
}
