#include "lightproof/history/rule.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "lightproof/stats/mann_whitney.h"
#include "lightproof/stats/median.h"

namespace lightproof {
namespace {

double noise_of(std::span<const double> base, std::size_t head_runs) {
  std::vector<double> logs;
  for (const double value : base) logs.push_back(std::log(value));
  const double runs_ratio = static_cast<double>(base.size()) / static_cast<double>(head_runs);
  return median_error(std::move(logs)) * std::sqrt(1.0 + runs_ratio);
}

Change change_of(const Judgement& judgement, double log10_slower, double log10_faster,
                 double alpha) {
  const double level = std::log10(alpha);
  if (judgement.ratio > judgement.limit && log10_slower <= level) return Change::slower;
  if (1.0 / judgement.ratio > judgement.limit && log10_faster <= level) return Change::faster;
  return Change::none;
}

}  // namespace

Judgement judge(Metric metric, std::span<const double> base, std::span<const double> head,
                const RegressionRule& rule) {
  Judgement result;
  result.base_runs = base.size();
  result.head_runs = head.size();
  result.base = median({base.begin(), base.end()});
  result.head = median({head.begin(), head.end()});
  result.ratio = result.head / result.base;
  if (is_exact(metric)) {
    result.limit = 1.0 + (metric == Metric::error ? rule.error_effect : rule.instruction_effect);
    result.change = change_of(result, -HUGE_VAL, -HUGE_VAL, rule.alpha);
    return result;
  }
  result.noise = noise_of(base, head.size());
  result.limit = std::max(1.0 + rule.least_effect, std::exp(rule.noise_factor * result.noise));
  result.log10_p = mann_whitney_larger(base, head).log10_p;
  result.change =
      change_of(result, *result.log10_p, mann_whitney_larger(head, base).log10_p, rule.alpha);
  return result;
}

bool enough_runs(std::size_t base, std::size_t head, const RegressionRule& rule) {
  return log10_least_mann_whitney(base, head) <= std::log10(rule.alpha);
}

std::size_t least_runs(const RegressionRule& rule) {
  std::size_t runs = 1;
  while (!enough_runs(runs, runs, rule)) ++runs;
  return runs;
}

}  // namespace lightproof
