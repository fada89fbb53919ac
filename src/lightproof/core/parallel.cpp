#include "lightproof/core/parallel.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <thread>

#include "lightproof/core/error.h"

namespace lightproof {
namespace {

std::atomic<bool> interrupt_requested = false;
static_assert(std::atomic<bool>::is_always_lock_free);

}  // namespace

void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body) {
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, count, 1),
      [&](const tbb::blocked_range<std::size_t>& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
          throw_if_interrupted();
          body(i);
        }
      },
      tbb::simple_partitioner());
}

struct ThreadLimit::State {
  tbb::global_control control;
};

ThreadLimit::ThreadLimit(int threads)
    : state_(std::make_unique<State>(
          State{tbb::global_control(tbb::global_control::max_allowed_parallelism,
                                    threads > 0 ? static_cast<std::size_t>(threads)
                                                : std::thread::hardware_concurrency())})) {}

ThreadLimit::~ThreadLimit() = default;

void request_interrupt() { interrupt_requested.store(true, std::memory_order_relaxed); }

void throw_if_interrupted() {
  if (interrupt_requested.load(std::memory_order_relaxed)) throw Interrupted();
}

}  // namespace lightproof
