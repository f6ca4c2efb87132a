// SPDX-License-Identifier: GPL-3.0-or-later
/// Runs a filter of the table on plain arrays. Knows nothing of a host.
#pragma once

#include <exception>
#include <new>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "common/errors.h"
#include "common/progress.h"
#include "common/surface_data.h"
#include "filter_table.h"

namespace dcharts {

/// Throws Error with a sentence when a parameter of the filter is out of its range or not a number.
void CheckParams(const FilterSpec& filter, const Params& params);

/// Checks parameters and mesh, runs the filter and measures its seconds. `mesh` may be null: no mesh is
/// loaded. Throws Error and Cancelled, nothing else; the mesh is never touched.
SurfaceChange RunFilter(const FilterSpec& filter, const SurfaceData* mesh, const Params& params,
                        Progress& progress);

/// A figure under its public name.
using Figure = std::pair<std::string, std::variant<int, double>>;

/// The figures that the report knows, the seconds of a stage as seconds_STAGE.
std::vector<Figure> Figures(const Report& report);

/// The figures as lines for the log.
std::vector<std::string> LogLines(const Report& report);

/// The double that is written the way the float is: hosts hand over 0.2 as a float, which is 0.2000000030 as
/// a double. With this, a number means the same in every host and in the code.
double FromHostFloat(float value);

/// Calls `work` and turns whatever it throws into an Error with a sentence, so that no other exception
/// reaches a host.
template <class Work>
auto WithSentences(Work&& work) -> decltype(work()) {
  try {
    return std::forward<Work>(work)();
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw Error(
        "The computer has not enough free memory for this mesh. The mesh was not changed. Simplify it, for "
        "example "
        "with 'Simplification: Quadric Edge Collapse Decimation', or close other programs.");
  } catch (const std::exception& error) {
    throw Error(std::string("D-Charts ran into an error of its own: ") + error.what() +
                ". The mesh was not changed. Please report it with the mesh.");
  } catch (...) {
    throw Error(
        "D-Charts ran into an unknown error of its own. The mesh was not changed. Please report it with the "
        "mesh.");
  }
}

}  // namespace dcharts
