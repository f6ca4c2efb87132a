// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_table.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <regex>
#include <set>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace dcharts {
namespace {

// The number of fields of an aggregate: the largest number of initializers that it takes.
struct Anything {
  template <class T, std::enable_if_t<std::is_arithmetic_v<T> || std::is_enum_v<T>, int> = 0>
  operator T() const;
  operator std::string() const;
};
template <class T, class Indices, class = void>
struct TakesInitializers : std::false_type {};
template <class T, std::size_t... I>
struct TakesInitializers<T, std::index_sequence<I...>, std::void_t<decltype(T{(void(I), Anything())...})>>
    : std::true_type {};
template <class T, std::size_t N = 64>
constexpr std::size_t FieldCount() {
  if constexpr (TakesInitializers<T, std::make_index_sequence<N>>::value)
    return N;
  else
    return FieldCount<T, N - 1>();
}

std::vector<std::string> NamesOf(FilterId id) {
  std::vector<std::string> names;
  for (const ParamSpec* param : GetFilter(id).params) names.push_back(param->name);
  return names;
}

TEST(FilterTable, HoldsEveryFieldOfParamsOnce) {
  EXPECT_EQ(AllParams().size(), FieldCount<Params>());
  for (const ParamSpec& a : AllParams())
    for (const ParamSpec& b : AllParams()) {
      if (&a == &b) continue;
      EXPECT_STRNE(a.name, b.name);
      EXPECT_NE(a.field, b.field) << a.name << " and " << b.name;
    }
}

TEST(FilterTable, DefaultsAreInRange) {
  for (const ParamSpec& spec : AllParams()) {
    if (IsFile(spec)) continue;
    const double value = ValueOf(spec, Params());
    if (spec.min_exclusive)
      EXPECT_GT(value, spec.min) << spec.name;
    else
      EXPECT_GE(value, spec.min) << spec.name;
    EXPECT_LE(value, spec.max) << spec.name;
  }
  EXPECT_LE(Params().padding, Params().texture_size / 4);
}

TEST(FilterTable, EnumsHaveAChoiceForEachValueInTheirRange) {
  for (const ParamSpec& spec : AllParams()) {
    const bool is_enum = !std::holds_alternative<int Params::*>(spec.field) &&
                         !std::holds_alternative<double Params::*>(spec.field) &&
                         !std::holds_alternative<bool Params::*>(spec.field) && !IsFile(spec);
    EXPECT_EQ(IsEnum(spec), is_enum) << spec.name;
    if (!IsEnum(spec)) continue;
    EXPECT_GE(spec.choices.size(), 2u) << spec.name;
    EXPECT_EQ(spec.min, 0) << spec.name;
    EXPECT_EQ(spec.max, static_cast<double>(spec.choices.size() - 1)) << spec.name;
    EXPECT_EQ(ChoiceText(spec, Params()), spec.choices[0]) << spec.name;
  }
}

TEST(FilterTable, ValuesAreSetAsTheyAreRead) {
  for (const ParamSpec& spec : AllParams()) {
    if (IsFile(spec)) continue;
    Params params;
    for (double value : {1.0, 0.0}) {
      SetValue(spec, value, params);
      EXPECT_EQ(ValueOf(spec, params), value) << spec.name;
    }
  }
}

TEST(FilterTable, NamesAreSnakeCase) {
  const std::regex snake_case("[a-z]+(_[a-z]+)*");
  for (const ParamSpec& spec : AllParams()) EXPECT_TRUE(std::regex_match(spec.name, snake_case)) << spec.name;
  for (const FilterSpec& filter : AllFilters()) {
    EXPECT_TRUE(std::regex_match(filter.python_name, snake_case)) << filter.python_name;
    EXPECT_EQ(std::string(filter.name).rfind("D-Charts: ", 0), 0u) << filter.name;
  }
}

TEST(FilterTable, FiltersHaveDifferentNames) {
  std::set<std::string> names, python_names;
  for (const FilterSpec& filter : AllFilters()) {
    names.insert(filter.name);
    python_names.insert(filter.python_name);
    EXPECT_EQ(&GetFilter(filter.id), &filter);
  }
  EXPECT_EQ(names.size(), AllFilters().size());
  EXPECT_EQ(python_names.size(), AllFilters().size());
}

// Scripts have these names: they never change.
TEST(FilterTable, ThePublicNames) {
  std::set<std::string> names;
  for (const FilterSpec& filter : AllFilters())
    names.insert(std::string(filter.name) + ", " + filter.python_name);
  EXPECT_EQ(names, (std::set<std::string>{
                       "D-Charts: Segment, dcharts_segment", "D-Charts: Fill, dcharts_fill",
                       "D-Charts: Straighten, dcharts_straighten", "D-Charts: Merge, dcharts_merge",
                       "D-Charts: Cut, dcharts_cut", "D-Charts: Parameterize, dcharts_parameterize",
                       "D-Charts: Texture Atlas, dcharts_texture_atlas", "D-Charts: Pattern, dcharts_pattern",
                       "D-Charts: Measure, dcharts_measure"}));
}

TEST(FilterTable, HelpSaysWhatItDoesAndNamesThePaperAndIsShort) {
  for (const FilterSpec& filter : AllFilters()) {
    const std::string help = HelpText(filter);
    EXPECT_EQ(help.find(filter.summary), 0u) << filter.name;
    EXPECT_NE(help.find("<i>Dan Julius"), std::string::npos) << filter.name;
    EXPECT_NE(help.find("Section"), std::string::npos) << filter.name;
    EXPECT_LT(help.size(), 1000u) << filter.name << ": it would fill the dialog";
  }
}

TEST(FilterTable, TooltipsHaveTextRangeAndDefault) {
  for (const ParamSpec& spec : AllParams()) {
    const std::string text = TooltipText(spec);
    EXPECT_EQ(text.find(spec.tooltip), 0u) << spec.name;
    EXPECT_NE(text.find("Default: "), std::string::npos) << spec.name;
    if (std::holds_alternative<bool Params::*>(spec.field)) continue;
    EXPECT_NE(text.find(RangeText(spec)), std::string::npos) << spec.name;
  }
}

TEST(FilterTable, TooltipsSayWhatZeroMeans) {
  for (const ParamSpec& spec : AllParams()) {
    if (std::holds_alternative<bool Params::*>(spec.field) || IsEnum(spec) || IsFile(spec) || spec.min > 0 ||
        spec.min_exclusive)
      continue;
    EXPECT_TRUE(std::regex_search(spec.tooltip, std::regex("(^|[ ;.])0 "))) << spec.name;
  }
}

TEST(FilterTable, TooltipsDiffer) {
  std::set<std::string> tooltips;
  for (const ParamSpec& spec : AllParams()) tooltips.insert(spec.tooltip);
  EXPECT_EQ(tooltips.size(), AllParams().size());
}

TEST(FilterTable, TextureAtlasHasTheParametersOfItsStages) {
  std::set<std::string> of_stages;
  for (FilterId id : {FilterId::kSegment, FilterId::kFill, FilterId::kStraighten, FilterId::kMerge,
                      FilterId::kCut, FilterId::kParameterize})
    for (const std::string& name : NamesOf(id)) of_stages.insert(name);
  const std::vector<std::string> of_atlas = NamesOf(FilterId::kTextureAtlas);
  EXPECT_EQ(std::set<std::string>(of_atlas.begin(), of_atlas.end()), of_stages);
  EXPECT_EQ(of_atlas.size(), of_stages.size());
}

TEST(FilterTable, EveryFilterButMeasureHasAParameterAndEveryParameterAFilter) {
  std::set<std::string> offered;
  for (const FilterSpec& filter : AllFilters()) {
    EXPECT_EQ(filter.params.empty(), filter.id == FilterId::kMeasure) << filter.name;
    for (const ParamSpec* param : filter.params) offered.insert(param->name);
  }
  EXPECT_EQ(offered.size(), AllParams().size());
}

// MeshLab 2020.09 has no place to fold parameters away: no dialog may be taller than that of Texture Atlas.
TEST(FilterTable, PatternFitsTheScreen) {
  const FilterSpec& pattern = GetFilter(FilterId::kPattern);
  EXPECT_LE(pattern.params.size(), NamesOf(FilterId::kTextureAtlas).size());
  const auto shown = std::count_if(pattern.params.begin(), pattern.params.end(),
                                   [&](const ParamSpec* param) { return !IsAdvanced(pattern, *param); });
  EXPECT_LE(shown, 14);
}

TEST(FilterTable, MeasureHasNoParametersAndWritesNothing) {
  EXPECT_TRUE(GetFilter(FilterId::kMeasure).params.empty());
  EXPECT_EQ(GetFilter(FilterId::kMeasure).writes, unsigned{kWritesNothing});
}

TEST(FilterTable, RangesReadAsAPersonWritesThem) {
  const auto range = [](const std::string& name) {
    for (const ParamSpec& spec : AllParams())
      if (name == spec.name) return RangeText(spec);
    return std::string();
  };
  EXPECT_EQ(range("chart_count"), "0 or more");
  EXPECT_EQ(range("max_fitting_error"), "above 0 and at most 4");
  EXPECT_EQ(range("reassigned_percent"), "between 0 and 100");
  EXPECT_EQ(range("rotate"), "true or false");
  EXPECT_EQ(range("output_file"), "a name that ends in .svg, .pdf or .dxf, or empty");
  EXPECT_EQ(range("method"), "'Stretch-minimizing' or 'Conformal (ABF++)'");
}

}  // namespace
}  // namespace dcharts
