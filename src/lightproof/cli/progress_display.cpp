#include "progress_display.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <condition_variable>
#include <cstdio>
#include <exception>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "messages.h"

namespace lightproof::cli {
namespace {

using Clock = std::chrono::steady_clock;

std::string time_text(long seconds) {
  if (seconds < 60) return fmt::format("{} s", seconds);
  if (seconds < 3600) return fmt::format("{} min {} s", seconds / 60, seconds % 60);
  return fmt::format("{} h {} min", seconds / 3600, seconds / 60 % 60);
}

/// How long what is done will take. Work in several parts, each of which counts from 0 to 1, has
/// the time of the part that is under way.
class Forecast {
 public:
  void see(double fraction) {
    // Threads may report a little out of order.
    if (fraction < fraction_ - 0.05) start_ = Clock::now();
    fraction_ = fraction;
  }
  /// ", 2 min 5 s left", if enough is done to say so.
  std::string time_left() const {
    if (fraction_ <= 0.01) return "";
    const double spent = std::chrono::duration<double>(Clock::now() - start_).count();
    return fmt::format(", {} left", time_text(std::lround(spent * (1.0 / fraction_ - 1.0))));
  }

 private:
  Clock::time_point start_ = Clock::now();
  double fraction_ = 0.0;
};

/// Draws the bar at most ten times a second.
class Bar {
 public:
  Bar() = default;
  ~Bar() { std::fputs("\r\033[K", stderr); }
  Bar(const Bar&) = delete;
  Bar& operator=(const Bar&) = delete;

  void show(std::string_view step, double fraction) {
    const std::lock_guard lock(mutex_);
    forecast_.see(fraction);
    const auto now = Clock::now();
    if (fraction < 1.0 && now - shown_ < std::chrono::milliseconds(100)) return;
    shown_ = now;
    constexpr int kWidth = 30;
    const int full = std::clamp(static_cast<int>(fraction * kWidth), 0, kWidth);
    tell("\r\033[K[{:#<{}}{:.<{}}] {:3.0f} %  {}{}", "", full, "", kWidth - full, 100.0 * fraction,
         step, forecast_.time_left());
  }

 private:
  std::mutex mutex_;
  Forecast forecast_;
  Clock::time_point shown_;
};

/// Prints a line every interval, from a thread of its own: one step of the work may take longer.
class Lines {
 public:
  explicit Lines(std::chrono::seconds interval)
      : printer_([this, interval](const std::stop_token& stop) { print_every(interval, stop); }) {}

  ~Lines() {
    const std::lock_guard lock(mutex_);
    if (steps_ > 1 && std::uncaught_exceptions() == 0) end_step();
  }
  Lines(const Lines&) = delete;
  Lines& operator=(const Lines&) = delete;

  void show(std::string_view step, double fraction) {
    const std::lock_guard lock(mutex_);
    if (step_ != step) {
      end_step();
      ++steps_;
      step_ = step;
      step_start_ = Clock::now();
    }
    fraction_ = fraction;
    forecast_.see(fraction);
  }

 private:
  /// Says how long it took, of every step that took a second or more.
  void end_step() const {
    const std::chrono::duration<double> spent = Clock::now() - step_start_;
    if (step_.empty() || spent.count() < 1.0) return;
    tell("{}: done in {:.1f} s\n", step_, spent.count());
  }

  void print_every(std::chrono::seconds interval, const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    while (!stop.stop_requested()) {
      ended_.wait_for(lock, stop, interval, [] { return false; });
      if (stop.stop_requested()) return;
      tell("{}: {:.0f} %{}\n", step_.empty() ? "starting" : step_, 100.0 * fraction_,
           forecast_.time_left());
    }
  }

  std::mutex mutex_;
  std::condition_variable_any ended_;
  Forecast forecast_;
  Clock::time_point step_start_ = Clock::now();
  std::string step_;
  int steps_ = 0;
  double fraction_ = 0.0;
  std::jthread printer_;  ///< last: it uses the others
};

template <class Display>
Progress shown_on(std::shared_ptr<Display> display) {
  return [display = std::move(display)](std::string_view step, double fraction) {
    display->show(step, fraction);
  };
}

}  // namespace

Progress progress_display(std::chrono::seconds interval) {
  if (isatty(STDERR_FILENO) != 0) return shown_on(std::make_shared<Bar>());
  if (interval.count() == 0) return {};
  return shown_on(std::make_shared<Lines>(interval));
}

}  // namespace lightproof::cli
