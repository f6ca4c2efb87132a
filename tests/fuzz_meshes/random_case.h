// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>

#include "common/params.h"
#include "common/surface_data.h"
#include "filter_table.h"

namespace dcharts::fuzz {

/// What is run on the result of a filter besides the usual checks.
enum class Also {
  kNothing,
  kCancel,       ///< the filter is cancelled somewhere on its way
  kAgain,        ///< it is run again on one thread, and gives the same bytes
  kStageByStage  ///< the stages one by one give what Texture Atlas gives
};

struct RandomCase {
  const FilterSpec* filter = nullptr;
  Params params;
  SurfaceData mesh;
  Also also = Also::kNothing;
  int cancel_at = 0;           ///< the call that returns false
  std::string shape;           ///< what the mesh is
  std::string changed_params;  ///< those that are not at their default
};

/// The same seed and number give the same case.
RandomCase MakeRandomCase(std::uint64_t seed, std::uint64_t number);

}  // namespace dcharts::fuzz
