// SPDX-License-Identifier: GPL-3.0-or-later
/// What is promised of each filter's result. Every function returns what is wrong, a line each; empty when
/// all is well.
#pragma once

#include <string>

#include "common/params.h"
#include "common/surface_data.h"
#include "filter_table.h"
#include "pattern/pattern.h"

namespace dcharts::fuzz {

/// Must every stage take this mesh? False when one of the reasons to refuse is there, or nearly.
bool IsTakeable(const SurfaceData& mesh);

/// Of all filters but Pattern.
std::string WrongInChange(const FilterSpec& filter, const SurfaceData& mesh, const Params& params,
                          const SurfaceChange& change);

/// The same of a filter that worked on the selected faces alone.
std::string WrongInSelection(const FilterSpec& filter, const SurfaceData& mesh, const Params& params,
                             const SurfaceChange& change);

std::string WrongInPattern(const SurfaceData& mesh, const PatternResult& result);

/// A sentence for the user, and not about an error in the program.
std::string WrongInSentence(const std::string& sentence);

/// The same bytes in all arrays.
bool SameBytes(const SurfaceData& a, const SurfaceData& b);
bool SameBytes(const SurfaceChange& a, const SurfaceChange& b);  // without seconds

}  // namespace dcharts::fuzz
