#include "lightproof/suite/gate.h"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "lightproof/core/parallel.h"
#include "lightproof/stats/family.h"
#include "lightproof/stats/tails.h"
#include "lightproof/suite/configuration.h"
#include "lightproof/suite/diagnosis.h"

namespace lightproof {
namespace {

/// Below this p-value a test is run again.
constexpr double kSuspicious = 1e-3;
/// Below this one it is rejected without.
constexpr double kAtOnce = 1e-10;
/// Samples of the second stage, in those of the first.
constexpr std::uint64_t kSecondStage = 4;
/// Probability with which an effect as large as `detectable` is seen in each stage.
constexpr double kStagePower = 0.995;

double level_at_once(double family_alpha, std::size_t tests) {
  return std::min(kAtOnce, 0.5 * strictest_level(family_alpha, tests));
}

/// The records of one configuration, and the draws behind them if they may be needed for a
/// diagnosis.
struct Slot {
  std::vector<TestRecord> records;
  std::optional<Draws> draws;
  OwnDensity own;
};

Slot run_first(const Configuration& configuration, const Expectation& expectation,
               std::uint64_t samples) {
  const BoundSampler sampler = configuration.candidate->bind();
  const OwnDensity own = integrate_pdf(sampler, expectation.masses.extent());
  Draws draws = draw_samples(sampler, expectation, configuration.stream("draws"), samples);
  Slot slot{test_draws(configuration, expectation, own, draws), std::nullopt, own};
  auto exact = test_exactly(configuration, expectation, sampler, own, draws);
  std::move(exact.begin(), exact.end(), std::back_inserter(slot.records));
  const bool clean = std::all_of(slot.records.begin(), slot.records.end(), [](const auto& r) {
    return r.log10_p ? *r.log10_p >= std::log10(kSuspicious) : r.outcome == Outcome::accept;
  });
  if (!clean) slot.draws = std::move(draws);
  return slot;
}

/// Suspicious tests of a slot get the records of new samples in their place.
void run_again(const Configuration& configuration, const Expectation& expectation,
               std::uint64_t samples, double at_once, Slot& slot) {
  const auto is_open = [&](const TestRecord& r) {
    return r.log10_p && *r.log10_p < std::log10(kSuspicious) && *r.log10_p >= std::log10(at_once);
  };
  if (std::none_of(slot.records.begin(), slot.records.end(), is_open)) return;
  const BoundSampler sampler = configuration.candidate->bind();
  const OwnDensity own = integrate_pdf(sampler, expectation.masses.extent());
  const Draws draws = draw_samples(sampler, expectation, configuration.stream("draws again"),
                                   kSecondStage * samples);
  const auto again = test_draws(configuration, expectation, own, draws);
  for (TestRecord& record : slot.records) {
    if (!is_open(record)) continue;
    const auto same = std::find_if(again.begin(), again.end(), [&](const TestRecord& r) {
      return r.oracle == record.oracle && r.test == record.test;
    });
    if (same == again.end()) continue;
    record = *same;
    record.stage = 2;
  }
}

/// The effect that both stages see with kStagePower each, a hundredth less together.
double detectable_effect(const TestRecord& test, double second_level, std::uint64_t samples) {
  const auto needed = [&](double level) {
    return test.dof > 0.0 ? std::sqrt(detectable_noncentrality(test.dof, level, kStagePower))
                          : detectable_z(level, kStagePower);
  };
  const double roots = std::sqrt(static_cast<double>(kSecondStage));
  const double worst = std::max(needed(kSuspicious), needed(second_level) / roots);
  if (test.dof > 0.0) return worst / std::sqrt(static_cast<double>(samples));
  // A standard error of the mean, at the samples of the record's own stage.
  return worst * *test.detectable_effect * (test.stage == 2 ? roots : 1.0);
}

/// Turns p-values into outcomes, and standard errors into detectable effects.
void judge(GateResult& result) {
  const std::size_t tests = static_cast<std::size_t>(
      std::count_if(result.tests.begin(), result.tests.end(),
                    [](const TestRecord& test) { return test.log10_p.has_value(); }));
  std::vector<double> second;
  for (const TestRecord& test : result.tests) {
    if (test.stage == 2) second.push_back(*test.log10_p);
  }
  const std::vector<bool> rejected = holm_rejections(second, 0.5 * result.family_alpha);
  const double at_once = std::log10(level_at_once(result.family_alpha, tests));
  const double second_level = strictest_level(0.5 * result.family_alpha, tests);
  std::size_t next = 0;
  for (TestRecord& test : result.tests) {
    if (!test.log10_p) continue;
    const bool reject = test.stage == 2 ? rejected[next++] : !(*test.log10_p >= at_once);
    test.outcome = reject ? Outcome::reject : Outcome::accept;
    if (test.dof > 0.0 || test.detectable_effect) {
      test.detectable_effect = detectable_effect(test, second_level, result.samples);
    }
  }
}

/// Problems, and what is known of their candidates.
class Run {
 public:
  Run(std::span<const Problem> problems, const GateOptions& options, const Progress& progress)
      : problems_(problems), options_(options), progress_(progress) {
    for (const Problem& problem : problems) slots_.emplace_back(problem.candidates.size());
  }

