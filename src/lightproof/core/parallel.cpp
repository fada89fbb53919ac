#include "lightproof/core/parallel.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>

#ifdef __SANITIZE_THREAD__
#include <sanitizer/tsan_interface.h>
#endif

#include "lightproof/core/error.h"

namespace lightproof {
namespace {

std::atomic<bool> interrupt_requested = false;
static_assert(std::atomic<bool>::is_always_lock_free);

/// How the thread sanitizer learns that a loop orders memory: it cannot see how a TBB that was not
/// built for it hands work over. What the caller did happens before the tasks, and they before what
/// the caller does next. Each loop has its own, so that nothing is said of unrelated ones.
class Handover {
 public:
#ifdef __SANITIZE_THREAD__
  void give_tasks() { __tsan_release(&tasks_); }
  void take_task() { __tsan_acquire(&tasks_); }
  void give_result() { __tsan_release(&results_); }
  void take_results() { __tsan_acquire(&results_); }

 private:
  char tasks_ = 0;
  char results_ = 0;
#else
  void give_tasks() {}
  void take_task() {}
  void give_result() {}
  void take_results() {}
#endif
};

/// Whether this thread is inside of a task.
thread_local bool in_task = false;

/// A task, or several in a row, on this thread.
class Task {
 public:
  explicit Task(Handover& handover) : handover_(handover) {
    handover_.take_task();
    in_task = true;
  }
  ~Task() {
    in_task = inside_another_;
    handover_.give_result();
  }
  Task(const Task&) = delete;
  Task& operator=(const Task&) = delete;

 private:
  Handover& handover_;
  bool inside_another_ = in_task;
};

void run_tasks(std::size_t count, const std::function<void(std::size_t)>& body) {
  Handover handover;
  handover.give_tasks();
  tbb::task_group_context context;
  context.capture_fp_settings();
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, count, 1),
      [&](const tbb::blocked_range<std::size_t>& range) {
        const Task task(handover);
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
          throw_if_interrupted();
          body(i);
        }
      },
      tbb::simple_partitioner(), context);
  handover.take_results();
  // Called from a task whose own loop has failed, this one ends early without an exception; what
  // it should have written is not there.
  if (context.is_group_execution_cancelled()) throw Interrupted();
}

}  // namespace

void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body) {
  // The outermost loop is not isolated: whoever waits for it holds nothing, and may help inside of
  // the last task.
  if (!in_task) return run_tasks(count, body);
  tbb::this_task_arena::isolate([&] { run_tasks(count, body); });
}

std::size_t thread_count(int threads, unsigned processors) {
  return std::max<std::size_t>(1, threads > 0 ? static_cast<std::size_t>(threads) : processors);
}

struct ThreadLimit::State {
  explicit State(std::size_t threads)
      : control(tbb::global_control::max_allowed_parallelism, threads) {}
  tbb::global_control control;  // must not be copied: each copy ends the limit when it goes
};

ThreadLimit::ThreadLimit(int threads) : state_(std::make_unique<State>(thread_count(threads))) {}

ThreadLimit::~ThreadLimit() = default;

void request_interrupt() { interrupt_requested.store(true, std::memory_order_relaxed); }

void withdraw_interrupt() { interrupt_requested.store(false, std::memory_order_relaxed); }

void throw_if_interrupted() {
  if (interrupt_requested.load(std::memory_order_relaxed)) throw Interrupted();
}

}  // namespace lightproof
