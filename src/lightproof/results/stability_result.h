// How methods stand up to hard inputs: what was put in and what came out, method by method, and
// where each of them first fails.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "lightproof/core/enumeration.h"

namespace lightproof {

/// What came out of a method that got a hard input.
enum class StabilityOutcome {
  right,           ///< what was required
  wrong,           ///< off by more than was allowed: `amount` against `bound`
  not_a_number,    ///< NaN, or infinite where a finite number was required
  out_of_range,    ///< a texel, an index or a coordinate that does not exist
  refused,         ///< nothing came out but a message
  not_applicable,  ///< the method makes no such promise, for a reason that is told
};

template <>
inline constexpr std::size_t kValuesOf<StabilityOutcome> = 6;

/// The name of an outcome where it is printed or written: "out-of-range".
constexpr const char* to_string(StabilityOutcome outcome) {
  switch (outcome) {
    case StabilityOutcome::right:
      return "right";
    case StabilityOutcome::wrong:
      return "wrong";
    case StabilityOutcome::not_a_number:
      return "not-a-number";
    case StabilityOutcome::out_of_range:
      return "out-of-range";
    case StabilityOutcome::refused:
      return "refused";
    case StabilityOutcome::not_applicable:
      return "not-applicable";
  }
  return "";
}

/// A hard input, and the behaviour that is required of every method that it applies to.
struct StabilityCaseRecord {
  int number = 0;
  std::string name;
  std::string input;
  std::string required;
  std::string source;  ///< paper, book, lecture or measurement that it comes from

  static auto fields(auto& r) { return std::tie(r.number, r.name, r.input, r.required, r.source); }
};

/// What one method made of one hard input.
struct StabilityRecord {
  int number = 0;              ///< of the case
  std::string kind;            ///< of the method: "sampler"
  std::string method;          ///< "alias/B"
  bool known_defects = false;  ///< whether the method is kept as published
  StabilityOutcome outcome = StabilityOutcome::right;
  double amount = 0.0;  ///< how far off, in the unit of the case; 0 where nothing was measured
  double bound = 0.0;   ///< how far off it may be
  std::string put_in;
  std::string came_out;     ///< in words; of a refusal its message, of one that does not apply why
  bool may_refuse = false;  ///< whether a refusal is what is required
  /// Why the method cannot pass by its nature; empty if it claims that it does.
  std::string limit;

  static auto fields(auto& r) {
    return std::tie(r.number, r.kind, r.method, r.known_defects, r.outcome, r.amount, r.bound,
                    r.put_in, r.came_out, r.may_refuse, r.limit);
  }
};

/// Whether what came out is what the case requires, or the case does not apply.
inline bool passes(const StabilityRecord& record) {
  if (record.outcome == StabilityOutcome::refused) return record.may_refuse;
  return record.outcome == StabilityOutcome::right ||
         record.outcome == StabilityOutcome::not_applicable;
}

/// Whether a method fails that claims to pass: neither kept as published, nor declared unable.
inline bool breaks_claim(const StabilityRecord& record) {
  return !passes(record) && !record.known_defects && record.limit.empty();
}

/// Where a method first fails as an input is made harder, step by step.
struct BreakingPoint {
  std::string quantity;   ///< what is made harder: "contrast"
  std::string criterion;  ///< what the method must do, in words
  std::string kind;       ///< of the method: "sampler"
  std::string method;
  bool known_defects = false;
  double easiest = 1.0;  ///< the value at which the search began
  double hardest = 1.0;  ///< the value at which it would have ended
  /// The hardest value at which it is known to have passed before it first failed; none if it
  /// failed at the easiest.
  std::optional<double> passed;
  /// The easiest value at which it is known to fail; none if it passed at the hardest. Between the
  /// two lies the breaking point: the search went no further.
  std::optional<double> failed;

  static auto fields(auto& r) {
    return std::tie(r.quantity, r.criterion, r.kind, r.method, r.known_defects, r.easiest,
                    r.hardest, r.passed, r.failed);
  }
};

/// What was found of all methods.
struct StabilityResult {
  std::vector<StabilityCaseRecord> cases;
  std::vector<StabilityRecord> records;  ///< by case, then by kind and method
  std::vector<BreakingPoint> breaking_points;

  static auto fields(auto& r) { return std::tie(r.cases, r.records, r.breaking_points); }
};

}  // namespace lightproof
