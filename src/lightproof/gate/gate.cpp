#include "lightproof/gate/gate.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>
#include <memory>

#include "lightproof/gate/by_run.h"
#include "lightproof/gate/expectations.h"
#include "lightproof/gate/judge.h"
#include "lightproof/gate/judged_runs.h"
#include "lightproof/gate/records.h"
#include "lightproof/gate/test_run.h"

namespace lightproof {
namespace {

/// Samples of the second stage, in those of the first.
constexpr std::uint64_t kSecondStage = 4;

/// What the instances of one test case share, at one number of samples.
struct SharedDraws {
  std::shared_ptr<const Expectation> expectation;
  std::uint64_t samples;
  UniformEstimates uniform;
  std::optional<ReferenceDraws> reference_implementation;
};

SharedDraws shared_draws(const TestCase& test_case, std::shared_ptr<const Expectation> expectation,
                         std::uint64_t seed, std::uint64_t samples, bool with_reference) {
  const auto stream = [&](std::string_view purpose) {
    return RandomStream(
        fmt::format("{}/{}/{}/{}", purpose, test_case.density_space, test_case.map, samples), seed);
  };
  SharedDraws shared{std::move(expectation), samples, {}, std::nullopt};
  shared.uniform = draw_uniformly(*shared.expectation, stream("uniform"), samples);
  if (with_reference) {
    // The stream's name decides the samples: it stays.
    shared.reference_implementation = draw_reference(test_case.reference_implementation(),
                                                     *shared.expectation, stream("twin"), samples);
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

/// What every process knows of a run, and what the one that drew its samples has kept of it.
struct RunState {
  std::vector<Measured> tests;
  bool is_confirmed = false;  ///< it has samples of the second stage
  std::optional<Inspection> inspection;
  std::optional<Draws> draws;  ///< of its last stage, if they may be needed for a diagnosis
};

Draws draw_stage(const TestRun& run, const Expectation& expectation, const BoundSampler& sampler,
                 StageSamples samples, bool is_confirmed) {
  // The streams' names decide the samples: who renames them changes every verdict's numbers.
  return is_confirmed ? draw_samples_of(run, expectation, sampler, "draws again",
                                        samples.confirmation, samples.screening)
                      : draw_samples_of(run, expectation, sampler, "draws", samples.screening);
}

const Inspection& inspected(const TestRun& run, const BoundSampler& sampler,
                            const Expectation& expectation, RunState& state) {
  if (!state.inspection) {
    state.inspection = run.instance->inspect(sampler, expectation, run.instance->rounding);
  }
  return *state.inspection;
}

bool is_clean(const Measured& test, double screening_level) {
  const TestRecord& r = test.record;
  return r.log10_p ? *r.log10_p >= std::log10(screening_level)
                   : r.outcome == Outcome::accept || r.outcome == Outcome::not_run;
}

/// The tests of the first stage.
std::vector<Measured> screen_answering(const TestRun& run, const SharedDraws& shared,
                                       double screening_level, RunState& state) {
  const Expectation& expectation = *shared.expectation;
  const BoundSampler sampler = run.instance->bind();
  const Inspection& inspection = inspected(run, sampler, expectation, state);
  const std::uint64_t samples = std::min(shared.samples, sampler.count.value_or(shared.samples));
  const StageSamples stages = {
      samples, confirmation_samples(sampler, samples, kSecondStage * shared.samples)};
  Draws draws = draw_stage(run, expectation, sampler, stages, false);
  std::vector<Measured> tests = test_draws(run, expectation, inspection, draws, shared.uniform);
  append(tests, test_against_reference(run, draws, shared.reference_implementation));
  append(tests, test_validity(run, draws));
  append(tests,
         test_exactly(run, expectation, sampler, inspection, draws,
                      shared.reference_implementation ? &shared.reference_implementation->sampler
                                                      : nullptr));
  for (Measured& test : tests) test.stages = stages;
  const bool clean = std::all_of(tests.begin(), tests.end(), [&](const Measured& test) {
    return is_clean(test, screening_level);
  });
  if (clean) {
    state.inspection.reset();
  } else {
    state.draws = std::move(draws);
  }
  return tests;
}

std::vector<Measured> screen(const TestRun& run, const SharedDraws& shared, double screening_level,
                             RunState& state) {
  try {
    return screen_answering(run, shared, screening_level, state);
  } catch (const SamplerFailure& failure) {
    return test_unanswered(run, failure, shared.samples);
  }
}

/// The tests of a run, of which those that fell below the screening level have the records of new
/// samples in their place, and so have the tests of invalid samples, if there are any. A diagnosis
/// counts these samples: they are more.
std::vector<Measured> confirm_answering(const TestRun& run, const SharedDraws& shared,
                                        const ConfirmationRange& needs_confirmation,
                                        RunState& state) {
  const Expectation& expectation = *shared.expectation;
  const BoundSampler sampler = run.instance->bind();
  const Inspection& inspection = inspected(run, sampler, expectation, state);
  Draws draws = draw_stage(run, expectation, sampler, state.tests.front().stages, true);
  auto again = test_draws(run, expectation, inspection, draws, shared.uniform);
  append(again, test_against_reference(run, draws, shared.reference_implementation));
  append(again, test_validity(run, draws));
  std::vector<Measured> tests = state.tests;
  for (Measured& test : tests) {
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
  return tests;
}

std::vector<Measured> confirm(const TestRun& run, const SharedDraws& shared,
                              const ConfirmationRange& needs_confirmation, RunState& state) {
  try {
    return confirm_answering(run, shared, needs_confirmation, state);
  } catch (const SamplerFailure& failure) {
    std::vector<Measured> tests =
        test_unanswered(run, failure, state.tests.front().stages.confirmation);
    tests.front().record.stage = 2;
    return tests;
  }
}

/// Test cases, and what is known of their runs.
class TwoStages {
 public:
  TwoStages(std::span<const TestCase> test_cases, const GateOptions& options,
            const Communicator& communicator)
      : test_cases_(test_cases),
        options_(options),
        communicator_(communicator),
        expectations_(test_cases),
        states_(test_cases) {}

  ScreenedRuns screen_only(const Progress& progress) {
    screen_all({}, progress);
    ScreenedRuns screened;
    states_.for_each([&](RunIndex at, RunState& state) {
      screened.emplace(key_of(at, kScreening), std::move(state.tests));
    });
    return screened;
  }

  GateResult judge_all(const ScreenedRuns& screened, const Progress& progress) {
    screen_all(screened, progress);
    // A run that answered nothing has no p-values.
    const std::size_t family = std::max<std::size_t>({1, count_p_values(), options_.family});
    const Judge judge(options_, family);
    states_.for_each([&](RunIndex /*at*/, RunState& state) {
      state.is_confirmed =
          std::any_of(state.tests.begin(), state.tests.end(), judge.confirmation()) &&
          state.tests.front().stages.confirmation > 0;
      // Whoever draws the second stage has its own.
      if (state.is_confirmed) let_go_of_draws(state);
    });
    run_stage(
        {"confirmation", kSecondStage * options_.samples}, {},
        [](const RunState& state) { return state.is_confirmed; },
        [&](const TestRun& run, const SharedDraws& shared, RunState& state) {
          return confirm(run, shared, judge.confirmation(), state);
        });
    std::vector<Measured*> tests;
    states_.for_each([&](RunIndex /*at*/, RunState& state) {
      for (Measured& test : state.tests) tests.push_back(&test);
    });
    judge(tests);
    GateResult result = collect();
    result.family = family;
    return result;
  }

 private:
  struct Stage {
    std::string_view name;
    std::uint64_t samples;
  };

  using Tests = std::vector<Measured>;
  static constexpr std::string_view kScreening = "screening";

  std::string key_of(RunIndex at, std::string_view stage) const {
    return at.in(test_cases_, options_.seed).key(stage);
  }

  /// The first stage of all runs that `screened` does not hold.
  void screen_all(const ScreenedRuns& screened, const Progress& progress) {
    if (progress) progress("gate", 0.0);
    states_.for_each([&](RunIndex at, RunState& state) {
      const auto known = screened.find(key_of(at, kScreening));
      if (known != screened.end()) state.tests = known->second;
    });
    run_stage(
        {kScreening, options_.samples}, progress,
        [](const RunState& state) { return state.tests.empty(); },
        [&](const TestRun& run, const SharedDraws& shared, RunState& state) {
          return screen(run, shared, options_.screening_level, state);
        });
  }

  /// The runs of one test case for which is_concerned(state), as cells of work that share its
  /// draws.
  template <class IsConcerned, class Compute>
  WorkGroup<SharedDraws, Tests> group_of(std::size_t i, Stage stage,
                                         const IsConcerned& is_concerned, const Compute& compute) {
    const TestCase& test_case = test_cases_[i];
    WorkGroup<SharedDraws, Tests> group;
    group.one_at_a_time = test_case.is_large();
    bool with_reference = false;
    states_.for_each_of(i, [&](RunIndex at, RunState& state) {
      if (!is_concerned(state)) return;
      const TestRun run = at.in(test_cases_, options_.seed);
      with_reference = with_reference || run.instance->claims_reference_texels;
      group.cells.push_back({run.key(stage.name), [&, run](const SharedDraws& shared) {
                               return with_memory_for_gate(test_case, run.instance->name, [&] {
                                 Tests tests = compute(run, shared, state);
                                 keep_few(state);
                                 return tests;
                               });
                             }});
    });
    group.prepare = [this, &test_case, i, stage, with_reference] {
      auto expectation = expectations_.of(i);
      return with_memory_for_gate(test_case, "", [&] {
        return shared_draws(test_case, std::move(expectation), options_.seed, stage.samples,
                            with_reference);
      });
    };
    return group;
  }

  /// Every run for which is_concerned(state) gets the tests that compute(run, shared, state)
  /// returns.
  template <class IsConcerned, class Compute>
  void run_stage(Stage stage, const Progress& progress, const IsConcerned& is_concerned,
                 const Compute& compute) {
    std::vector<WorkGroup<SharedDraws, Tests>> groups;
    for (std::size_t i = 0; i < test_cases_.size(); ++i) {
      groups.push_back(group_of(i, stage, is_concerned, compute));
    }
    auto results = gather(compute_groups<SharedDraws, Tests>(groups, communicator_.share, progress,
                                                             "gate", communicator_.kept),
                          communicator_);
    states_.for_each([&](RunIndex at, RunState& state) {
      if (!is_concerned(state)) return;
      state.tests = std::move(results.at(key_of(at, stage.name)));
    });
  }

  /// Lets go of what was drawn if there is enough of that: it can be drawn again.
  void keep_few(RunState& state) {
    if (!state.draws) return;
    const std::size_t bytes = state.draws->bytes();
    if (kept_bytes_.fetch_add(bytes) + bytes > kMostKeptBytes) let_go_of_draws(state);
  }
  void let_go_of_draws(RunState& state) {
    if (!state.draws) return;
    kept_bytes_.fetch_sub(state.draws->bytes());
    state.draws.reset();
  }

  std::size_t count_p_values() {
    std::size_t count = 0;
    states_.for_each([&](RunIndex /*at*/, const RunState& state) {
      for (const Measured& test : state.tests) count += test.record.log10_p ? 1 : 0;
    });
    return count;
  }

  DrawnRun drawn(RunIndex at, const Expectation& expectation) {
    RunState& state = states_[at];
    if (state.draws) return {std::move(*state.draws), *state.inspection};
    const TestRun run = at.in(test_cases_, options_.seed);
    const BoundSampler sampler = run.instance->bind();
    return {draw_stage(run, expectation, sampler, state.tests.front().stages, state.is_confirmed),
            inspected(run, sampler, expectation, state)};
  }

  GateResult collect() {
    ByRun<std::vector<TestRecord>> records(test_cases_);
    states_.for_each([&](RunIndex at, RunState& state) {
      for (Measured& test : state.tests) records[at].push_back(std::move(test.record));
      // A diagnosis asks for the numbers of samples alone.
      if (!state.tests.empty()) state.tests.erase(state.tests.begin() + 1, state.tests.end());
    });
    GateResult result{options_.family_alpha, options_.samples, options_.seed, {}, {}};
    result.must_detect = options_.must_detect;
    add_judged(
        result,
        {test_cases_, options_.seed, records,
         [this](RunIndex at, const Expectation& expectation) { return drawn(at, expectation); }},
        expectations_, communicator_);
    return result;
  }

  std::span<const TestCase> test_cases_;
  const GateOptions& options_;
  const Communicator& communicator_;
  Expectations expectations_;
  ByRun<RunState> states_;
  std::atomic<std::size_t> kept_bytes_ = 0;  ///< of draws

  /// The most bytes of draws that are kept from one stage to the next.
  static constexpr std::size_t kMostKeptBytes = std::size_t{1} << 24U;
};

}  // namespace

GateResult run_gate(std::span<const TestCase> test_cases, const GateOptions& options,
                    const Progress& progress, const Communicator& communicator,
                    const ScreenedRuns& screened) {
  return TwoStages(test_cases, options, communicator).judge_all(screened, progress);
}

ScreenedRuns screen_runs(std::span<const TestCase> test_cases, const GateOptions& options,
                         const Progress& progress, const Communicator& communicator) {
  return TwoStages(test_cases, options, communicator).screen_only(progress);
}

GateResult run_gate(std::span<const EnvironmentMap> maps,
                    std::span<const SamplerUnderTest> samplers_under_test,
                    const GateOptions& options, const Progress& progress,
                    const Communicator& communicator) {
  GateResult result =
      run_gate(test_cases_of(maps, samplers_under_test), options, progress, communicator);
  result.left_out = left_out_on(maps, samplers_under_test);
  return result;
}

}  // namespace lightproof
