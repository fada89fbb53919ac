#include "lightproof/gate/gate.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <mutex>

#include "lightproof/core/out_of_memory.h"
#include "lightproof/core/parallel.h"
#include "lightproof/gate/diagnosis.h"
#include "lightproof/gate/judge.h"
#include "lightproof/gate/records.h"
#include "lightproof/gate/test_run.h"

namespace lightproof {
namespace {

/// Samples of the second stage, in those of the first.
constexpr std::uint64_t kSecondStage = 4;
bool is_rejected(const TestRecord& record) { return record.outcome == Outcome::reject; }

/// The records of one run, and the draws behind them if they may be needed for a diagnosis.
struct RunState {
  std::vector<Measured> tests;
  std::optional<Draws> draws;
  Inspection inspection;
};

/// What the instances of one test case share, at one number of samples.
struct SharedDraws {
  const Expectation& expectation;
  std::uint64_t samples;
  UniformEstimates uniform;
  std::optional<ReferenceDraws> reference_implementation;
};

SharedDraws shared_draws(const TestCase& test_case, const Expectation& expectation,
                         const GateOptions& options, std::uint64_t samples, bool with_reference) {
  const auto stream = [&](std::string_view purpose) {
    return RandomStream(
        fmt::format("{}/{}/{}/{}", purpose, test_case.density_space, test_case.map, samples),
        options.seed);
  };
  SharedDraws shared{expectation, samples, draw_uniformly(expectation, stream("uniform"), samples),
                     std::nullopt};
  if (with_reference) {
    shared.reference_implementation =
        draw_reference(test_case.reference_implementation(), expectation, stream("twin"), samples);
  }
  return shared;
}

void append(std::vector<Measured>& tests, std::vector<Measured> more) {
  std::move(more.begin(), more.end(), std::back_inserter(tests));
}

/// How many of the wanted samples a source still has after its first ones.
std::uint64_t confirmation_samples(const BoundSampler& sampler, std::uint64_t first,
                                   std::uint64_t wanted) {
  return sampler.count ? std::min(wanted, *sampler.count - first) : wanted;
}

RunState run_first(const TestRun& run, const SharedDraws& shared, double screening_level) {
  const Expectation& expectation = shared.expectation;
  const BoundSampler sampler = run.instance->bind();
  const Inspection inspection = run.instance->inspect(sampler, expectation, run.instance->rounding);
  const std::uint64_t samples = std::min(shared.samples, sampler.count.value_or(shared.samples));
  Draws draws = draw_samples_of(run, expectation, sampler, "draws", samples);
  RunState state{test_draws(run, expectation, inspection, draws, shared.uniform), std::nullopt,
                 inspection};
  append(state.tests, test_against_reference(run, draws, shared.reference_implementation));
  append(state.tests, test_validity(run, draws));
  append(state.tests,
         test_exactly(run, expectation, sampler, inspection, draws,
                      shared.reference_implementation ? &shared.reference_implementation->sampler
                                                      : nullptr));
  const std::uint64_t confirmation =
      confirmation_samples(sampler, samples, kSecondStage * shared.samples);
  for (Measured& test : state.tests) test.stages = {samples, confirmation};
  const bool clean = std::all_of(state.tests.begin(), state.tests.end(), [&](const Measured& test) {
    const TestRecord& r = test.record;
    return r.log10_p ? *r.log10_p >= std::log10(screening_level)
                     : r.outcome == Outcome::accept || r.outcome == Outcome::not_run;
  });
  if (!clean) state.draws = std::move(draws);
  return state;
}

/// The tests of a run that fell below the screening level get the records of new samples in
/// their place, and so do the tests of invalid samples, if there are any. A diagnosis counts these
/// samples: they are more.
void confirm(const TestRun& run, const SharedDraws& shared,
             const ConfirmationRange& needs_confirmation, RunState& state) {
  const Expectation& expectation = shared.expectation;
  const BoundSampler sampler = run.instance->bind();
  const std::uint64_t first = state.tests.front().record.samples;
  const std::uint64_t samples = confirmation_samples(sampler, first, shared.samples);
  if (samples == 0) return;
  Draws draws = draw_samples_of(run, expectation, sampler, "draws again", samples, first);
  auto again = test_draws(run, expectation, state.inspection, draws, shared.uniform);
  append(again, test_against_reference(run, draws, shared.reference_implementation));
  append(again, test_validity(run, draws));
  for (Measured& test : state.tests) {
    const auto same = std::find_if(again.begin(), again.end(), [&](const Measured& other) {
      return other.record.test == test.record.test;
    });
    if (same == again.end() || same->record.outcome == Outcome::not_run) continue;
    if (!needs_confirmation(test) && same->record.outcome != Outcome::reject) continue;
    const StageSamples stages = test.stages;
    test = *same;
    test.record.stage = 2;
    test.stages = stages;
  }
  state.draws = std::move(draws);
}

/// Exact sides of test cases, each computed when it is first asked for. They are kept while all of
/// them together have few enough texels; beyond that they last as long as whoever asked.
class Expectations {
 public:
  explicit Expectations(std::span<const TestCase> test_cases)
      : test_cases_(test_cases), kept_(test_cases.size()) {}

