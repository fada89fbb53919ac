#include "lightproof/suite/gate.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <mutex>

#include "lightproof/core/out_of_memory.h"
#include "lightproof/core/parallel.h"
#include "lightproof/stats/family.h"
#include "lightproof/stats/tails.h"
#include "lightproof/suite/configuration.h"
#include "lightproof/suite/diagnosis.h"
#include "lightproof/suite/records.h"

namespace lightproof {
namespace {

/// Samples of the second stage, in those of the first.
constexpr std::uint64_t kSecondStage = 4;
/// Probability with which an effect as large as `detectable` is seen in each stage.
constexpr double kStagePower = 0.5 * (1.0 + kDetectablePower);

double level_at_once(const GateOptions& options, std::size_t tests) {
  // What rejects at once is suspicious as well.
  return std::min(
      {options.at_once, options.suspicious, 0.5 * strictest_level(options.family_alpha, tests)});
}

bool is_rejected(const TestRecord& record) { return record.outcome == Outcome::reject; }

/// The records of one configuration, and the draws behind them if they may be needed for a
/// diagnosis.
struct Slot {
  std::vector<Measured> tests;
  std::optional<Draws> draws;
  Inspection inspection;
};

/// What the candidates of one problem share, at one number of samples.
struct Yardstick {
  const Expectation& expectation;
  std::uint64_t samples;
  UniformEstimates uniform;
  std::optional<Twin> twin;
};

Yardstick yardstick_of(const Problem& problem, const Expectation& expectation,
                       const GateOptions& options, std::uint64_t samples, bool with_twin) {
  const auto stream = [&](std::string_view purpose) {
    return RandomStream(
        fmt::format("{}/{}/{}/{}", purpose, problem.weighting, problem.map, samples), options.seed);
  };
  Yardstick yardstick{expectation, samples, draw_uniformly(expectation, stream("uniform"), samples),
                      std::nullopt};
  if (with_twin) {
    yardstick.twin = draw_twin(problem.twin(), expectation, stream("twin"), samples);
  }
  return yardstick;
}

void append(std::vector<Measured>& tests, std::vector<Measured> more) {
  std::move(more.begin(), more.end(), std::back_inserter(tests));
}

Slot run_first(const Configuration& configuration, const Yardstick& yardstick, double suspicious) {
  const Expectation& expectation = yardstick.expectation;
  const BoundSampler sampler = configuration.candidate->bind();
  const Inspection inspection =
      configuration.candidate->inspect(sampler, expectation, configuration.candidate->rounding);
  Draws draws = draw_samples_of(configuration, expectation, sampler, "draws", yardstick.samples);
  Slot slot{test_draws(configuration, expectation, inspection, draws, yardstick.uniform),
            std::nullopt, inspection};
  append(slot.tests, test_against_twin(configuration, draws, yardstick.twin));
  append(slot.tests, test_strays(configuration, draws));
  append(slot.tests, test_exactly(configuration, expectation, sampler, inspection, draws,
                                  yardstick.twin ? &yardstick.twin->sampler : nullptr));
  const bool clean = std::all_of(slot.tests.begin(), slot.tests.end(), [&](const Measured& test) {
    const TestRecord& r = test.record;
    return r.log10_p ? *r.log10_p >= std::log10(suspicious)
                     : r.outcome == Outcome::accept || r.outcome == Outcome::not_run;
  });
  if (!clean) slot.draws = std::move(draws);
  return slot;
}

/// The p-values of the first stage that are looked at again: in [from, to).
struct Again {
  double from;
  double to;

  bool operator()(const Measured& test) const {
    const std::optional<double>& log10_p = test.record.log10_p;
    return log10_p && *log10_p < std::log10(to) && *log10_p >= std::log10(from);
  }
};

/// Suspicious tests of a slot get the records of new samples in their place, and so do strays, if
/// there are any. A diagnosis counts these samples: they are more.
void run_again(const Configuration& configuration, const Yardstick& yardstick,
               const Again& is_suspicious, Slot& slot) {
  const Expectation& expectation = yardstick.expectation;
  const BoundSampler sampler = configuration.candidate->bind();
  Draws draws =
      draw_samples_of(configuration, expectation, sampler, "draws again", yardstick.samples);
  auto again = test_draws(configuration, expectation, slot.inspection, draws, yardstick.uniform);
  append(again, test_against_twin(configuration, draws, yardstick.twin));
  append(again, test_strays(configuration, draws));
  for (Measured& test : slot.tests) {
    const auto same = std::find_if(again.begin(), again.end(), [&](const Measured& other) {
      return other.record.oracle == test.record.oracle && other.record.test == test.record.test;
    });
    if (same == again.end() || same->record.outcome == Outcome::not_run) continue;
    if (!is_suspicious(test) && same->record.outcome != Outcome::reject) continue;
    test = *same;
    test.record.stage = 2;
  }
  slot.draws = std::move(draws);
}

/// Turns p-values into outcomes, and says what would have been found.
class Judge {
 public:
  Judge(const GateOptions& options, std::size_t tests)
      : samples_(static_cast<double>(options.samples)),
        suspicious_(options.suspicious),
        at_once_(level_at_once(options, tests)),
        second_alpha_(0.5 * options.family_alpha),
        second_level_(strictest_level(second_alpha_, tests)),
        family_(tests),
        must_detect_(options.must_detect) {}

