// What the split sum's errors say, in a sentence.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lightproof/core/measure.h"
#include "lightproof/page/numbers.h"
#include "lightproof/report/findings.h"

namespace lightproof {
namespace {

/// An error that can be seen.
constexpr double kVisible = 0.1;

bool less_wrong(const SplitSumRecord& a, const SplitSumRecord& b) { return a.rmse < b.rmse; }

}  // namespace

double view_degrees(const SplitSumRecord& record) { return record.view_angle * 180.0 / kPi; }

std::string percent_text(double fraction) {
  if (fraction < 1e-4) return "< 0.01 %";
  return format_number(100.0 * fraction, fraction < 0.1 ? 2 : 3) + "\u00a0%";
}

std::string split_sum_finding(const std::vector<SplitSumRecord>& records) {
  const auto worst = std::max_element(records.begin(), records.end(), less_wrong);
  if (worst->rmse < 1e-4) {
    return "The split sum errs by less than 0.01\u00a0% of the mean radiance everywhere";
  }
  const auto visible = static_cast<std::size_t>(std::count_if(
      records.begin(), records.end(), [](const SplitSumRecord& r) { return r.rmse > kVisible; }));
  return fmt::format(
      "The split sum errs by up to {} of the mean radiance ({}, roughness {}, seen at {}\u00b0, F0 "
      "= {}), and by more than {} in {} of {} cases",
      percent_text(worst->rmse), worst->map, significant(worst->roughness),
      std::lround(view_degrees(*worst)), significant(worst->normal_reflectance),
      percent_text(kVisible), visible, records.size());
}

}  // namespace lightproof
