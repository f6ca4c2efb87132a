// SPDX-License-Identifier: GPL-3.0-or-later
/// The same bytes whatever the number of threads.
#include "dcharts.h"

#include <atomic>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "comes.h"
#include "common/parallel.h"
#include "shapes.h"
#include "thread_count.h"

namespace dcharts {
namespace {

using test::Comes;

TEST(Threads, AnyNumberGivesTheSameBytes) {
  for (const SurfaceData& mesh : {shapes::Plush(32), shapes::Torus(14), shapes::CadPart(24)}) {
    Params params;
    params.chart_count = 14;
    std::vector<SurfaceChange> results;
    for (int count : {1, 2, 8}) {
      const test::Threads threads(count);
      Progress progress;
      results.push_back(TextureAtlas(mesh, params, progress));
    }
    for (const SurfaceChange& result : results) {
      EXPECT_EQ(result.chart_ids, results[0].chart_ids);
      EXPECT_TRUE(result.wedge_texcoords == results[0].wedge_texcoords);
      EXPECT_EQ(result.report.l2_stretch, results[0].report.l2_stretch);
      EXPECT_EQ(result.report.linf_stretch, results[0].report.linf_stretch);
      EXPECT_EQ(result.report.seam_length, results[0].report.seam_length);
    }
  }
}

TEST(Threads, AreAsManyAsWanted) {
  for (int count : {1, 2, 8}) {
    const test::Threads threads(count);
    EXPECT_EQ(ThreadCount(), count);
    std::atomic<int> helpers{0};
    {
      const Helpers all(count - 1, [&] { ++helpers; });
    }
    EXPECT_EQ(helpers, count - 1);
  }
  EXPECT_GE(ThreadCount(), 1);
}

TEST(Threads, EveryItemIsDoneOnce) {
  for (int count : {1, 2, 8}) {
    const test::Threads threads(count);
    std::vector<int> done(1000, 0);
    Progress progress;
    ParallelFor(1000, progress, [&](int k, const auto& poll) {
      poll();
      ++done[k];
    });
    EXPECT_EQ(done, std::vector<int>(1000, 1));
    ParallelFor(0, progress, [](int, const auto&) { FAIL(); });
  }
}

TEST(Threads, LoopsWithinLoopsTakeNoMoreThanThereAre) {
  for (int count : {1, 2, 5}) {
    const test::Threads threads(count);
    std::atomic<int> at_work{0}, most{0};
    std::vector<int> done(20 * 50, 0);
    Progress progress;
    ParallelFor(20, progress, [&](int k, const auto& poll) {
      InParallel(50, poll, [&](int i, const auto&) {
        const int now = ++at_work;
        for (int known = most; now > known && !most.compare_exchange_weak(known, now);) continue;
        ++done[50 * k + i];
        --at_work;
      });
    });
    EXPECT_LE(most, count);
    EXPECT_EQ(done, std::vector<int>(done.size(), 1));
    EXPECT_EQ(FreeThreads(), count - 1);
  }
}

TEST(Threads, OneThatWaitsLendsItsPlace) {
  const test::Threads threads(2);
  std::atomic<int> most{0};
  std::atomic<bool> helps{false};
  const auto caller = std::this_thread::get_id();
  // The caller gets one of the two items and is done at once; the helper's waits for a helper of its own.
  InParallel(2, {}, [&](int, const auto&) {
    if (std::this_thread::get_id() == caller) {
      while (!helps) std::this_thread::yield();
      return;
    }
    EXPECT_EQ(FreeThreads(), 0);
    helps = true;
    Comes([] { return FreeThreads() > 0; });
    most = FreeThreads();
    std::atomic<int> helpers{0};
    {
      const Helpers two(2, [&] { ++helpers; });
    }
    EXPECT_EQ(helpers, 1);
  });
  EXPECT_EQ(most, 1);
  EXPECT_EQ(FreeThreads(), 1);
}

TEST(Threads, OneThatBecomesFreeJoinsALoop) {
  const test::Threads threads(2);
  const auto caller = std::this_thread::get_id();
  std::atomic<bool> begun{false}, ends{false}, joined{false};
  // The only helper is at work elsewhere when the loop begins.
  Helpers other(1, [&] { Comes([&] { return ends.load(); }); });
  InParallel(2, {}, [&](int, const auto& poll) {
    if (std::this_thread::get_id() != caller) {
      joined = true;
      return;
    }
    if (begun) return;
    begun = true;
    EXPECT_EQ(FreeThreads(), 0);
    ends = true;
    EXPECT_TRUE(Comes([&] {
      poll();
      return joined.load();
    }));
  });
  EXPECT_TRUE(joined);
}

TEST(Threads, WhatIsAheadIsDoneWhileTheRestLastsOnly) {
  for (int count : {1, 2, 8}) {
    const test::Threads threads(count);
    std::atomic<int> begun{0}, given_up{0};
    std::vector<int> done(6, 0);
    // The first waits until another is begun ahead, where there is a thread; that would never end by itself.
    InParallelWithAhead(1, 5, {}, [&](int k, const auto& poll) {
      if (k == 0) {
        EXPECT_TRUE(count == 1 || Comes([&] { return begun > 0; }));
        done[0] = 1;
        return;
      }
      ++begun;
      try {
        for (;;) poll();
      } catch (...) {
        ++given_up;
        throw;
      }
    });
    EXPECT_EQ(done[0], 1);
    EXPECT_EQ(begun, given_up);
    EXPECT_EQ(begun > 0, count > 1);
  }
}

TEST(Threads, AnErrorStopsAllAndComesOut) {
  for (int count : {1, 2, 8}) {
    const test::Threads threads(count);
    Progress progress;
    try {
      ParallelFor(1000, progress, [](int k, const auto&) {
        if (k == 37) throw Error("item 37");
      });
      FAIL() << "no error";
    } catch (const Cancelled&) {
      FAIL() << "an error is no cancelling";
    } catch (const Error& error) {
      EXPECT_STREQ(error.what(), "item 37");
    }
  }
}

// Only the calling thread asks; with others at work it may get few items, even none.
TEST(Threads, CancellingStopsAll) {
  for (int count : {1, 2, 8}) {
    const test::Threads threads(count);
    int calls = 0;
    bool cancelled = false;
    Progress progress([&](int, const char*) { return ++calls < 5; });
    try {
      ParallelFor(1000, progress, [](int, const auto& poll) {
        for (int i = 0; i < 10; ++i) poll();
      });
    } catch (const Cancelled&) {
      cancelled = true;
    }
    EXPECT_EQ(cancelled, calls >= 5) << count;
    EXPECT_LE(calls, 5) << count;
    if (count == 1) {
      EXPECT_EQ(calls, 5);
    }
  }
}

}  // namespace
}  // namespace dcharts
