// What the gate finds when it is tested on itself.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "lightproof/results/test_id.h"

namespace lightproof {

/// p-values of one test of a correct sampler: uniform, if the test is.
struct CalibrationRecord {
  TestId test = TestId::bins;
  bool is_bound = false;  ///< its p-values may be too large, never too small
  std::uint64_t replicates = 0;
  std::vector<double> quantiles;           ///< of p, at 0 %, 1 %, … 100 %
  double ks_distance = 0.0;                ///< of their distribution from uniform
  double log10_p_ks = 0.0;                 ///< Kolmogorov-Smirnov; one-sided for a bound
  std::optional<double> log10_p_anderson;  ///< none for a bound
  std::uint64_t below_one_percent = 0;     ///< p-values below 0.01

  static auto fields(auto& record) {
    return std::tie(record.test, record.is_bound, record.replicates, record.quantiles,
                    record.ks_distance, record.log10_p_ks, record.log10_p_anderson,
                    record.below_one_percent);
  }
};

/// How often runs over correct samplers reject anything.
struct FamilyRecord {
  std::string procedure;
  double family_alpha = 0.0;
  std::uint64_t runs = 0;
  std::uint64_t rejected = 0;
  bool is_bound = false;  ///< far from reached, by construction

  static auto fields(auto& record) {
    return std::tie(record.procedure, record.family_alpha, record.runs, record.rejected,
                    record.is_bound);
  }
};

struct CalibrationResult {
  std::vector<CalibrationRecord> tests;
  std::vector<FamilyRecord> families;

  static auto fields(auto& record) { return std::tie(record.tests, record.families); }
};

/// How often a test rejects a distribution that is off by a known effect.
struct PowerRecord {
  TestId test = TestId::bins;
  double effect = 0.0;
  double level = 0.0;  ///< size of the test
  std::uint64_t samples = 0;
  std::uint64_t replicates = 0;
  std::uint64_t rejected = 0;
  double predicted = 0.0;  ///< share that should be rejected
  bool is_bound = false;   ///< at least that share

  static auto fields(auto& record) {
    return std::tie(record.test, record.effect, record.level, record.samples, record.replicates,
                    record.rejected, record.predicted, record.is_bound);
  }
};

/// The fewest samples, of those tried, with which each test rejects one mutant.
struct KillRecord {
  std::string mutant;
  Oracle oracle = Oracle::reference;  ///< that must reject it
  std::string looks_like;
  std::string expected_diagnosis;
  struct Kill {
    TestId test = TestId::bins;
    std::uint64_t samples = 0;

    static auto fields(auto& kill) { return std::tie(kill.test, kill.samples); }
  };
  std::vector<Kill> kills;
  std::optional<std::uint64_t> sequential;  ///< that the sequential gate took; none: accepted

  static auto fields(auto& record) {
    return std::tie(record.mutant, record.oracle, record.looks_like, record.expected_diagnosis,
                    record.kills, record.sequential);
  }
};

/// What the gate calls one mutant on the maps of a study, under both densities.
struct NamingRecord {
  std::string mutant;
  std::string expected;        ///< its name
  std::uint64_t runs = 0;      ///< maps, densities and seeds
  std::uint64_t rejected = 0;  ///< runs in which it was; the others are in no other count
  std::uint64_t right = 0;
  std::uint64_t unknown = 0;  ///< no known defect explains the samples
  std::uint64_t wrong = 0;
  std::vector<std::string> wrong_names = {};  ///< each once

  static auto fields(auto& record) {
    return std::tie(record.mutant, record.expected, record.runs, record.rejected, record.right,
                    record.unknown, record.wrong, record.wrong_names);
  }
};

/// The gate tested on itself.
struct SelfTestResult {
  CalibrationResult calibration;
  std::vector<PowerRecord> power;
  std::vector<KillRecord> mutants;
  std::vector<NamingRecord> naming = {};
  /// When, where and of what calibration, power and mutants were measured; empty if it is not
  /// known.
  std::string origin = {};
  /// The same of `naming`, of the map that was measured first.
  std::string naming_origin = {};

  static auto fields(auto& result) {
    return std::tie(result.calibration, result.power, result.mutants, result.naming, result.origin,
                    result.naming_origin);
  }
};

}  // namespace lightproof
