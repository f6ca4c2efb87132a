// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "planar/edge_collapser.h"

namespace dcharts {

/// A surface cut into blocks of faces that follow each other, whose edges are collapsed without regard to the
/// other blocks: the vertices that a block shares with others stay as they are. Blocks may be used at the
/// same time, as they share nothing else.
class SurfaceBlocks {
 public:
  /// `faces`: those of the surface that are there, ascending. Both must outlive the blocks.
  SurfaceBlocks(const CollapseTask& surface, const std::vector<int>& faces, int count);

  /// Of all vertices, those that are in one block alone; others don't go.
  double ShareOfInner() const;

  /// A block as a surface of its own.
  CollapseTask Task(int block) const;

  /// What became of it is written to the surface. `heir`: per face of the surface, of those that are gone.
  void WriteBack(int block, const EdgeCollapser& done, CollapseTask& surface, std::vector<int>& heir) const;

  /// With the surface's numbers, as a run of the last phase.
  void AppendHistory(int block, const CollapseHistory& steps, CollapseHistory& all) const;

 private:
  int Begin(int block) const;
  int LocalHalfEdge(int block, int half_edge) const;  // -1 when its face is in another block
  int LocalVertex(int block, int vertex) const;

  const CollapseTask& surface_;
  const std::vector<int>& faces_;
  int count_;
  std::vector<int> place_;               // per face of the surface, in faces_
  std::vector<std::vector<int>> inner_;  // per block, the vertices that are only there, ascending
  std::vector<std::vector<int>> rim_;    // and those that others have too, numbered after them
  std::vector<int> number_;              // per vertex of the surface, in its block; kShared, kNone
};

}  // namespace dcharts
