// Threads in the place of processes that share work.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "lightproof/core/executor.h"

namespace lightproof::test {

/// What all_gather of `of` processes needs: each hands in its bytes and waits for the others'.
class Exchange {
 public:
  explicit Exchange(std::size_t of) : handed_in_(of) {}

  std::vector<std::string> all_gather(std::size_t index, std::string bytes) {
    std::unique_lock lock(mutex_);
    handed_in_[index] = std::move(bytes);
    const std::size_t round = round_;
    if (++arrived_ == handed_in_.size()) {
      gathered_ = handed_in_;
      arrived_ = 0;
      ++round_;
      all_there_.notify_all();
    }
    all_there_.wait(lock, [&] { return round_ != round; });
    return gathered_;
  }

 private:
  std::mutex mutex_;
  std::condition_variable all_there_;
  std::vector<std::string> handed_in_;
  std::vector<std::string> gathered_;  ///< of the last round: nobody begins another one alone
  std::size_t arrived_ = 0;
  std::size_t round_ = 0;
};

/// run(communicator) of so many processes, and what each returns.
template <class Run>
auto in_processes(std::size_t of, const Run& run) {
  Exchange exchange(of);
  std::vector<decltype(run(Communicator()))> results(of);
  {
    std::vector<std::jthread> processes;
    for (std::size_t index = 0; index < of; ++index) {
      processes.emplace_back([&, index] {
        const Communicator communicator = {{index, of}, [&exchange, index](std::string bytes) {
                                             return exchange.all_gather(index, std::move(bytes));
                                           }};
        results[index] = run(communicator);
      });
    }
  }
  return results;
}

}  // namespace lightproof::test
