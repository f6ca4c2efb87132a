// SPDX-License-Identifier: GPL-3.0-or-later
/// The one table of filters and their parameters. Adapters, help texts, example scripts and the Python
/// package are made from it. Knows nothing of a host.
#pragma once

#include <limits>
#include <string>
#include <variant>
#include <vector>

#include "common/params.h"

namespace dcharts {

/// One public parameter: where it lives in Params (its default is what a default-constructed Params holds),
/// its range and what a user is told about it.
struct ParamSpec {
  using Field = std::variant<int Params::*, double Params::*, bool Params::*, std::string Params::*,
                             StraightenMethod Params::*, MergeMethod Params::*, DartMethod Params::*,
                             FlattenMethod Params::*, DensityBy Params::*, PatternMaterial Params::*,
                             LengthUnit Params::*, PageFormat Params::*, Oversize Params::*>;

  const char* name;   ///< public name, snake_case, equal to the name of the field
  const char* label;  ///< shown beside the input in a dialog
  const char*
      tooltip;  ///< what it is, its unit, the effect of larger values, the meaning of 0; the range is added
  Field field;
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool min_exclusive = false;
  std::vector<const char*> choices = {};  ///< of an enum: what a user reads, in the order of its values
};

inline bool IsEnum(const ParamSpec& spec) { return !spec.choices.empty(); }

/// The name of a file to write.
inline bool IsFile(const ParamSpec& spec) {
  return std::holds_alternative<std::string Params::*>(spec.field);
}

enum class FilterId {
  kSegment,
  kFill,
  kStraighten,
  kMerge,
  kCut,
  kParameterize,
  kTextureAtlas,
  kPattern,
  kMeasure
};

/// What a filter may write to the user's mesh; bits to be or-ed.
enum Writes : unsigned {
  kWritesNothing = 0,
  kWritesQuality = 1,
  kWritesColor = 2,
  kWritesTexcoords = 4,
};

/// The menus that list a filter; bits to be or-ed.
enum Menus : unsigned {
  kMenuTexture = 1,
  kMenuFaceColoring = 2,
  kMenuMeasure = 4,
};

struct FilterSpec {
  FilterId id;
  const char* name;         ///< in menus and .mlx scripts; never renamed
  const char* python_name;  ///< the method of pymeshlab.MeshSet
  const char* summary;      ///< what it does, what it reads and writes; HTML
  const char* reference;    ///< section of the paper
  unsigned writes;
  unsigned menus;
  std::vector<const ParamSpec*> params;
};

/// Every parameter there is, in the order in which dialogs show them.
const std::vector<ParamSpec>& AllParams();

/// Every filter, in the order of its use.
const std::vector<FilterSpec>& AllFilters();

/// A detail of one stage in a filter that has the parameters of all: too many for a screen.
bool IsAdvanced(const FilterSpec& filter, const ParamSpec& param);

/// The filter with this id.
const FilterSpec& GetFilter(FilterId id);

/// A parameter's value as a double (a bool is 0 or 1, an enum the index of the choice). Not of a file.
double ValueOf(const ParamSpec& spec, const Params& params);
/// Sets it from such a number.
void SetValue(const ParamSpec& spec, double value, Params& params);

/// The choice of an enum parameter as a user reads it.
std::string ChoiceText(const ParamSpec& spec, const Params& params);

/// "0 or more", "above 0 and at most 4", "between 0 and 100", "true or false",
/// "'this' or 'that'".
std::string RangeText(const ParamSpec& spec);

/// The tooltip with range and default.
std::string TooltipText(const ParamSpec& spec);

/// The help of a filter in HTML: what it does, and the paper. Hosts put it on top of the filter's dialog, so
/// it is short: with the parameters in it, which have their tooltips, the Apply button would be below the
/// screen.
std::string HelpText(const FilterSpec& spec);

/// A number as a person writes it, in the C locale: "0.2", "1024".
std::string NumberText(double value);

}  // namespace dcharts
