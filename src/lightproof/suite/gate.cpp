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
  const BoundSampler sampler = configuration.subject->bind(*configuration.map);
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
  const BoundSampler sampler = configuration.subject->bind(*configuration.map);
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

using Group = std::vector<std::size_t>;

/// Subjects of one target density share its expectation.
std::vector<Group> groups_of(std::span<const Subject> subjects) {
  std::vector<Group> groups;
  for (std::size_t i = 0; i < subjects.size(); ++i) {
    const auto same = std::find_if(groups.begin(), groups.end(), [&](const Group& group) {
      return subjects[group.front()].target == subjects[i].target;
    });
    if (same == groups.end()) {
      groups.push_back({i});
    } else {
      same->push_back(i);
    }
  }
  return groups;
}

/// Maps and subjects, and what is shared between them.
class Run {
 public:
  Run(std::span<const EnvironmentMap> maps, std::span<const Subject> subjects,
      const GateOptions& options, const Progress& progress)
      : maps_(maps),
        subjects_(subjects),
        options_(options),
        progress_(progress),
        groups_(groups_of(subjects)),
        slots_(maps.size() * subjects.size()) {}

  GateResult operator()() {
    if (progress_) progress_("gate", 0.0);
    parallel_for(groups_.size() * maps_.size(), [&](std::size_t i) {
      const EnvironmentMap& map = maps_[i / groups_.size()];
      const Group& group = groups_[i % groups_.size()];
      const Expectation expectation = expectation_of(map, subjects_[group.front()].target);
      for_each_in(group, map, [&](const Configuration& configuration, Slot& slot) {
        slot = run_first(configuration, expectation, options_.samples);
        show_progress();
      });
    });
    const double at_once = level_at_once(options_.family_alpha, count_p_values());
    parallel_for(groups_.size() * maps_.size(), [&](std::size_t i) {
      const EnvironmentMap& map = maps_[i / groups_.size()];
      const Group& group = groups_[i % groups_.size()];
      const bool clean = std::none_of(group.begin(), group.end(), [&](std::size_t subject) {
        return slot_of(map, subject).draws.has_value();
      });
      if (clean) return;
      const Expectation expectation = expectation_of(map, subjects_[group.front()].target);
      for_each_in(group, map, [&](const Configuration& configuration, Slot& slot) {
        run_again(configuration, expectation, options_.samples, at_once, slot);
      });
    });
    return collect();
  }

 private:
  Slot& slot_of(const EnvironmentMap& map, std::size_t subject) {
    return slots_[static_cast<std::size_t>(&map - maps_.data()) * subjects_.size() + subject];
  }

  template <class Body>
  void for_each_in(const Group& group, const EnvironmentMap& map, const Body& body) {
    parallel_for(group.size(), [&](std::size_t i) {
      body(Configuration{&map, &subjects_[group[i]], options_.seed}, slot_of(map, group[i]));
    });
  }

  void show_progress() {
    const std::lock_guard lock(mutex_);
    ++done_;
    if (progress_) {
      progress_("gate", static_cast<double>(done_) / static_cast<double>(slots_.size()));
    }
  }

  std::size_t count_p_values() const {
    std::size_t count = 0;
    for (const Slot& slot : slots_) {
      for (const TestRecord& record : slot.records) count += record.log10_p ? 1 : 0;
    }
    return count;
  }

  GateResult collect() {
    GateResult result{options_.family_alpha, options_.samples, options_.seed, {}, {}};
    for (const Slot& slot : slots_) {
      result.tests.insert(result.tests.end(), slot.records.begin(), slot.records.end());
    }
    judge(result);
    std::size_t first = 0;
    for (std::size_t i = 0; i < slots_.size(); ++i) {
      const std::span records = std::span(result.tests).subspan(first, slots_[i].records.size());
      first += records.size();
      if (std::none_of(records.begin(), records.end(),
                       [](const auto& r) { return r.outcome == Outcome::reject; })) {
        continue;
      }
      const EnvironmentMap& map = maps_[i / subjects_.size()];
      const TargetDensity target = subjects_[i % subjects_.size()].target;
      result.rejections.push_back(
          diagnose(map, expectation_of(map, target), {records, &*slots_[i].draws, &slots_[i].own}));
    }
    return result;
  }

  std::span<const EnvironmentMap> maps_;
  std::span<const Subject> subjects_;
  GateOptions options_;
  Progress progress_;
  std::vector<Group> groups_;
  std::vector<Slot> slots_;
  std::mutex mutex_;
  std::size_t done_ = 0;
};

}  // namespace

GateResult run_gate(std::span<const EnvironmentMap> maps, std::span<const Subject> subjects,
                    const GateOptions& options, const Progress& progress) {
  return Run(maps, subjects, options, progress)();
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
