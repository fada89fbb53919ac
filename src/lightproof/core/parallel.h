// Work over threads with results that do not depend on how many there are: each task writes its
// own slot, and whoever called merges the slots in their order. TBB stays inside parallel.cpp.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>
#include <thread>

namespace lightproof {

/// Runs body(0) … body(count-1), each once, in any order. Between tasks it throws Interrupted if
/// request_interrupt() was called. The first exception of a task is passed on; loops inside other
/// tasks are then abandoned with Interrupted, which goes no further. Tasks round as callers do.
///
/// Loops may be nested. A thread that waits inside of a task for an inner loop takes part in that
/// loop alone, and begins no other task of the outer one: what outer tasks hold in memory is held
/// once for each thread at the most. Threads without a task of their own help wherever there is
/// work.
void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body);

/// Items of one task where each is a cell of a table: some 100 microseconds of work.
inline constexpr std::size_t kTaskCells = std::size_t{1} << 16U;

/// How many chunks of `size` items there are.
inline std::size_t chunks_of(std::size_t items, std::size_t size) {
  return (items + size - 1) / size;
}

/// Runs body(chunk, first item, last item + 1) for all chunks of `size` items, as parallel_for
/// does. Where the split may show in the result, the size must not depend on the threads.
template <class Body>
void parallel_chunks(std::size_t items, std::size_t size, const Body& body) {
  parallel_for(chunks_of(items, size), [&](std::size_t chunk) {
    body(chunk, chunk * size, std::min(items, (chunk + 1) * size));
  });
}

/// How many threads `threads` asks for: 0 means as many as there are processors, and one where the
/// system does not say how many there are (0).
std::size_t thread_count(int threads, unsigned processors = std::thread::hardware_concurrency());

/// Limits parallel_for to thread_count(threads) threads while it lives.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Asks running work to stop, and what is started later not to begin; safe inside a signal handler.
void request_interrupt();

/// Takes the request back, once the work that it stopped has ended: what is started from now on
/// runs.
void withdraw_interrupt();

/// Throws Interrupted if request_interrupt() was called.
void throw_if_interrupted();

}  // namespace lightproof
