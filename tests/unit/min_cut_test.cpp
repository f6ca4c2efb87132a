// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar/min_cut.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace dcharts {
namespace {

double CutValue(const std::vector<FlowEdge>& edges, const std::vector<bool>& side) {
  double value = 0;
  for (const FlowEdge& e : edges)
    if (side[e.a] != side[e.b]) value += e.capacity;
  return value;
}

// The least over all ways to part the nodes.
double BruteForce(int n, const std::vector<FlowEdge>& edges, const std::vector<int>& sources,
                  const std::vector<int>& sinks) {
  double best = 1e300;
  for (unsigned mask = 0; mask < 1u << n; ++mask) {
    std::vector<bool> side(n);
    for (int k = 0; k < n; ++k) side[k] = mask >> k & 1;
    const bool fits = std::all_of(sources.begin(), sources.end(), [&](int s) { return side[s]; }) &&
                      std::none_of(sinks.begin(), sinks.end(), [&](int t) { return side[t]; });
    if (fits) best = std::min(best, CutValue(edges, side));
  }
  return best;
}

void ExpectTerminals(const std::vector<bool>& side, const std::vector<int>& sources,
                     const std::vector<int>& sinks) {
  for (int s : sources) EXPECT_TRUE(side[s]);
  for (int t : sinks) EXPECT_FALSE(side[t]);
}

TEST(MinCut, CutsTheWeakestLinkOfAChain) {
  const std::vector<FlowEdge> edges = {{0, 1, 3}, {1, 2, 1}, {2, 3, 2}};
  EXPECT_EQ(MinCut(4, edges, {0}, {3}), (std::vector<bool>{true, true, false, false}));
}

TEST(MinCut, EdgesWorkInBothDirections) {
  const std::vector<FlowEdge> edges = {{1, 0, 3}, {2, 1, 1}, {3, 2, 2}};
  EXPECT_EQ(MinCut(4, edges, {0}, {3}), (std::vector<bool>{true, true, false, false}));
}

TEST(MinCut, AgreesWithBruteForceOnRandomGraphs) {
  std::mt19937 random(11);
  for (int trial = 0; trial < 300; ++trial) {
    const int n = 4 + static_cast<int>(random() % 7);
    std::vector<FlowEdge> edges;
    const int edge_count = static_cast<int>(random() % (2u * static_cast<unsigned>(n) + 1));
    for (int e = 0; e < edge_count; ++e) {
      const int a = static_cast<int>(random() % static_cast<unsigned>(n));
      const int b = static_cast<int>(random() % static_cast<unsigned>(n));
      if (a != b) edges.push_back({a, b, static_cast<double>(random() % 8) / 4});
    }
    std::vector<int> sources{0}, sinks{1};
    if (trial % 3 == 1) sources.push_back(2);
    if (trial % 3 == 2) sinks.push_back(3);
    const std::vector<bool> side = MinCut(n, edges, sources, sinks);
    ASSERT_EQ(side.size(), static_cast<size_t>(n));
    ExpectTerminals(side, sources, sinks);
    EXPECT_NEAR(CutValue(edges, side), BruteForce(n, edges, sources, sinks), 1e-12) << "trial " << trial;
  }
}

TEST(MinCut, ParallelEdgesAddUp) {
  const std::vector<FlowEdge> edges = {{0, 1, 1}, {0, 1, 1}, {0, 1, 1}, {1, 2, 2}};
  EXPECT_EQ(MinCut(3, edges, {0}, {2}), (std::vector<bool>{true, true, false}));
}

TEST(MinCut, PartsThatHangTogetherNowhere) {
  const std::vector<bool> side = MinCut(4, {{0, 1, 1}, {2, 3, 1}}, {0}, {3});
  EXPECT_TRUE(side[0] && side[1]);
  EXPECT_FALSE(side[2] || side[3]);
  ExpectTerminals(MinCut(2, {}, {0}, {1}), {0}, {1});
}

TEST(MinCut, EdgesWithoutCapacityAreFree) {
  const std::vector<FlowEdge> edges = {{0, 1, 5}, {1, 2, 0}, {2, 3, 5}};
  const std::vector<bool> side = MinCut(4, edges, {0}, {3});
  EXPECT_EQ(CutValue(edges, side), 0);
  ExpectTerminals(side, {0}, {3});
}

TEST(MinCut, CapacitiesOfVeryDifferentSize) {
  const std::vector<FlowEdge> edges = {{0, 1, 1e-9}, {1, 2, 1e-10}, {2, 3, 1e6}};
  EXPECT_EQ(MinCut(4, edges, {0}, {3}), (std::vector<bool>{true, true, false, false}));
}

TEST(MinCut, PullsAgreeWithBruteForceOnRandomGraphs) {
  std::mt19937 random(12);
  for (int trial = 0; trial < 300; ++trial) {
    const int n = 1 + static_cast<int>(random() % 9);
    std::vector<double> pull;
    for (int k = 0; k < n; ++k) pull.push_back(static_cast<double>(random() % 17) - 8);
    std::vector<FlowEdge> edges;
    for (unsigned e = random() % 18; e > 0; --e) {
      const int a = static_cast<int>(random() % static_cast<unsigned>(n));
      const int b = static_cast<int>(random() % static_cast<unsigned>(n));
      if (a != b) edges.push_back({a, b, static_cast<double>(random() % 6)});
    }
    auto price = [&](const std::vector<bool>& side) {
      double sum = CutValue(edges, side);
      for (int k = 0; k < n; ++k)
        if (side[k] != (pull[k] > 0)) sum += std::abs(pull[k]);
      return sum;
    };
    double best = 1e300;
    long fewest = 0;
    for (unsigned mask = 0; mask < 1u << n; ++mask) {
      std::vector<bool> side(n);
      for (int k = 0; k < n; ++k) side[k] = mask >> k & 1;
      const long count = std::count(side.begin(), side.end(), true);
      if (price(side) < best || (price(side) == best && count < fewest)) {
        best = price(side);
        fewest = count;
      }
    }
    const std::vector<bool> side = MinCut(pull, edges);
    EXPECT_EQ(price(side), best) << "trial " << trial;
    EXPECT_EQ(std::count(side.begin(), side.end(), true), fewest) << "trial " << trial;
  }
}

// A grid with cheap edges along one column: the cut follows it.
TEST(MinCut, FollowsACheapLineThroughAGrid) {
  const int n = 20;
  std::vector<FlowEdge> edges;
  std::vector<int> sources, sinks;
  auto node = [&](int i, int j) { return j * n + i; };
  for (int j = 0; j < n; ++j) {
    sources.push_back(node(0, j));
    sinks.push_back(node(n - 1, j));
    const int weak = 5 + (j < n / 2 ? j / 3 : (n - 1 - j) / 3);
    for (int i = 0; i < n; ++i) {
      if (i + 1 < n) edges.push_back({node(i, j), node(i + 1, j), i == weak ? 0.01 : 1.0});
      if (j + 1 < n) edges.push_back({node(i, j), node(i, j + 1), 0.01});
    }
  }
  const std::vector<bool> side = MinCut(n * n, edges, sources, sinks);
  for (int j = 0; j < n; ++j) {
    const int weak = 5 + (j < n / 2 ? j / 3 : (n - 1 - j) / 3);
    for (int i = 0; i < n; ++i) EXPECT_EQ(side[node(i, j)], i <= weak) << i << " " << j;
  }
}

// A sheet of nodes whose left side pulls one way and whose right side the other, with random edges.
TEST(BandedMinCut, CutsALargeSheetNearlyAsCheaply) {
  constexpr int kSize = 200;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> capacity(0.5, 1.5);
  std::vector<double> pull(kSize * kSize, 0);
  std::vector<FlowEdge> edges;
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) {
      const int n = y * kSize + x;
      pull[n] = x < kSize / 3 ? 1 : x > 2 * kSize / 3 ? -1 : 0;
      if (x + 1 < kSize) edges.push_back({n, n + 1, capacity(random)});
      if (y + 1 < kSize) edges.push_back({n, n + kSize, capacity(random)});
    }
  const auto price = [&](const std::vector<bool>& side) {
    double sum = CutValue(edges, side);
    for (size_t n = 0; n < side.size(); ++n)
      if (pull[n] != 0 && (pull[n] > 0) != side[n]) sum += std::abs(pull[n]);
    return sum;
  };
  const std::vector<bool> exact = MinCut(pull, edges), banded = BandedMinCut(pull, edges);
  EXPECT_TRUE(banded.front());
  EXPECT_FALSE(banded.back());
  EXPECT_LT(price(banded), 1.15 * price(exact));
  EXPECT_EQ(BandedMinCut(pull, edges), banded);
}

TEST(BandedMinCut, IsExactOnSmallGraphs) {
  const std::vector<FlowEdge> edges = {{0, 1, 3}, {1, 2, 1}, {2, 3, 2}};
  EXPECT_EQ(BandedMinCut({9, 0, 0, -9}, edges), (std::vector<bool>{true, true, false, false}));
}

}  // namespace
}  // namespace dcharts
