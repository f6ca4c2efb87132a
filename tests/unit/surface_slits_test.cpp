// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/slits.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "planar/overlap.h"
#include "surface_fixture.h"

namespace dcharts {
namespace {

using test::TestSurface;

struct Slit {
  ChartPatch patch;
  std::vector<int> twin;
  Points2 uv;
};

// A flat sheet cut along x = 1/2 up to y = `to`, laid flat as it is.
Slit MakeSlit(double to) {
  const TestSurface surface(shapes::Grid(8, 8));
  SeamMask seams(surface->FaceCount(), 0);
  for (int h = 0; h < surface->HalfEdgeCount(); ++h) {
    const auto &a = surface.InputPosition(surface->Vertex(h)),
               &b = surface.InputPosition(surface->Vertex(Next(h)));
    if (surface->Opposite(h) >= 0 && std::abs(a[0] - 0.5) < 1e-9 && std::abs(b[0] - 0.5) < 1e-9 &&
        std::max(a[1], b[1]) < to + 1e-9)
      SetSeam(seams, h);
  }
  Slit slit;
  slit.patch = surface.Patch(ChartIds(surface->FaceCount(), 0), seams, 0);
  slit.twin.resize(slit.patch.VertexCount());
  for (int h = 0; h < slit.patch.HalfEdgeCount(); ++h)
    slit.twin[slit.patch.Vertex(h)] = surface->Vertex(slit.patch.SurfaceHalfEdge(h));
  slit.uv = slit.patch.mesh.positions.leftCols(2);
  return slit;
}

TEST(Slits, SidesMoveApart) {
  const Slit slit = MakeSlit(0.5);
  Points2 uv = slit.uv;
  OpenSlits(slit.patch, slit.twin, 1e-6, uv);
  int pairs = 0;
  for (int v = 0; v < slit.patch.VertexCount(); ++v)
    for (int w = v + 1; w < slit.patch.VertexCount(); ++w)
      if (slit.twin[v] == slit.twin[w]) {
        ++pairs;
        EXPECT_GT((uv.row(v) - uv.row(w)).norm(), 1e-3)
            << "open to the eye: a part of a percent of the chart";
      }
  EXPECT_EQ(pairs, 4);
}

TEST(Slits, OnlyTheSlitMovesAndNoTriangleFlips) {
  const Slit slit = MakeSlit(0.5);
  Points2 uv = slit.uv;
  OpenSlits(slit.patch, slit.twin, 1e-6, uv);
  std::vector<int> copies(1000, 0);
  for (int t : slit.twin) ++copies[t];
  for (int v = 0; v < slit.patch.VertexCount(); ++v)
    if (copies[slit.twin[v]] == 1) {
      EXPECT_EQ(uv.row(v), slit.uv.row(v));
    }
  for (const GridTriangle& t : OnGrid(uv, slit.patch.mesh.triangles)) EXPECT_GT(TwiceArea(t), 0);
  EXPECT_TRUE(OverlappingPairs(OnGrid(uv, slit.patch.mesh.triangles), 10).empty());
}

TEST(Slits, NothingToOpen) {
  const Slit none = MakeSlit(0);
  Points2 uv = none.uv;
  OpenSlits(none.patch, none.twin, 1e-6, uv);
  EXPECT_EQ(uv, none.uv);

  // Sides that are apart already stay as they are.
  const Slit slit = MakeSlit(0.5);
  Points2 open = slit.uv;
  for (int v = 0; v < slit.patch.VertexCount(); ++v)
    for (int w = v + 1; w < slit.patch.VertexCount(); ++w)
      if (slit.twin[v] == slit.twin[w]) open(w, 0) += 0.01;
  const Points2 before = open;
  OpenSlits(slit.patch, slit.twin, 1e-6, open);
  EXPECT_EQ(open, before);
}

}  // namespace
}  // namespace dcharts
