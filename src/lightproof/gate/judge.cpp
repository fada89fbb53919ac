#include "lightproof/gate/judge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "lightproof/gate/records.h"
#include "lightproof/stats/family.h"

namespace lightproof {
namespace {

/// Probability with which an effect as large as the minimum detectable one is seen in each stage.
constexpr double kStagePower = 0.5 * (1.0 + kDetectionPower);

double immediate_level_of(const GateOptions& options, std::size_t tests) {
  // What is rejected immediately lies below the screening level as well.
  return std::min({options.immediate_level, options.screening_level,
                   0.5 * strictest_level(options.family_alpha, tests)});
}

}  // namespace

bool ConfirmationRange::operator()(const Measured& test) const {
  const std::optional<double>& log10_p = test.record.log10_p;
  return log10_p && *log10_p < std::log10(to) && *log10_p >= std::log10(from);
}

Judge::Judge(const GateOptions& options, std::size_t family)
    : screening_level_(options.screening_level),
      immediate_level_(immediate_level_of(options, family)),
      second_alpha_(0.5 * options.family_alpha),
      second_level_(strictest_level(second_alpha_, family)),
      family_(family),
      must_detect_(options.must_detect) {}

void Judge::operator()(std::span<Measured* const> tests) const {
  std::vector<double> second;
  for (const Measured* test : tests) {
    const TestRecord& record = test->record;
    if (record.stage == 2 && record.log10_p) second.push_back(*record.log10_p);
  }
  const std::vector<bool> rejected = holm_rejections(second, second_alpha_, family_);
  std::size_t next = 0;
  for (Measured* test : tests) {
    TestRecord& record = test->record;
    record.minimum_detectable_effect = minimum_detectable_effect(*test);
    if (!record.log10_p) continue;
    const bool reject =
        record.stage == 2 ? rejected[next++] : !(*record.log10_p >= std::log10(immediate_level_));
    record.outcome = reject ? Outcome::reject : Outcome::accept;
    if (!reject && record.minimum_detectable_effect &&
        record.resolution_floor.value_or(0.0) > *record.minimum_detectable_effect) {
      record.outcome = Outcome::resolution_limited;
      record.detail = fmt::format("the sampler's own rounding makes an effect of {:.3g}",
                                  *record.resolution_floor);
    }
    require_power(record, must_detect_);
  }
}

/// The effect that both stages see with kStagePower each, and so together with kDetectionPower; of
/// a source that has nothing left to confirm with, the effect that is rejected immediately. None
/// where it is infinite or cannot be computed.
std::optional<double> Judge::minimum_detectable_effect(const Measured& test) const {
  if (!test.detectable) return std::nullopt;
  const auto first = static_cast<double>(test.stages.screening);
  const auto second = static_cast<double>(test.stages.confirmation);
  const DetectableEffect& effect_of = *test.detectable;
  double effect = INFINITY;
  const auto failure = failure_of([&] {
    effect = test.stages.confirmation == 0
                 ? minimum_detectable(effect_of, immediate_level_, kDetectionPower, first)
                 : std::max(minimum_detectable(effect_of, screening_level_, kStagePower, first),
                            minimum_detectable(effect_of, second_level_, kStagePower, second));
  });
  return !failure && std::isfinite(effect) ? std::optional(effect) : std::nullopt;
}

}  // namespace lightproof
