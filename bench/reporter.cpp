#include "bench/reporter.h"

#include <utility>
#include <vector>

#include "lightproof/core/machine.h"

namespace lightproof::bench {
namespace {

using Runs = std::vector<benchmark::BenchmarkReporter::Run>;

Runs with_ratios(Runs runs) {
  for (benchmark::BenchmarkReporter::Run& run : runs) {
    const bool has_times = run.run_type == benchmark::BenchmarkReporter::Run::RT_Iteration &&
                           !run.error_occurred && run.cpu_accumulated_time > 0.0;
    if (!has_times) continue;
    // What is timed in another process says so itself.
    const auto own = run.counters.find("wall_per_cpu");
    const double ratio = own != run.counters.end()
                             ? own->second.value
                             : run.real_accumulated_time / run.cpu_accumulated_time;
    run.counters["wall_per_cpu"] = ratio;
    if (ratio <= kBusyRatio) continue;
    run.report_label += run.report_label.empty() ? "machine busy" : ", machine busy";
  }
  return runs;
}

/// Passes everything on to another reporter.
class RatioReporter : public benchmark::BenchmarkReporter {
 public:
  explicit RatioReporter(std::unique_ptr<benchmark::BenchmarkReporter> next)
      : next_(std::move(next)) {}

  bool ReportContext(const Context& context) override {
    next_->SetOutputStream(&GetOutputStream());
    next_->SetErrorStream(&GetErrorStream());
    return next_->ReportContext(context);
  }
  void ReportRuns(const Runs& runs) override { next_->ReportRuns(with_ratios(runs)); }
  void Finalize() override { next_->Finalize(); }

 private:
  std::unique_ptr<benchmark::BenchmarkReporter> next_;
};

}  // namespace

std::unique_ptr<benchmark::BenchmarkReporter> display_reporter() {
  return std::make_unique<RatioReporter>(
      std::unique_ptr<benchmark::BenchmarkReporter>(benchmark::CreateDefaultDisplayReporter()));
}

std::unique_ptr<benchmark::BenchmarkReporter> file_reporter() {
  return std::make_unique<RatioReporter>(std::make_unique<benchmark::JSONReporter>());
}

}  // namespace lightproof::bench
