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
  bool is_bound = false;          ///< whether its p-values may be too large (never too small)
  std::uint64_t replicates = 0;   ///< how many p-values there are
  std::vector<double> quantiles;  ///< quantiles of the p-values at 0 %, 1 %, … 100 %
  double ks_distance = 0.0;       ///< largest distance of their distribution from uniform
  double log10_p_ks = 0.0;        ///< Kolmogorov-Smirnov test of it; one-sided for a bound
  std::optional<double> log10_p_anderson;  ///< Anderson-Darling test of it; none for a bound
  std::uint64_t below_one_percent = 0;     ///< how many p-values are below 0.01

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
  bool is_bound = false;  ///< whether family_alpha is a bound that is far from reached

  static auto fields(auto& record) {
    return std::tie(record.procedure, record.family_alpha, record.runs, record.rejected,
                    record.is_bound);
  }
};

/// What the gate's tests make of correct samplers.
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
  bool is_bound = false;   ///< whether that share is only the least that should be

  static auto fields(auto& record) {
    return std::tie(record.test, record.effect, record.level, record.samples, record.replicates,
                    record.rejected, record.predicted, record.is_bound);
  }
};

/// The fewest samples, of those tried, with which each test rejects one mutant.
struct KillRecord {
  std::string mutant;
  Oracle oracle = Oracle::reference;  ///< the oracle that must reject it
  std::string looks_like;             ///< the name that the diagnosis gives
  std::string expected_diagnosis;     ///< the name that it should give
  /// The fewest samples with which one test rejects the mutant.
  struct Kill {
    TestId test = TestId::bins;
    std::uint64_t samples = 0;

    static auto fields(auto& kill) { return std::tie(kill.test, kill.samples); }
  };
  std::vector<Kill> kills;
  std::optional<std::uint64_t> sequential;  ///< the sequential gate's samples; none: accepted

  static auto fields(auto& record) {
    return std::tie(record.mutant, record.oracle, record.looks_like, record.expected_diagnosis,
                    record.kills, record.sequential);
  }
};

/// What the gate calls one mutant on the maps of a study, under all densities.
struct NamingRecord {
  std::string mutant;
  std::string expected;        ///< the name that the gate should give it
  std::uint64_t runs = 0;      ///< runs: maps times densities times seeds
  std::uint64_t rejected = 0;  ///< runs that rejected it; the counts below are of these alone
  std::uint64_t right = 0;     ///< runs that gave it its name
  std::uint64_t unknown = 0;   ///< runs in which no known defect explains the samples
  std::uint64_t wrong = 0;     ///< runs that gave it another name
  std::vector<std::string> wrong_names = {};  ///< the other names, each once

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
  /// When, where and of what `naming` was measured, of the map that was measured first; empty if it
  /// is not known.
  std::string naming_origin = {};

  static auto fields(auto& result) {
    return std::tie(result.calibration, result.power, result.mutants, result.naming, result.origin,
                    result.naming_origin);
  }
};

}  // namespace lightproof
