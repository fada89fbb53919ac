#include "lightproof/core/parallel.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <thread>

#ifdef __SANITIZE_THREAD__
#include <sanitizer/tsan_interface.h>
#endif

#include "lightproof/core/error.h"

namespace lightproof {
namespace {

std::atomic<bool> interrupt_requested = false;
static_assert(std::atomic<bool>::is_always_lock_free);

// The thread sanitizer cannot see how a TBB that was not built for it hands work over, so it is
// told: what the caller did happens before the tasks, and they before what the caller does next.
#ifdef __SANITIZE_THREAD__
char handed_out;
char handed_back;
void give(char& token) { __tsan_release(&token); }
void take(char& token) { __tsan_acquire(&token); }
#define LIGHTPROOF_HANDOVER(action, token) action(token)
#else
#define LIGHTPROOF_HANDOVER(action, token) static_cast<void>(0)
#endif

}  // namespace

void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body) {
  LIGHTPROOF_HANDOVER(give, handed_out);
  tbb::task_group_context context;
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, count, 1),
      [&](const tbb::blocked_range<std::size_t>& range) {
        LIGHTPROOF_HANDOVER(take, handed_out);
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
          throw_if_interrupted();
          body(i);
        }
        LIGHTPROOF_HANDOVER(give, handed_back);
      },
      tbb::simple_partitioner(), context);
  LIGHTPROOF_HANDOVER(take, handed_back);
  // Called from a task whose own loop has failed, this one ends early without an exception; what
  // it should have written is not there.
  if (context.is_group_execution_cancelled()) throw Interrupted();
}

struct ThreadLimit::State {
  explicit State(std::size_t threads)
      : control(tbb::global_control::max_allowed_parallelism, threads) {}
  tbb::global_control control;  // must not be copied: each copy ends the limit when it goes
};

ThreadLimit::ThreadLimit(int threads)
    : state_(std::make_unique<State>(threads > 0 ? static_cast<std::size_t>(threads)
                                                 : std::thread::hardware_concurrency())) {}

ThreadLimit::~ThreadLimit() = default;

void request_interrupt() { interrupt_requested.store(true, std::memory_order_relaxed); }

void throw_if_interrupted() {
  if (interrupt_requested.load(std::memory_order_relaxed)) throw Interrupted();
}

}  // namespace lightproof
