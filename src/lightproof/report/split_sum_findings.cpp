// What the split sum's errors say, in a sentence.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "lightproof/core/measure.h"
#include "lightproof/page/numbers.h"
#include "lightproof/report/findings.h"

namespace lightproof {
namespace {

/// An error to whose square finer detail may add more than this share is only a lower bound.
constexpr double kSureShare = 0.2;

bool less_wrong(const SplitSumRecord& a, const SplitSumRecord& b) { return a.rmse < b.rmse; }

}  // namespace

double view_degrees(const SplitSumRecord& record) { return record.view_angle * 180.0 / kPi; }

std::string percent_text(double fraction) {
  if (fraction < 1e-4) return "< 0.01\u00a0%";
  return format_number(100.0 * fraction, fraction < 0.1 ? 2 : 3) + "\u00a0%";
}

std::string plain_number(double value) { return fmt::format("{:.4g}", value); }

std::string split_sum_text(const SplitSumRecord& record) {
  const bool is_sure = record.left_out * record.left_out <= kSureShare * record.rmse * record.rmse;
  return (is_sure || record.rmse < 1e-4 ? "" : "\u2265 ") + percent_text(record.rmse);
}

std::string split_sum_finding(const std::vector<SplitSumRecord>& records) {
  const auto worst = std::max_element(records.begin(), records.end(), less_wrong);
  if (worst->rmse < 1e-4) {
    return "The split sum errs by less than 0.01\u00a0% of the mean radiance everywhere";
  }
  const auto point_text = [](const SplitSumRecord& r) {
    return fmt::format("{}, roughness {}, F0 = {}", r.map, plain_number(r.roughness),
                       plain_number(r.normal_reflectance));
  };
  const std::string whole = fmt::format(
      "The split sum errs by up to {} of the mean radiance at {}\u00b0 from the normal "
      "({})",
      percent_text(worst->rmse), std::lround(view_degrees(*worst)), point_text(*worst));
  std::vector<SplitSumRecord> along;
  std::copy_if(records.begin(), records.end(), std::back_inserter(along),
               [](const SplitSumRecord& r) { return r.view_angle == 0.0; });
  if (along.empty() || worst->view_angle == 0.0) return whole;
  const auto normal = std::max_element(along.begin(), along.end(), less_wrong);
  return fmt::format("{}, and along it by up to {} ({})", whole, percent_text(normal->rmse),
                     point_text(*normal));
}

}  // namespace lightproof
