// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/work_ahead.h"

#include <atomic>
#include <chrono>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "comes.h"
#include "common/errors.h"
#include "common/threads.h"
#include "thread_count.h"

namespace dcharts {
namespace {

using test::Comes;

const Poll kNoPoll = [] {};

TEST(WorkAhead, StepsAreDoneOnceAndInTurn) {
  for (int count : {1, 2, 8}) {
    const test::Threads threads(count);
    std::vector<int> done;
    WorkAhead work({[&](const Poll&) { done.push_back(1); }, [&](const Poll&) { done.push_back(2); }});
    work.Begin();
    work.Finish(1, kNoPoll);
    work.Finish(2, kNoPoll);
    work.Finish(2, kNoPoll);
    EXPECT_EQ(done, (std::vector<int>{1, 2}));
  }
}

TEST(WorkAhead, IsDoneWhereItIsAskedForWhenItHasNotBegun) {
  const test::Threads threads(2);
  std::thread::id worker;
  WorkAhead work({[&](const Poll&) { worker = std::this_thread::get_id(); }});
  work.Finish(1, kNoPoll);
  EXPECT_EQ(worker, std::this_thread::get_id());
}

TEST(WorkAhead, ThatIsNotNeededIsGivenUp) {
  const test::Threads threads(2);
  std::atomic<bool> ends{false};
  {
    WorkAhead work({[&](const Poll& poll) {
      try {
        for (;;) poll();
      } catch (const Cancelled&) {
        ends = true;
        throw;
      }
    }});
    work.Begin();
  }
  EXPECT_TRUE(ends);
}

TEST(WorkAhead, AnErrorComesOutWhereItIsAskedFor) {
  for (int count : {1, 2}) {
    const test::Threads threads(count);
    WorkAhead work({[](const Poll&) {}, [](const Poll&) { throw Error("step 2"); }});
    work.Begin();
    work.Finish(1, kNoPoll);
    EXPECT_THROW(work.Finish(2, kNoPoll), Error);
  }
}

TEST(WorkAhead, BeginsWhenWhatIsDoneMeanwhileLasts) {
  const test::Threads threads(2);
  std::atomic<bool> begun{false};
  WorkAhead work({[&](const Poll&) { begun = true; }});
  const Poll soon = work.BeginningAfter(std::chrono::milliseconds(0), {});
  const Poll late = work.BeginningAfter(std::chrono::hours(1), {});
  late();
  EXPECT_FALSE(begun);
  EXPECT_TRUE(Comes([&] {
    soon();
    return begun.load();
  }));
  soon();
  work.Finish(1, {});
}

TEST(WorkAhead, GivesWayToHelpers) {
  const test::Threads threads(2);
  std::atomic<int> polls{0};
  WorkAhead work({[&](const Poll& poll) {
    for (;;) {
      poll();
      ++polls;
    }
  }});
  work.Begin();
  ASSERT_TRUE(Comes([&] { return polls > 0; }));
  EXPECT_EQ(FreeThreads(), 1);
  EXPECT_EQ(IdleThreads(), 0);
  std::atomic<bool> rested{false};
  {
    const Helpers one(1, [&] { Comes([&] { return rested.load(); }); });
    int before = -1;
    rested = Comes([&] {
      const int last = std::exchange(before, polls.load());
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      return last == polls;
    });
  }
  EXPECT_TRUE(rested);
  const int after = polls;
  EXPECT_TRUE(Comes([&] { return polls > after; }));
}

TEST(WorkAhead, TakesThePlaceOfTheThreadThatWaitsForIt) {
  const test::Threads threads(2);
  int helpers_beside = -1;
  std::atomic<bool> waits{false};
  WorkAhead work({[&](const Poll& poll) {
    EXPECT_TRUE(Comes([&] {
      poll();
      return waits.load();
    }));
    std::atomic<int> helpers{0};
    {
      const Helpers four(4, [&] { ++helpers; });
    }
    helpers_beside = helpers;
  }});
  work.Begin();
  work.Finish(1, [&] { waits = true; });
  EXPECT_EQ(helpers_beside, 1);
  EXPECT_TRUE(Comes([] { return IdleThreads() == 1; }));
}

}  // namespace
}  // namespace dcharts
