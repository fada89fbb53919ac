#include "lightproof/history/run_values.h"

#include <vector>

#include "lightproof/stats/median.h"

namespace lightproof {

std::optional<double> run_value(const BenchmarkRun& run, Metric metric,
                                const std::string& benchmark) {
  std::vector<double> values;
  for (const Measurement& m : run.measurements) {
    if (m.metric == metric && m.benchmark == benchmark) values.push_back(m.value);
  }
  if (values.empty()) return std::nullopt;
  return median(std::move(values));
}

}  // namespace lightproof
