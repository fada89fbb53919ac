// What one test of the gate found, as a plain value.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>

#include "lightproof/results/outcome.h"
#include "lightproof/results/test_id.h"

namespace lightproof {

/// Stands where the map's name would in records of distributions that need no map.
inline constexpr std::string_view kDirections = "directions";

/// Probability with which the minimum detectable effect of a test is found.
inline constexpr double kDetectionPower = 0.99;

/// The root mean square deviation of the bins, relative to their expectations, that an accepting
/// run must have been able to see with kDetectionPower, unless another one is asked for.
inline constexpr double kMustDetect = 0.1;

/// One test of one run.
struct TestRecord {
  std::string sampler;
  /// "A" (texture-space), "B" (solid-angle), "C" (sine-weighted); empty for distributions over
  /// directions.
  std::string density_space;
  std::string map;  ///< the map's name, or kDirections
  TestId test = TestId::bins;
  std::uint64_t samples = 0;
  double statistic = 0.0;
  double dof = 0.0;               ///< degrees of freedom; 0 where they have no meaning
  std::optional<double> log10_p;  ///< log10 of the p-value; none for a deterministic check
  double effect = 0.0;            ///< size of the deviation that was seen, an EffectMeasure
  /// The effect that is found with kDetectionPower at this run's alpha.
  std::optional<double> minimum_detectable_effect;
  Outcome outcome = Outcome::inconclusive;
  std::string detail;       ///< why, in words; empty if there is nothing to say
  std::uint64_t seed = 0;   ///< base seed of the samples
  std::string source = {};  ///< what the user called the map; empty: its name
  /// 1, or 2 if the test was run again, with more samples, because its p-value fell below the
  /// screening level.
  int stage = 1;
  bool known_defect = false;  ///< whether the sampler is kept as published, with its defects
  /// The effect below which the sampler's own rounding shows; of texels and rows of distributions
  /// that are added up.
  std::optional<double> resolution_floor = {};

  static auto fields(auto& record) {
    return std::tie(record.sampler, record.density_space, record.map, record.test, record.samples,
                    record.statistic, record.dof, record.log10_p, record.effect,
                    record.minimum_detectable_effect, record.outcome, record.detail, record.seed,
                    record.source, record.stage, record.known_defect, record.resolution_floor);
  }
};

}  // namespace lightproof
