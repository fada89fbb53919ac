#include "lightproof/core/parallel.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cfenv>
#include <chrono>
#include <cstdlib>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "lightproof/core/error.h"

namespace lightproof {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

/// The threads that come to work if every task waits, `patience` long at most, for a second one.
std::set<std::thread::id> threads_at_work(milliseconds patience) {
  std::mutex mutex;
  std::set<std::thread::id> threads;
  const auto deadline = steady_clock::now() + patience;
  parallel_for(16, [&](std::size_t) {
    std::unique_lock lock(mutex);
    threads.insert(std::this_thread::get_id());
    while (threads.size() < 2 && steady_clock::now() < deadline) {
      lock.unlock();
      std::this_thread::sleep_for(milliseconds(1));
      lock.lock();
    }
  });
  return threads;
}

TEST(ParallelFor, RunsEachIndexOnce) {
  for (const std::size_t count :
       {std::size_t{0}, std::size_t{1}, std::size_t{2}, std::size_t{999}}) {
    std::vector<std::atomic<int>> runs(count);
    std::atomic<std::size_t> total = 0;
    parallel_for(count, [&](std::size_t i) {
      ++runs.at(i);
      ++total;
    });
    EXPECT_EQ(total, count);
    EXPECT_TRUE(std::all_of(runs.begin(), runs.end(), [](const auto& n) { return n == 1; }));
  }
}

TEST(ParallelFor, RunsEachIndexOnceWhenNested) {
  std::vector<std::atomic<int>> runs(std::size_t{20} * 30);
  parallel_for(20, [&](std::size_t i) {
    parallel_for(30, [&, i](std::size_t j) { ++runs.at(30 * i + j); });
  });
  EXPECT_TRUE(std::all_of(runs.begin(), runs.end(), [](const auto& n) { return n == 1; }));
}

TEST(ParallelFor, PassesAnExceptionOn) {
  try {
    parallel_for(100, [](std::size_t i) {
      if (i == 37) throw std::out_of_range("task 37");
    });
    FAIL() << "nothing was thrown";
  } catch (const std::out_of_range& error) {
    EXPECT_STREQ(error.what(), "task 37");
  }
}

TEST(ParallelFor, PassesAnExceptionOnWhenNested) {
  const auto nested = [] {
    parallel_for(4, [](std::size_t) {
      parallel_for(4, [](std::size_t j) {
        if (j == 2) throw InputError("inner");
      });
    });
  };
  EXPECT_THROW(nested(), InputError);
}

/// Inner loops of 8 outer tasks, the last of which fails, that returned with work undone.
int loops_cut_short() {
  std::atomic<int> cut_short = 0;
  const auto outer = [&](std::size_t i) {
    std::atomic<int> runs = 0;
    parallel_for(20, [&](std::size_t) {
      if (i == 7) throw InputError("the last one");
      std::this_thread::sleep_for(std::chrono::microseconds(20));
      ++runs;
    });
    if (runs != 20) ++cut_short;
  };
  EXPECT_THROW(parallel_for(8, outer), InputError);
  return cut_short;
}

TEST(ParallelFor, ReturnsOnlyWithAllWorkDone) {
  // How the threads meet differs from round to round.
  for (int round = 0; round < 50; ++round) EXPECT_EQ(loops_cut_short(), 0);
}

TEST(ParallelFor, ComputesAsTheCallerDoes) {
  const int before = std::fegetround();
  for (const int rounding : {FE_UPWARD, FE_TONEAREST, FE_DOWNWARD}) {
    std::fesetround(rounding);
    std::atomic<int> others = 0;
    parallel_for(8, [&](std::size_t) {
      parallel_for(8, [&](std::size_t) { others += std::fegetround() == rounding ? 0 : 1; });
    });
    EXPECT_EQ(others, 0) << rounding;
    EXPECT_EQ(std::fegetround(), rounding);
  }
  std::fesetround(before);
}

TEST(ParallelFor, WorksAfterAnException) {
  const auto failing = [](std::size_t) { throw InputError("all"); };
  EXPECT_THROW(parallel_for(8, failing), InputError);
  std::atomic<int> runs = 0;
  parallel_for(8, [&](std::size_t) { ++runs; });
  EXPECT_EQ(runs, 8);
}

/// Tasks of an outer loop that are under way: in all, and on a single thread.
struct Stacked {
  int in_all = 0;
  int on_a_thread = 0;
};

/// The most that nested loops on `threads` threads had under way at a time.
Stacked most_stacked(int threads) {
  static thread_local int on_this_thread = 0;
  std::mutex mutex;
  Stacked now;
  Stacked most;
  const auto outer = [&](std::size_t i) {
    {
      const std::lock_guard lock(mutex);
      most.in_all = std::max(most.in_all, ++now.in_all);
      most.on_a_thread = std::max(most.on_a_thread, ++on_this_thread);
    }
    parallel_for(8, [&](std::size_t j) {
      std::this_thread::sleep_for(std::chrono::microseconds(100 * (1 + (7 * i + 3 * j) % 8)));
    });
    const std::lock_guard lock(mutex);
    --on_this_thread;
    --now.in_all;
  };
  const ThreadLimit limit(threads);
  // More threads than there may be processors: they sleep.
  tbb::task_arena arena(threads);
  arena.execute([&] { parallel_for(64, outer); });
  return most;
}

// What an outer task holds, a map or its tables, would be held many times over.
TEST(ParallelFor, BeginsNoOtherOuterTaskInsideOfOne) {
  constexpr int kThreads = 4;
  const Stacked stacked = most_stacked(kThreads);
  EXPECT_EQ(stacked.on_a_thread, 1);
  EXPECT_LE(stacked.in_all, kThreads);
}

TEST(ParallelFor, UsesAllThreadsInsideOfTheLastOuterTask) {
  if (std::thread::hardware_concurrency() < 2) GTEST_SKIP() << "one processor";
  for (int round = 0; round < 20; ++round) {  // the caller runs the last task in some, not in all
    std::size_t threads = 0;
    std::atomic<int> done = 0;
    parallel_for(4, [&](std::size_t i) {
      if (i != static_cast<std::size_t>(round % 4)) {
        ++done;
        return;
      }
      const auto deadline = steady_clock::now() + milliseconds(60000);
      while (done < 3 && steady_clock::now() < deadline) std::this_thread::yield();
      threads = threads_at_work(milliseconds(60000)).size();
    });
    EXPECT_GE(threads, 2U) << "round " << round;
  }
}

#ifdef __SANITIZE_THREAD__
/// Two threads, one of which reads what the other has written in a loop, after a loop of its own.
/// The first comes first by the clock, but nothing orders them.
[[noreturn]] void race_between_loops() {
  int shared = 0;
  std::atomic<bool> written = false;
  std::thread writer([&] {
    parallel_for(1, [&](std::size_t) { shared = 1; });
    written.store(true, std::memory_order_relaxed);
  });
  std::thread reader([&] {
    while (!written.load(std::memory_order_relaxed)) std::this_thread::yield();
    parallel_for(1, [](std::size_t) {});
    ++shared;
  });
  writer.join();
  reader.join();
  std::exit(0);
}

TEST(ParallelForDeathTest, DoesNotHideRacesOfUnrelatedLoops) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  constexpr int kRaceFound = 66;
  EXPECT_EXIT(race_between_loops(), testing::ExitedWithCode(kRaceFound), "data race");
}
#endif

