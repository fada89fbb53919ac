#include "lightproof/history/trend.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "lightproof/history/rule.h"
#include "lightproof/history/run_values.h"
#include "lightproof/stats/median.h"

namespace lightproof {
namespace {

/// Everything that a line has one of; in the order of the page.
using Key = std::tuple<std::string, std::string, std::string, Metric, std::string>;

/// The values of one commit, by session.
struct CommitValues {
  std::string commit;
  std::map<std::string, std::vector<double>> sessions;
};

using Lines = std::map<Key, std::vector<CommitValues>>;

CommitValues& values_of(std::vector<CommitValues>& commits, const std::string& commit) {
  const auto found = std::find_if(commits.begin(), commits.end(),
                                  [&](const CommitValues& c) { return c.commit == commit; });
  return found != commits.end() ? *found : commits.emplace_back(CommitValues{commit, {}});
}

void add(Lines& lines, const BenchmarkRun& run) {
  std::map<Key, bool> done;
  for (const Measurement& m : run.measurements) {
    const Key key{run.machine, run.compiler, run.flags, m.metric, m.benchmark};
    if (!done.emplace(key, true).second) continue;
    CommitValues& commit = values_of(lines[key], run.commit);
    commit.sessions[run.session].push_back(*run_value(run, m.metric, m.benchmark));
  }
}

TrendPoint point_of(const CommitValues& commit) {
  std::vector<double> medians;
  std::size_t runs = 0;
  for (const auto& [session, values] : commit.sessions) {
    medians.push_back(median(values));
    runs += values.size();
  }
  return {commit.commit, median(std::move(medians)), runs};
}

std::vector<ChangePoint> steps_of(std::span<const double> values, Metric metric) {
  const RegressionRule rule;
  const double limit =
      1.0 + (metric == Metric::error ? rule.error_effect : rule.instruction_effect);
  std::vector<ChangePoint> steps;
  for (std::size_t i = 1; i < values.size(); ++i) {
    const double ratio = values[i] / values[i - 1];
    if (std::max(ratio, 1.0 / ratio) > limit) steps.push_back({i, ratio, -HUGE_VAL});
  }
  return steps;
}

}  // namespace

std::vector<TrendLine> trend_lines(std::span<const BenchmarkRun> runs, const ChangeRule& rule) {
  Lines by_key;
  for (const BenchmarkRun& run : runs) add(by_key, run);
  std::vector<TrendLine> lines;
  std::vector<std::vector<double>> times;  // empty of an exact metric
  for (const auto& [key, commits] : by_key) {
    const auto& [machine, compiler, flags, metric, benchmark] = key;
    TrendLine line{machine, compiler, flags, benchmark, metric, {}, {}};
    std::vector<double> values;
    for (const CommitValues& commit : commits) {
      line.points.push_back(point_of(commit));
      values.push_back(line.points.back().value);
    }
    if (is_exact(metric)) {
      line.changes = steps_of(values, metric);
      values.clear();
    }
    lines.push_back(std::move(line));
    times.push_back(std::move(values));
  }
  std::vector<std::vector<ChangePoint>> changes = change_points(times, rule);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (!is_exact(lines[i].metric)) lines[i].changes = std::move(changes[i]);
  }
  return lines;
}

}  // namespace lightproof