  Again again() const { return {at_once_, suspicious_}; }

  void operator()(std::span<Measured* const> tests) const {
    std::vector<double> second;
    for (const Measured* test : tests) {
      const TestRecord& record = test->record;
      if (record.stage == 2 && record.log10_p) second.push_back(*record.log10_p);
    }
    const std::vector<bool> rejected = holm_rejections(second, second_alpha_, family_);
    std::size_t next = 0;
    for (Measured* test : tests) {
      TestRecord& record = test->record;
      record.detectable_effect = detectable_effect(*test);
      if (!record.log10_p) continue;
      const bool reject =
          record.stage == 2 ? rejected[next++] : !(*record.log10_p >= std::log10(at_once_));
      record.outcome = reject ? Outcome::reject : Outcome::accept;
      if (!reject && record.detectable_effect &&
          record.resolution_floor.value_or(0.0) > *record.detectable_effect) {
        record.outcome = Outcome::resolution_limited;
        record.detail = fmt::format("the sampler's own rounding makes an effect of {:.3g}",
                                    *record.resolution_floor);
      }
      require_power(record, must_detect_);
    }
  }

 private:
  /// The effect that both stages see with kStagePower each, and so together with
  /// kDetectablePower; none where it is infinite or cannot be computed.
  std::optional<double> detectable_effect(const Measured& test) const {
    if (!test.detectable) return std::nullopt;
    const double again = static_cast<double>(kSecondStage) * samples_;
    double effect = INFINITY;
    const auto failure = failure_of([&] {
      effect = std::max(test.detectable(suspicious_, kStagePower, samples_),
                        test.detectable(second_level_, kStagePower, again));
    });
    return !failure && std::isfinite(effect) ? std::optional(effect) : std::nullopt;
  }

  double samples_;
  double suspicious_;
  double at_once_;
  double second_alpha_;
  double second_level_;  ///< of Holm's strictest test
  std::size_t family_;
  double must_detect_;
};

/// Exact sides of problems, each computed when it is first asked for. They are kept while all of
/// them together have few enough texels; beyond that they last as long as whoever asked.
class Expectations {
 public:
  explicit Expectations(std::span<const Problem> problems)
      : problems_(problems), kept_(problems.size()) {}

  /// To be called for one problem by one thread at a time.
  std::shared_ptr<const Expectation> of(std::size_t problem) {
    if (kept_[problem]) return kept_[problem];
    std::shared_ptr<const Expectation> made = problems_[problem].expectation();
    const std::size_t texels = made->masses.values().size();
    if (texels_.fetch_add(texels) + texels <= kMostTexels) {
      kept_[problem] = made;
    } else {
      texels_.fetch_sub(texels);
    }
    return made;
  }

 private:
  /// About 60 bytes are kept of a texel: half a gibibyte.
  static constexpr std::size_t kMostTexels = std::size_t{1} << 23U;

  std::span<const Problem> problems_;
  std::vector<std::shared_ptr<const Expectation>> kept_;
  std::atomic<std::size_t> texels_ = 0;
};

/// "the gate over alias on sun-sky (weighting B)"; "the gate over sun-sky …" without a sampler.
std::string purpose_of(const Problem& problem, std::string_view sampler) {
  return fmt::format(
      "the gate over {}{}{}{}", sampler, sampler.empty() ? "" : " on ", problem.map,
      problem.weighting.empty() ? "" : fmt::format(" (weighting {})", problem.weighting));
}

/// The result of `work`, with lack of memory laid to the sampler and its problem.
template <class Work>
auto with_memory_for(const Problem& problem, std::string_view sampler, const Work& work) {
  return lightproof::with_memory_for([&] { return purpose_of(problem, sampler); }, work);
}

/// Problems, and what is known of their candidates.
class Run {
 public:
  Run(std::span<const Problem> problems, const GateOptions& options, const Progress& progress)
      : problems_(problems), options_(options), progress_(progress), expectations_(problems) {
    for (const Problem& problem : problems) slots_.emplace_back(problem.candidates.size());
  }

