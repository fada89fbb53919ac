#include "lightproof/core/parallel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
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

TEST(ParallelFor, WorksAfterAnException) {
  const auto failing = [](std::size_t) { throw InputError("all"); };
  EXPECT_THROW(parallel_for(8, failing), InputError);
  std::atomic<int> runs = 0;
  parallel_for(8, [&](std::size_t) { ++runs; });
  EXPECT_EQ(runs, 8);
}

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

int exit_code_after_interrupt() {
  std::atomic<int> runs = 0;
  try {
    const ThreadLimit limit(1);
    parallel_for(1000, [&](std::size_t) {
      if (++runs == 10) request_interrupt();
    });
  } catch (const Interrupted&) {
    return runs == 10 ? 130 : 1;
  }
  return 0;
}

TEST(InterruptDeathTest, StopsParallelWorkBetweenTasks) {
  // In a process of its own: a request for interruption is never taken back.
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(std::_Exit(exit_code_after_interrupt()), testing::ExitedWithCode(130), "");
}

TEST(Interrupt, IsNotThereUnasked) { EXPECT_NO_THROW(throw_if_interrupted()); }

}  // namespace
}  // namespace lightproof