TEST(ThreadLimit, OfOneKeepsToTheCallersThread) {
  const ThreadLimit limit(1);
  // A second thread would show up within microseconds; it is given 0.2 s.
  const std::set<std::thread::id> threads = threads_at_work(milliseconds(200));
  EXPECT_EQ(threads, std::set{std::this_thread::get_id()});
}

TEST(ThreadLimit, EndsWithItsLife) {
  if (std::thread::hardware_concurrency() < 2) GTEST_SKIP() << "one processor";
  { const ThreadLimit limit(1); }
  // Waits until the second thread comes; 60 s only if it never does.
  EXPECT_GE(threads_at_work(milliseconds(60000)).size(), 2U);
}

TEST(ThreadLimit, OfZeroMeansAllCores) {
  if (std::thread::hardware_concurrency() < 2) GTEST_SKIP() << "one processor";
  const ThreadLimit limit(0);
  EXPECT_GE(threads_at_work(milliseconds(60000)).size(), 2U);
}

TEST(ThreadCount, IsOneAtLeast) {
  EXPECT_EQ(thread_count(3, 8), 3U);
  EXPECT_EQ(thread_count(0, 8), 8U);
  EXPECT_EQ(thread_count(0, 0), 1U) << "the system does not say how many processors there are";
}

TEST(Interrupt, StopsParallelWorkBetweenTasksUntilItIsWithdrawn) {
  const ThreadLimit limit(1);
  std::atomic<int> runs = 0;
  const auto work = [&](std::size_t) {
    if (++runs == 10) request_interrupt();
  };
  EXPECT_THROW(parallel_for(1000, work), Interrupted);
  EXPECT_EQ(runs, 10);
  EXPECT_THROW(parallel_for(1000, work), Interrupted) << "still requested";
  EXPECT_EQ(runs, 10);
  withdraw_interrupt();
  parallel_for(1000, work);
  EXPECT_EQ(runs, 1010);
}

TEST(Interrupt, IsNotThereUnasked) { EXPECT_NO_THROW(throw_if_interrupted()); }

}  // namespace
}  // namespace lightproof
