// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "common/cheapest_first.h"
#include "common/tournament.h"

namespace dcharts {
namespace {

TEST(CheapestFirst, TakesThemInOrderOfCostAndThenOfItems) {
  std::mt19937 random(1);
  CheapestFirst<int> queue;
  using Pair = std::pair<double, int>;
  std::priority_queue<Pair, std::vector<Pair>, std::greater<>> expected;
  for (int step = 0; step < 20000; ++step) {
    const unsigned what = random() % 8;
    const double cost = random() % 50;  // so that many are equally cheap
    const int item = static_cast<int>(random() % 1000);
    if (what < 4 || expected.empty()) {
      queue.Push({cost, item});
      expected.push({cost, item});
    } else {
      ASSERT_EQ(queue.Top().cost, expected.top().first);
      ASSERT_EQ(queue.Top().item, expected.top().second);
      expected.pop();
      if (what < 7) {
        queue.Pop();
      } else {
        queue.ReplaceTop({cost, item});
        expected.push({cost, item});
      }
    }
    ASSERT_EQ(queue.IsEmpty(), expected.empty());
  }
  queue.Clear();
  EXPECT_TRUE(queue.IsEmpty());
}

// Who has the least key; of equal ones the first.
int Least(const std::vector<double>& key) {
  const auto least = std::min_element(key.begin(), key.end());
  return *least < std::numeric_limits<double>::infinity() ? static_cast<int>(least - key.begin())
                                                          : Tournament::kNobody;
}

TEST(Tournament, TheLeastKeyWins) {
  std::mt19937 random(2);
  for (int count : {1, 2, 3, 8, 21}) {
    std::vector<double> key(count, std::numeric_limits<double>::infinity());
    Tournament tournament;
    tournament.Begin(count);
    for (int player = 0; player < count; ++player) {
      if (count > 2 && player % 5 == 1) continue;  // takes no part
      key[player] = random() % 10;
      tournament.Enter(player, key[player]);
    }
    tournament.Start();
    while (tournament.Winner() != Tournament::kNobody) {
      const int winner = tournament.Winner();
      ASSERT_EQ(winner, Least(key));
      if (random() % 10 == 0) {
        key[winner] = std::numeric_limits<double>::infinity();
        tournament.Leave();
      } else {
        key[winner] += random() % 4;
        const bool wins_again = tournament.WinsAgain(key[winner]);
        tournament.Replay(key[winner]);
        if (wins_again) {
          EXPECT_EQ(tournament.Winner(), winner);
        }
      }
    }
    EXPECT_EQ(Least(key), Tournament::kNobody);
  }
}

}  // namespace
}  // namespace dcharts