  GateResult operator()() {
    if (progress_) progress_("gate", 0.0);
    const auto has_twin = [](const Candidate& candidate) { return candidate.has_twin; };
    parallel_for(problems_.size(), [&](std::size_t i) {
      const std::vector<Candidate>& candidates = problems_[i].candidates;
      const std::shared_ptr<const Expectation> expectation = expectations_.of(i);
      const Yardstick yardstick = with_memory_for(problems_[i], "", [&] {
        return yardstick_of(problems_[i], *expectation, options_, options_.samples,
                            std::any_of(candidates.begin(), candidates.end(), has_twin));
      });
      for_each_candidate(i, [&](const Configuration& configuration, Slot& slot) {
        slot = with_memory_for(problems_[i], configuration.candidate->name, [&] {
          return run_first(configuration, yardstick, options_.suspicious);
        });
        show_progress();
      });
    });
    const std::size_t family = std::max<std::size_t>(count_p_values(), options_.family);
    const Judge judge(options_, family);
    parallel_for(problems_.size(), [&](std::size_t i) {
      const auto is_open = [&](const Slot& slot) {
        return std::any_of(slot.tests.begin(), slot.tests.end(), judge.again());
      };
      bool any = false;
      bool with_twin = false;
      for (std::size_t k = 0; k < slots_[i].size(); ++k) {
        if (!is_open(slots_[i][k])) continue;
        any = true;
        with_twin = with_twin || problems_[i].candidates[k].has_twin;
      }
      if (!any) return;
      const std::shared_ptr<const Expectation> expectation = expectations_.of(i);
      const Yardstick yardstick = with_memory_for(problems_[i], "", [&] {
        return yardstick_of(problems_[i], *expectation, options_, kSecondStage * options_.samples,
                            with_twin);
      });
      for_each_candidate(i, [&](const Configuration& configuration, Slot& slot) {
        if (!is_open(slot)) return;
        with_memory_for(problems_[i], configuration.candidate->name,
                        [&] { run_again(configuration, yardstick, judge.again(), slot); });
      });
    });
    std::vector<Measured*> tests;
    for_each_test([&](Measured& test) { tests.push_back(&test); });
    judge(tests);
    GateResult result = collect();
    result.family = family;
    return result;
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

  template <class Visit>
  void for_each_test(const Visit& visit) {
    for (auto& slots : slots_) {
      for (Slot& slot : slots) {
        for (Measured& test : slot.tests) visit(test);
      }
    }
  }

  std::size_t count_p_values() {
    std::size_t count = 0;
    for_each_test([&](const Measured& test) { count += test.record.log10_p ? 1 : 0; });
    return count;
  }

  GateResult collect() {
    std::vector<std::vector<TestRecord>> records(problems_.size());
    std::vector<std::vector<Rejection>> rejections(problems_.size());
    parallel_for(problems_.size(), [&](std::size_t i) {
      std::vector<std::vector<TestRecord>> of_slots;
      for (const Slot& slot : slots_[i]) {
        std::vector<TestRecord>& of_slot = of_slots.emplace_back();
        for (const Measured& test : slot.tests) of_slot.push_back(test.record);
      }
      rejections[i] = diagnose_rejected(i, of_slots);
      for (auto& of_slot : of_slots) {
        std::move(of_slot.begin(), of_slot.end(), std::back_inserter(records[i]));
      }
    });
    GateResult result{options_.family_alpha, options_.samples, options_.seed, {}, {}};
    result.must_detect = options_.must_detect;
    for (std::size_t i = 0; i < problems_.size(); ++i) {
      std::move(records[i].begin(), records[i].end(), std::back_inserter(result.tests));
      std::move(rejections[i].begin(), rejections[i].end(), std::back_inserter(result.rejections));
    }
    return result;
  }

  std::vector<Rejection> diagnose_rejected(std::size_t problem,
                                           std::span<const std::vector<TestRecord>> of_slots) {
    std::vector<Evidence> rejected;
    for (std::size_t k = 0; k < of_slots.size(); ++k) {
      const Slot& slot = slots_[problem][k];
      if (std::none_of(of_slots[k].begin(), of_slots[k].end(), is_rejected)) continue;
      rejected.push_back({of_slots[k], &*slot.draws, &slot.inspection});
    }
    if (rejected.empty()) return {};
    return with_memory_for(problems_[problem], "", [&] {
      return diagnose(problems_[problem], *expectations_.of(problem), rejected);
    });
  }

  std::span<const Problem> problems_;
  GateOptions options_;
  Progress progress_;
  Expectations expectations_;
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
  std::size_t counted = 0;
  for (const TestRecord& test : result.tests) {
    if (test.known_defect && !count_known_defects) continue;
    if (test.outcome == Outcome::not_run) continue;
    ++counted;
    if (test.outcome == Outcome::reject) return Outcome::reject;
    if (test.outcome == Outcome::inconclusive) overall = Outcome::inconclusive;
    if (test.outcome == Outcome::resolution_limited && overall == Outcome::accept) {
      overall = Outcome::resolution_limited;
    }
  }
  return counted > 0 ? overall : Outcome::inconclusive;
}

}  // namespace lightproof
