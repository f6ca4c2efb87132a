// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/seams.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "surface/workspace.h"
#include "surface_fixture.h"

namespace dcharts {
namespace {

using test::TestSurface;

void SetBoth(const TestSurface& surface, SeamMask& seams, int half_edge) {
  SetSeam(seams, half_edge);
  SetSeam(seams, surface->Opposite(half_edge));
}

SeamMask None(const TestSurface& surface) { return SeamMask(surface->FaceCount(), 0); }

// The edges whose ends both have this coordinate.
SeamMask Along(const TestSurface& surface, size_t d, double value, double to = 1e9) {
  SeamMask seams = None(surface);
  for (int h = 0; h < surface->HalfEdgeCount(); ++h) {
    const auto &a = surface.InputPosition(surface->Vertex(h)),
               &b = surface.InputPosition(surface->Vertex(Next(h)));
    if (surface->Opposite(h) >= 0 && std::abs(a[d] - value) < 1e-9 && std::abs(b[d] - value) < 1e-9 &&
        std::max(a[1 - d], b[1 - d]) < to + 1e-9)
      SetSeam(seams, h);
  }
  return seams;
}

SeamMask RandomSeams(const TestSurface& surface, unsigned seed, unsigned one_of) {
  std::mt19937 random(seed);
  SeamMask seams = None(surface);
  for (int h = 0; h < surface->HalfEdgeCount(); ++h)
    if (surface->Opposite(h) > h && random() % one_of == 0) SetBoth(surface, seams, h);
  DropIneffectiveSeams(*surface, seams);
  return seams;
}

TEST(Seams, MaskHasABitPerEdge) {
  SeamMask seams(2, 0);
  SetSeam(seams, 4);
  EXPECT_EQ(seams, (SeamMask{0, 2}));
  for (int h = 0; h < 6; ++h) EXPECT_EQ(IsSeam(seams, h), h == 4);
}

TEST(Seams, ProvisionalTexcoordsJumpExactlyAtTheSeams) {
  for (const SurfaceData& mesh : {shapes::Torus(10), shapes::Grid(7, 5), shapes::Sphere(4),
                                  shapes::CadPart(24), shapes::MoebiusStrip(20), shapes::NonManifoldFin(4)})
    for (unsigned one_of : {2u, 5u, 50u, 100000u}) {
      const TestSurface surface(mesh);
      const SeamMask seams = RandomSeams(surface, one_of, one_of);
      const WedgeTexcoords uv = ProvisionalTexcoords(*surface, seams);
      EXPECT_EQ(SeamsOfTexcoords(*surface, uv), seams) << one_of;
      EXPECT_TRUE(LooksLikeTexcoords(uv));
      for (const auto& t : uv)
        for (float x : t) ASSERT_TRUE(x >= 0 && x <= 1);
    }
}

TEST(Seams, AreTakenBackWhereTexcoordsDoNotShowThem) {
  const TestSurface surface(shapes::Grid(6, 6));
  const SeamMask line = Along(surface, 0, 0.5);
  ASSERT_NE(line, None(surface));
  SeamMask more = line;
  for (int h = 0; h < surface->HalfEdgeCount(); h += 7)
    if (surface->Opposite(h) >= 0) SetBoth(surface, more, h);
  ASSERT_NE(more, line);
  DropSeamsNotIn(ProvisionalTexcoords(*surface, line), *surface, more);
  EXPECT_EQ(more, line);
}

TEST(Seams, ProvisionalTexcoordsAreEqualOnlyForOneVertex) {
  const TestSurface surface(shapes::Torus(10));
  const SeamMask seams = RandomSeams(surface, 3, 4);
  const WedgeTexcoords uv = ProvisionalTexcoords(*surface, seams);
  const CutVertices cut = OpenAtSeams(*surface, seams);
  std::set<std::pair<float, float>> places;
  for (int h = 0; h < surface->HalfEdgeCount(); ++h)
    places.insert({uv[h / 3][2 * (h % 3)], uv[h / 3][2 * (h % 3) + 1]});
  EXPECT_EQ(static_cast<int>(places.size()), cut.count);
}

TEST(Seams, OpenAtSeamsCountsVertices) {
  const TestSurface surface(shapes::Grid(8, 8));
  EXPECT_EQ(OpenAtSeams(*surface, None(surface)).count, 81);
  // A cut half-way through doubles the vertices on it but its inner end.
  EXPECT_EQ(OpenAtSeams(*surface, Along(surface, 0, 0.5, 0.5)).count, 81 + 4);
  EXPECT_EQ(OpenAtSeams(*surface, Along(surface, 0, 0.5)).count, 81 + 9);
  SeamMask all = None(surface);
  for (auto& s : all) s = 7;
  EXPECT_EQ(OpenAtSeams(*surface, all).count, surface->HalfEdgeCount());
}

TEST(Seams, NonManifoldVerticesAreOneFanEach) {
  const TestSurface surface(shapes::BowTie(3));
  EXPECT_EQ(OpenAtSeams(*surface, None(surface)).count, surface->VertexCount() + 1);
}

TEST(Seams, SingleEdgesInsideOpenNothingAndAreDropped) {
  const TestSurface surface(shapes::Grid(8, 8));
  SeamMask seams = None(surface);
  int inner = -1;
  for (int h = 0; h < surface->HalfEdgeCount() && inner < 0; ++h) {
    const auto &a = surface.InputPosition(surface->Vertex(h)),
               &b = surface.InputPosition(surface->Vertex(Next(h)));
    if (std::min({a[0], a[1], b[0], b[1]}) > 0.3 && std::max({a[0], a[1], b[0], b[1]}) < 0.7) inner = h;
  }
  SetBoth(surface, seams, inner);
  DropIneffectiveSeams(*surface, seams);
  EXPECT_EQ(seams, None(surface));
}

TEST(Seams, CutsThatOpenSomethingStay) {
  const TestSurface surface(shapes::Grid(8, 8));
  for (const SeamMask& kept :
       {Along(surface, 0, 0.5), Along(surface, 0, 0.5, 0.125), Along(surface, 1, 0.25, 0.75)}) {
    ASSERT_NE(kept, None(surface));
    SeamMask seams = kept;
    DropIneffectiveSeams(*surface, seams);
    EXPECT_EQ(seams, kept);
  }
}

TEST(Seams, Agreement) {
  const TestSurface surface(shapes::Grid(8, 8));
  const ChartIds halves = surface.Paint([](const auto& p) { return p[0] < 0.5 ? 0 : 1; });
  const ChartIds one(surface->FaceCount(), 0);
  const SeamMask line = Along(surface, 0, 0.5), slit = Along(surface, 0, 0.5, 0.5),
                 other = Along(surface, 1, 0.5);
  EXPECT_TRUE(SeamsAgree(*surface, halves, line));
  EXPECT_TRUE(SeamsAgree(*surface, one, slit));
  EXPECT_TRUE(SeamsAgree(*surface, one, None(surface)));
  EXPECT_FALSE(SeamsAgree(*surface, halves, None(surface))) << "a border that is no seam";
  EXPECT_FALSE(SeamsAgree(*surface, halves, slit)) << "half of it is none";
  EXPECT_FALSE(SeamsAgree(*surface, one, line)) << "the chart falls apart";
  EXPECT_FALSE(SeamsAgree(*surface, halves, other));
  SeamMask one_sided = line;
  for (auto& s : one_sided)
    if (s) {
      s = 0;
      break;
    }
  EXPECT_FALSE(SeamsAgree(*surface, halves, one_sided)) << "the two sides of an edge differ";
}

TEST(Seams, WhatLooksLikeTexcoords) {
  const std::array<float, 6> good{0, 0, 1, 0, 0, 1};
  EXPECT_TRUE(LooksLikeTexcoords({good, good}));
  EXPECT_FALSE(LooksLikeTexcoords({good, {}})) << "zeros";
  EXPECT_FALSE(LooksLikeTexcoords({good, {0, 0, 1, 1, 1, 1}})) << "two corners alike";
  const float nan = std::numeric_limits<float>::quiet_NaN(),
              infinity = std::numeric_limits<float>::infinity();
  EXPECT_FALSE(LooksLikeTexcoords({good, {0, 0, nan, 0, 0, 1}}));
  EXPECT_FALSE(LooksLikeTexcoords({good, {0, 0, infinity, 0, 0, 1}}));
}

// --- where Parameterize takes them from

struct Source {
  SurfaceData mesh;
  SeamMask slit, line;
  ChartIds one, halves;
};
Source MakeSource() {
  Source s;
  s.mesh = shapes::Grid(8, 8);
  const TestSurface surface(s.mesh);
  s.slit = Along(surface, 0, 0.5, 0.5);
  s.line = Along(surface, 0, 0.5);
  s.one.assign(surface->FaceCount(), 0);
  s.halves = surface.Paint([](const auto& p) { return p[0] < 0.5 ? 0 : 1; });
  return s;
}

TEST(ReadSeams, TheAttributeIfItAgrees) {
  Source s = MakeSource();
  s.mesh.seams = s.slit;
  SeamMask seams;
  EXPECT_TRUE(Workspace(s.mesh).ReadSeams(s.one, seams));
  EXPECT_EQ(seams, s.slit);
  s.mesh.seams = s.line;
  EXPECT_FALSE(Workspace(s.mesh).ReadSeams(s.one, seams));
}

TEST(ReadSeams, ElseTexcoordsThatDo) {
  Source s = MakeSource();
  const TestSurface surface(s.mesh);
  s.mesh.wedge_texcoords = ProvisionalTexcoords(*surface, s.slit);
  SeamMask seams;
  EXPECT_TRUE(Workspace(s.mesh).ReadSeams(s.one, seams));
  EXPECT_EQ(seams, s.slit);
  s.mesh.seams = s.line;  // an attribute that doesn't fit
  EXPECT_TRUE(Workspace(s.mesh).ReadSeams(s.one, seams));
  EXPECT_EQ(seams, s.slit);
  EXPECT_FALSE(Workspace(s.mesh).ReadSeams(s.halves, seams) && seams == s.slit);
}

TEST(ReadSeams, ElseNone) {
  Source s = MakeSource();
  SeamMask seams;
  EXPECT_FALSE(Workspace(s.mesh).ReadSeams(s.halves, seams));
  s.mesh.wedge_texcoords.assign(s.mesh.faces.size(), {});
  EXPECT_FALSE(Workspace(s.mesh).ReadSeams(s.one, seams)) << "zeros are no texcoords";
}

TEST(ReadSeams, OtherBitsAndBordersOfTheMeshDoNotMatter) {
  Source s = MakeSource();
  const TestSurface surface(s.mesh);
  s.mesh.seams = s.slit;
  for (int h = 0; h < surface->HalfEdgeCount(); ++h)
    if (surface->Opposite(h) < 0) SetSeam(s.mesh.seams, h);
  for (auto& bits : s.mesh.seams) bits = static_cast<std::uint8_t>(bits | 0xC0);
  SeamMask seams;
  EXPECT_TRUE(Workspace(s.mesh).ReadSeams(s.one, seams));
  EXPECT_EQ(seams, s.slit);
}

TEST(ReadSeams, KeptBordersBecomeSuchAgain) {
  Source s = MakeSource();
  for (std::uint8_t bits : s.slit) s.mesh.seams.push_back(static_cast<std::uint8_t>(bits | bits << 3));
  Workspace work(s.mesh);
  SeamMask seams;
  EXPECT_TRUE(work.ReadSeams(s.one, seams));
  EXPECT_EQ(seams, SeamMask(s.slit.size(), 0));
  EXPECT_EQ(work.KeptBorders(), s.slit);
  work.ReleaseBorders(seams);
  EXPECT_EQ(seams, s.slit);
}

}  // namespace
}  // namespace dcharts