  /// To be called for one test case by one thread at a time.
  std::shared_ptr<const Expectation> of(std::size_t test_case) {
    if (kept_[test_case]) return kept_[test_case];
    std::shared_ptr<const Expectation> made = test_cases_[test_case].expectation();
    const std::size_t texels = made->masses.values().size();
    if (texels_.fetch_add(texels) + texels <= kMostTexels) {
      kept_[test_case] = made;
    } else {
      texels_.fetch_sub(texels);
    }
    return made;
  }

 private:
  /// About 60 bytes are kept of a texel: half a gibibyte.
  static constexpr std::size_t kMostTexels = std::size_t{1} << 23U;

  std::span<const TestCase> test_cases_;
  std::vector<std::shared_ptr<const Expectation>> kept_;
  std::atomic<std::size_t> texels_ = 0;
};

/// "the gate over alias on sun-sky (density B)"; "the gate over sun-sky …" without a sampler.
std::string purpose_of(const TestCase& test_case, std::string_view sampler) {
  return fmt::format(
      "the gate over {}{}{}{}", sampler, sampler.empty() ? "" : " on ", test_case.map,
      test_case.density_space.empty() ? "" : fmt::format(" (density {})", test_case.density_space));
}

/// The result of `work`, with lack of memory laid to the sampler and its test case.
template <class Work>
auto with_memory_for(const TestCase& test_case, std::string_view sampler, const Work& work) {
  return lightproof::with_memory_for([&] { return purpose_of(test_case, sampler); }, work);
}

/// Test cases, and what is known of their instances.
class TwoStages {
 public:
  TwoStages(std::span<const TestCase> test_cases, const GateOptions& options,
            const Progress& progress)
      : test_cases_(test_cases), options_(options), progress_(progress), expectations_(test_cases) {
    for (const TestCase& test_case : test_cases) states_.emplace_back(test_case.instances.size());
  }

