// SPDX-License-Identifier: GPL-3.0-or-later
/// Stages run one after the other, as a host does it.
#pragma once

#include <functional>
#include <vector>

#include "dcharts.h"

namespace dcharts::test {

/// What is left of a mesh between two stages.
enum class Kept {
  kAll,        ///< a session: the seams' attribute too
  kFile,       ///< a PLY file: face quality and wedge texcoords
  kChartsOnly  ///< face quality only
};

/// A host writes what a stage wants written.
inline void Write(const SurfaceChange& change, Kept kept, SurfaceData& mesh) {
  const size_t count = mesh.faces.size();
  mesh.face_quality.resize(count, 0);
  if (!change.wedge_texcoords.empty()) {
    mesh.wedge_texcoords.resize(count);
    mesh.wedge_texture_index.resize(count, 0);
  }
  if (change.remove_seams) mesh.seams.clear();
  const bool keeps_seams = !change.seams.empty() && kept == Kept::kAll;
  if (keeps_seams) mesh.seams.resize(count, 0);
  for (size_t f = 0; f < count; ++f) {
    if (!change.written.empty() && change.written[f] == 0) continue;
    mesh.face_quality[f] = change.chart_ids[f];
    if (!change.wedge_texcoords.empty()) {
      mesh.wedge_texcoords[f] = change.wedge_texcoords[f];
      mesh.wedge_texture_index[f] = 0;
    }
    if (keeps_seams) mesh.seams[f] = change.seams[f];
  }
}

using Stage = std::function<SurfaceChange(const SurfaceData&, const Params&, Progress&)>;

/// Returns the last one's change.
inline SurfaceChange RunAll(SurfaceData mesh, const Params& params, Kept kept,
                            const std::vector<Stage>& stages) {
  SurfaceChange change;
  for (const Stage& stage : stages) {
    Progress progress;
    change = stage(mesh, params, progress);
    Write(change, kept, mesh);
  }
  return change;
}

inline const std::vector<Stage> kAllStages{Segment, Fill, Straighten, Merge, Cut, Parameterize};

}  // namespace dcharts::test
