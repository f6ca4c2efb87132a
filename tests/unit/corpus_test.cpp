// SPDX-License-Identifier: GPL-3.0-or-later
/// Meshes of every kind end in a sound atlas and a pattern, or are refused with a sentence.
#include "corpus.h"

#include <algorithm>
#include <cstddef>
#include <set>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "atlas_checks.h"
#include "dcharts.h"
#include "pattern_checks.h"

namespace dcharts {
namespace {

class Corpus : public ::testing::TestWithParam<test::CorpusEntry> {};

// Says what is wrong; a mesh that is to be refused is, with that word.
template <class Run>
void Expect(const char* refused, const Run& run) {
  std::string wrong, sentence;
  try {
    wrong = run();
  } catch (const Error& error) {
    sentence = error.what();
  }
  EXPECT_EQ(wrong, "");
  if (refused == nullptr) {
    EXPECT_EQ(sentence, "");
  } else {
    EXPECT_NE(sentence.find(refused), std::string::npos) << sentence;
    EXPECT_EQ(sentence.empty() ? ' ' : sentence.back(), '.') << sentence;
  }
}

TEST_P(Corpus, BecomesASoundAtlas) {
  const SurfaceData mesh = GetParam().make();
  Expect(GetParam().no_atlas, [&] {
    Progress progress;
    return test::WrongInAtlas(mesh, TextureAtlas(mesh, Params(), progress), false);
  });
}

TEST_P(Corpus, BecomesAPattern) {
  const SurfaceData mesh = GetParam().make();
  Params params;
  params.size = 300;
  Expect(GetParam().no_pattern, [&] {
    Progress progress;
    return test::WrongInPattern(mesh, MakePattern(mesh, params, progress).pattern);
  });
}

INSTANTIATE_TEST_SUITE_P(Meshes, Corpus, ::testing::ValuesIn(test::kCorpus), [](const auto& entry) {
  std::string name = entry.param.name;
  for (char& c : name)
    if (c == '-') c = '_';
  return name;
});

// Vertices in use - edges + faces.
int Euler(const SurfaceData& mesh) {
  std::set<int> vertices;
  std::set<std::pair<int, int>> edges;
  for (const auto& face : mesh.faces)
    for (std::size_t k = 0; k < 3; ++k) {
      vertices.insert(face[k]);
      edges.insert(std::minmax(face[k], face[(k + 1) % 3]));
    }
  return static_cast<int>(vertices.size()) - static_cast<int>(edges.size()) +
         static_cast<int>(mesh.faces.size());
}

TEST(CorpusShapes, AreWhatTheirNamesSay) {
  EXPECT_EQ(Euler(test::corpus::Handles<0>()), 2);
  EXPECT_EQ(Euler(test::corpus::Handles<5>()), 2 - 2 * 5);
  EXPECT_EQ(Euler(test::corpus::Handles<20>()), 2 - 2 * 20);
  EXPECT_EQ(Euler(test::corpus::Sieve()), 2 - 26);
  const SurfaceData klein = test::corpus::KleinBottle();
  EXPECT_EQ(Euler(klein), 0);
  // Closed, but not all faces agree.
  const auto opposite = test::Opposites(klein);
  EXPECT_EQ(std::count(opposite.begin(), opposite.end(), -1), 2 * 12);
}

TEST(CorpusSoup, TenThousandTriangles) {
  const SurfaceData mesh = test::corpus::Soup(10000);
  Progress progress;
  const SurfaceChange atlas = TextureAtlas(mesh, Params(), progress);
  EXPECT_EQ(test::WrongInAtlas(mesh, atlas, false), "");
  EXPECT_EQ(atlas.report.charts, 10000);
}

}  // namespace
}  // namespace dcharts