  GateResult operator()() {
    if (progress_) progress_("gate", 0.0);
    const auto claims_reference_texels = [](const SamplerInstance& instance) {
      return instance.claims_reference_texels;
    };
    parallel_for(test_cases_.size(), [&](std::size_t i) {
      const std::vector<SamplerInstance>& instances = test_cases_[i].instances;
      const std::shared_ptr<const Expectation> expectation = expectations_.of(i);
      const SharedDraws shared = with_memory_for(test_cases_[i], "", [&] {
        return shared_draws(
            test_cases_[i], *expectation, options_, options_.samples,
            std::any_of(instances.begin(), instances.end(), claims_reference_texels));
      });
      for_each_instance(i, [&](const TestRun& run, RunState& state) {
        state = with_memory_for(test_cases_[i], run.instance->name,
                                [&] { return run_first(run, shared, options_.screening_level); });
        show_progress();
      });
    });
    const std::size_t family = std::max<std::size_t>(count_p_values(), options_.family);
    const Judge judge(options_, family);
    parallel_for(test_cases_.size(), [&](std::size_t i) {
      const auto is_open = [&](const RunState& state) {
        return std::any_of(state.tests.begin(), state.tests.end(), judge.confirmation());
      };
      bool any = false;
      bool with_reference = false;
      for (std::size_t k = 0; k < states_[i].size(); ++k) {
        if (!is_open(states_[i][k])) continue;
        any = true;
        with_reference = with_reference || test_cases_[i].instances[k].claims_reference_texels;
      }
      if (!any) return;
      const std::shared_ptr<const Expectation> expectation = expectations_.of(i);
      const SharedDraws shared = with_memory_for(test_cases_[i], "", [&] {
        return shared_draws(test_cases_[i], *expectation, options_, kSecondStage * options_.samples,
                            with_reference);
      });
      for_each_instance(i, [&](const TestRun& run, RunState& state) {
        if (!is_open(state)) return;
        with_memory_for(test_cases_[i], run.instance->name,
                        [&] { confirm(run, shared, judge.confirmation(), state); });
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
  void for_each_instance(std::size_t test_case, const Body& body) {
    const std::vector<SamplerInstance>& instances = test_cases_[test_case].instances;
    parallel_for(instances.size(), [&](std::size_t i) {
      body(TestRun{&test_cases_[test_case], &instances[i], options_.seed}, states_[test_case][i]);
    });
  }

  void show_progress() {
    const std::lock_guard lock(mutex_);
    ++done_;
    if (!progress_) return;
    std::size_t all = 0;
    for (const auto& states : states_) all += states.size();
    progress_("gate", static_cast<double>(done_) / static_cast<double>(all));
  }

  template <class Visit>
  void for_each_test(const Visit& visit) {
    for (auto& states : states_) {
      for (RunState& state : states) {
        for (Measured& test : state.tests) visit(test);
      }
    }
  }

  std::size_t count_p_values() {
    std::size_t count = 0;
    for_each_test([&](const Measured& test) { count += test.record.log10_p ? 1 : 0; });
    return count;
  }

  GateResult collect() {
    std::vector<std::vector<TestRecord>> records(test_cases_.size());
    std::vector<std::vector<Rejection>> rejections(test_cases_.size());
    parallel_for(test_cases_.size(), [&](std::size_t i) {
      std::vector<std::vector<TestRecord>> of_states;
      for (const RunState& state : states_[i]) {
        std::vector<TestRecord>& of_state = of_states.emplace_back();
        for (const Measured& test : state.tests) of_state.push_back(test.record);
      }
      rejections[i] = diagnose_rejected(i, of_states);
      for (auto& of_state : of_states) {
        std::move(of_state.begin(), of_state.end(), std::back_inserter(records[i]));
      }
    });
    GateResult result{options_.family_alpha, options_.samples, options_.seed, {}, {}};
    result.must_detect = options_.must_detect;
    for (std::size_t i = 0; i < test_cases_.size(); ++i) {
      std::move(records[i].begin(), records[i].end(), std::back_inserter(result.tests));
      std::move(rejections[i].begin(), rejections[i].end(), std::back_inserter(result.rejections));
    }
    return result;
  }

  std::vector<Rejection> diagnose_rejected(std::size_t test_case,
                                           std::span<const std::vector<TestRecord>> of_states) {
    std::vector<Evidence> rejected;
    for (std::size_t k = 0; k < of_states.size(); ++k) {
      const RunState& state = states_[test_case][k];
      if (std::none_of(of_states[k].begin(), of_states[k].end(), is_rejected)) continue;
      rejected.push_back({of_states[k], &*state.draws, &state.inspection});
    }
    if (rejected.empty()) return {};
    return with_memory_for(test_cases_[test_case], "", [&] {
      return diagnose(test_cases_[test_case], *expectations_.of(test_case), rejected);
    });
  }

  std::span<const TestCase> test_cases_;
  GateOptions options_;
  Progress progress_;
  Expectations expectations_;
  std::vector<std::vector<RunState>> states_;  ///< by test case and instance
  std::mutex mutex_;
  std::size_t done_ = 0;
};

}  // namespace

GateResult run_gate(std::span<const TestCase> test_cases, const GateOptions& options,
                    const Progress& progress) {
  return TwoStages(test_cases, options, progress)();
}

GateResult run_gate(std::span<const EnvironmentMap> maps,
                    std::span<const SamplerUnderTest> samplers_under_test,
                    const GateOptions& options, const Progress& progress) {
  return run_gate(test_cases_of(maps, samplers_under_test), options, progress);
}

}  // namespace lightproof
