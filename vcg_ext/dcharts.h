// SPDX-License-Identifier: GPL-3.0-or-later
/// D-Charts: quasi-developable mesh segmentation (D. Julius, V. Kraevoy, A. Sheffer, Eurographics 2005).
/// The pipeline's stages as functions of a mesh and what the stage before wrote; none keeps state in between.
#pragma once

#include "common/errors.h"
#include "common/params.h"
#include "common/progress.h"
#include "common/surface_data.h"

namespace dcharts {

struct PatternResult;  // pattern/pattern.h

/// Each returns what is to be written back. All throw Error (refused input, with a sentence for the user) and
/// Cancelled; the input is never touched. `params` are taken to be in range.
SurfaceChange Segment(const SurfaceData& mesh, const Params& params, Progress& progress);       // 3.1
SurfaceChange Fill(const SurfaceData& mesh, const Params& params, Progress& progress);          // 3.2
SurfaceChange Straighten(const SurfaceData& mesh, const Params& params, Progress& progress);    // 3.3
SurfaceChange Merge(const SurfaceData& mesh, const Params& params, Progress& progress);         // 3.3
SurfaceChange Cut(const SurfaceData& mesh, const Params& params, Progress& progress);           // 3.3
SurfaceChange Parameterize(const SurfaceData& mesh, const Params& params, Progress& progress);  // 2, 4, 5
SurfaceChange TextureAtlas(const SurfaceData& mesh, const Params& params,
                           Progress& progress);                                            // all of the above
SurfaceChange Measure(const SurfaceData& mesh, const Params& params, Progress& progress);  // figures only

/// A pattern to sew or to fold (Section 4), from the segmentation on; writes no file.
PatternResult MakePattern(const SurfaceData& mesh, const Params& params, Progress& progress);

}  // namespace dcharts
