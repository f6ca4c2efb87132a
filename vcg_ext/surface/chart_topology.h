// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "surface/charts.h"
#include "surface/surface_graph.h"

namespace dcharts {

/// What changes of charts do to their topology, at the cost of the faces that change. Keeps its arrays
/// between calls.
template <class MeshType>
class ChartTopology {
 public:
  explicit ChartTopology(const SurfaceGraph<MeshType>& surface)
      : surface_(surface), face_seen_(surface.FaceCount(), 0), vertex_seen_(surface.VertexCount(), 0) {}

  /// The part that `faces`, with their edges and vertices, have in the Euler characteristic of a chart's
  /// inside: faces - inner edges + inner vertices. Over the whole chart that is 1 for a disk, 0 for a ring;
  /// a change of the faces' charts changes it by as much as it changes this part.
  int EulerPart(const std::vector<int>& faces, int chart, const ChartIds& ids) {
    ++stamp_;
    int part = 0;
    for (int f : faces) face_seen_[f] = stamp_;
    for (int f : faces) {
      part += ids[f] == chart;
      for (int h = 3 * f; h < 3 * f + 3; ++h) {
        const int g = surface_.Neighbour(h), v = surface_.Vertex(h);
        const bool counted_there = g >= 0 && face_seen_[g] == stamp_ && g < f;
        if (g >= 0 && !counted_there && ids[f] == chart && ids[g] == chart) --part;
        if (vertex_seen_[v] == stamp_) continue;
        vertex_seen_[v] = stamp_;
        part += IsInside(v, chart, ids);
      }
    }
    return part;
  }

  /// True when the chart is one piece. `faces` holds all its `face_count` faces, and maybe others.
  bool IsConnected(int chart, const std::vector<int>& faces, int face_count, const ChartIds& ids) {
    ++stamp_;
    stack_.clear();
    for (int f : faces)
      if (ids[f] == chart) {
        stack_.push_back(f);
        break;
      }
    if (stack_.empty()) return false;
    face_seen_[stack_.back()] = stamp_;
    int reached = 0;
    while (!stack_.empty()) {
      const int f = stack_.back();
      stack_.pop_back();
      ++reached;
      for (int h = 3 * f; h < 3 * f + 3; ++h) {
        const int g = surface_.Neighbour(h);
        if (g < 0 || ids[g] != chart || face_seen_[g] == stamp_) continue;
        face_seen_[g] = stamp_;
        stack_.push_back(g);
      }
    }
    return reached == face_count;
  }

 private:
  bool IsInside(int vertex, int chart, const ChartIds& ids) const {
    for (const int* r = surface_.RingBegin(vertex); r != surface_.RingEnd(vertex); ++r)
      if (ids[*r / 3] != chart || surface_.Opposite(*r) < 0 || surface_.Opposite(Previous(*r)) < 0)
        return false;
    return true;
  }

  const SurfaceGraph<MeshType>& surface_;
  std::vector<int> face_seen_, vertex_seen_, stack_;
  int stamp_ = 0;
};

}  // namespace dcharts