  GateResult operator()() {
    if (progress_) progress_("gate", 0.0);
    parallel_for(problems_.size(), [&](std::size_t i) {
      const Expectation expectation = problems_[i].expectation();
      for_each_candidate(i, [&](const Configuration& configuration, Slot& slot) {
        slot = run_first(configuration, expectation, options_.samples);
        show_progress();
      });
    });
    const double at_once = level_at_once(options_.family_alpha, count_p_values());
    parallel_for(problems_.size(), [&](std::size_t i) {
      const bool clean = std::none_of(slots_[i].begin(), slots_[i].end(),
                                      [](const Slot& slot) { return slot.draws.has_value(); });
      if (clean) return;
      const Expectation expectation = problems_[i].expectation();
      for_each_candidate(i, [&](const Configuration& configuration, Slot& slot) {
        run_again(configuration, expectation, options_.samples, at_once, slot);
      });
    });
    return collect();
  }

 private:
  template <class Body>
  void for_each_candidate(std::size_t problem, const Body& body) {
    const std::vector<Candidate>& candidates = problems_[problem].candidates;
    parallel_for(candidates.size(), [&](std::size_t i) {
      body(Configuration{&problems_[problem], &candidates[i], options_.seed}, slots_[problem][i]);
    });
  }

  void show_progress() {
    const std::lock_guard lock(mutex_);
    ++done_;
    if (!progress_) return;
    std::size_t all = 0;
    for (const auto& slots : slots_) all += slots.size();
    progress_("gate", static_cast<double>(done_) / static_cast<double>(all));
  }

  std::size_t count_p_values() const {
    std::size_t count = 0;
    for (const auto& slots : slots_) {
      for (const Slot& slot : slots) {
        for (const TestRecord& record : slot.records) count += record.log10_p ? 1 : 0;
      }
    }
    return count;
  }

  GateResult collect() {
    GateResult result{options_.family_alpha, options_.samples, options_.seed, {}, {}};
    for (const auto& slots : slots_) {
      for (const Slot& slot : slots) {
        result.tests.insert(result.tests.end(), slot.records.begin(), slot.records.end());
      }
    }
    judge(result);
    std::span<const TestRecord> rest = result.tests;
    for (std::size_t i = 0; i < problems_.size(); ++i) {
      for (const Slot& slot : slots_[i]) {
        const auto records = rest.first(slot.records.size());
        rest = rest.subspan(records.size());
        if (std::any_of(records.begin(), records.end(),
                        [](const auto& r) { return r.outcome == Outcome::reject; })) {
          result.rejections.push_back(diagnose(problems_[i], problems_[i].expectation(),
                                               {records, &*slot.draws, &slot.own}));
        }
      }
    }
    return result;
  }

  std::span<const Problem> problems_;
  GateOptions options_;
  Progress progress_;
  std::vector<std::vector<Slot>> slots_;  ///< by problem and candidate
  std::mutex mutex_;
  std::size_t done_ = 0;
};

}  // namespace

GateResult run_gate(std::span<const Problem> problems, const GateOptions& options,
                    const Progress& progress) {
  return Run(problems, options, progress)();
}

GateResult run_gate(std::span<const EnvironmentMap> maps, std::span<const Subject> subjects,
                    const GateOptions& options, const Progress& progress) {
  return run_gate(problems_of(maps, subjects), options, progress);
}

Outcome overall_outcome(const GateResult& result, bool count_known_defects) {
  Outcome overall = Outcome::accept;
  for (const TestRecord& test : result.tests) {
    if (test.known_defect && !count_known_defects) continue;
    if (test.outcome == Outcome::reject) return Outcome::reject;
    if (test.outcome == Outcome::inconclusive) overall = Outcome::inconclusive;
  }
  return overall;
}

}  // namespace lightproof
