#include "lightproof/suite/gate.h"

#include <fmt/format.h>

#include <cmath>
#include <mutex>

#include "lightproof/core/parallel.h"
#include "lightproof/stats/family.h"
#include "lightproof/stats/goodness_of_fit.h"
#include "lightproof/stats/moment_tests.h"
#include "lightproof/stats/tails.h"
#include "lightproof/suite/checks.h"
#include "lightproof/suite/draws.h"

namespace lightproof {
namespace {

/// Samples of one task; fixed, so that the split does not depend on the threads.
constexpr std::uint64_t kTaskSamples = std::uint64_t{1} << 18U;

/// One sampler on one map and everything its tests need.
struct Configuration {
  const EnvironmentMap* map;
  const Subject* subject;
  std::uint64_t samples;
  std::uint64_t seed;

  const char* weighting() const { return to_string(subject->target.weighting); }
  std::string name() const {
    return fmt::format("{}/{}/{}", subject->name, weighting(), map->name);
  }
  RandomStream stream(std::string_view purpose) const {
    return {fmt::format("{}/{}", name(), purpose), seed};
  }
  TestRecord record(std::string_view oracle, std::string_view test) const {
    TestRecord record;
    record.sampler = subject->name;
    record.weighting = weighting();
    record.map = map->name;
    record.oracle = oracle;
    record.test = test;
    record.samples = samples;
    record.known_defect = subject->known_defects;
    return record;
  }
};

Draws draw_all(const BoundSampler& sampler, const Expectation& expectation,
               const Configuration& configuration) {
  const RandomStream stream = configuration.stream("draws");
  Draws all(expectation.masses.extent());
  // In blocks, so that the memory does not grow with the number of samples.
  constexpr std::uint64_t kBlock = 16 * kTaskSamples;
  for (std::uint64_t start = 0; start < configuration.samples; start += kBlock) {
    const std::uint64_t end = std::min(configuration.samples, start + kBlock);
    std::vector<Draws> parts((end - start + kTaskSamples - 1) / kTaskSamples, Draws(Extent{0, 0}));
    parallel_for(parts.size(), [&](std::size_t task) {
      const std::uint64_t first = start + task * kTaskSamples;
      parts[task] =
          draw_samples(sampler, expectation, stream, first, std::min(kTaskSamples, end - first));
    });
    for (const Draws& part : parts) all.merge(part);
  }
  return all;
}

TestRecord fit_record(const Configuration& configuration, std::string_view test,
                      const GoodnessOfFit& fit) {
  TestRecord record = configuration.record("reference", test);
  record.statistic = fit.statistic;
  record.dof = fit.dof;
  record.effect = fit.effect;
  if (fit.dof > 0.0 || fit.impossible_hits > 0) record.log10_p = fit.log10_p;
  // With a single possible cell every sample is in it, unless it is an impossible hit.
  if (fit.dof == 0.0 && fit.possible_cells <= 1) record.outcome = Outcome::accept;
  if (fit.dof == 0.0 && fit.possible_cells > 1) record.detail = "too few samples for two pools";
  if (fit.impossible_hits > 0) {
    record.detail = fmt::format("{} samples in cells without light, the first is cell {}",
                                fit.impossible_hits, *fit.first_impossible);
  }
  return record;
}

TestRecord z_record(const Configuration& configuration, std::string_view oracle,
                    std::string_view test, const ZTest& z) {
  TestRecord record = configuration.record(oracle, test);
  record.statistic = z.z;
  record.log10_p = z.log10_p;
  record.effect = z.effect;
  return record;
}

/// Below this share of the mean square the fourth central moment drowns in rounding, and there is
/// no test of the variance.
constexpr double kTestableVariance = 1e-5;

/// Mean and variance of an estimator; one whose exact variance is only rounding is compared with
/// its constant instead.
void add_moment_records(const Configuration& configuration, std::string_view oracle,
                        std::string_view test, const Moments& measured,
                        const reference::EstimatorMoments& exact,
                        std::vector<TestRecord>& records) {
  if (exact.mean() <= 0.0) return;  // no light reaches this case
  if (measured.count() < 2) {
    records.push_back(configuration.record(oracle, test));
    records.back().detail = "no sample stayed on the map";
    return;
  }
  if (exact.variance() <= 1e-12 * exact.raw[1]) {
    TestRecord record = configuration.record("check", std::string(test) + " is constant");
    record.effect = std::abs(measured.mean() / exact.mean() - 1.0);
    record.outcome = record.effect <= 1e-6 ? Outcome::accept : Outcome::reject;
    records.push_back(record);
    return;
  }
  records.push_back(
      z_record(configuration, oracle, test, mean_test(measured, exact.mean(), exact.variance())));
  const double n = static_cast<double>(measured.count());
  records.back().detectable_effect = std::sqrt(exact.variance() / n) / exact.mean();
  if (oracle != "mean") return;
  if (exact.variance() <= kTestableVariance * exact.raw[1]) return;
  records.push_back(z_record(configuration, "variance", test,
                             variance_test(measured, exact.variance(), exact.fourth_central())));
  records.back().detectable_effect =
      std::sqrt((exact.fourth_central() - exact.variance() * exact.variance()) / n) /
      exact.variance();
}

TestRecord stray_record(const Configuration& configuration, const Draws& draws) {
  TestRecord record = configuration.record("check", "samples stay on the map");
  record.statistic = static_cast<double>(draws.strays);
  record.effect = record.statistic / static_cast<double>(configuration.samples);
  record.outcome = draws.strays == 0 ? Outcome::accept : Outcome::reject;
  if (draws.first_stray) {
    const Stray& stray = *draws.first_stray;
    record.detail = fmt::format(
        "{} of {} samples left the map; first: u = ({:.17g}, {:.17g}) gives texel ({}, {}) at "
        "({:.9g}, {:.9g}), pdf {:.3g}",
        draws.strays, configuration.samples, stray.u.s, stray.u.t, stray.sample.x, stray.sample.y,
        stray.sample.at.s, stray.sample.at.t, stray.sample.pdf.value);
  }
  return record;
}

TestRecord check_record(const Configuration& configuration, const CheckResult& result) {
  TestRecord record = configuration.record("check", result.name);
  record.effect = result.worst;
  record.outcome = result.passed ? Outcome::accept : Outcome::reject;
  record.detail = result.detail;
  return record;
}

void add_check_records(const BoundSampler& sampler, const Expectation& expectation,
                       const Configuration& configuration, std::vector<TestRecord>& records) {
  const auto add = [&](const CheckResult& result) {
    records.push_back(check_record(configuration, result));
  };
  const RandomStream stream = configuration.stream("checks");
  add(check_pdf_integral(sampler, expectation.masses.extent()));
  add(check_returned_pdf(sampler, stream));
  add(check_edges(sampler, expectation));
  if (configuration.subject->inverts_shared_cdf) {
    const BoundSampler scan = bound(LinearScan(*configuration.map, expectation.target));
    add(check_same_texel(sampler, scan, expectation, stream));
  }
}

void add_draw_records(const Configuration& configuration, const Expectation& expectation,
                      const Draws& draws, std::vector<TestRecord>& records) {
  records.push_back(stray_record(configuration, draws));
  const auto fit = [&](std::string_view test, std::span<const std::uint64_t> observed,
                       std::span<const double> probability) {
    records.push_back(fit_record(configuration, test,
                                 cressie_read(observed, probability, configuration.samples)));
  };
  fit("bins 16x32", serpentine(draws.bins), serpentine(expectation.bins));
  fit("rows", draws.rows, expectation.rows);
  fit("columns", draws.columns, expectation.columns);
  for (std::size_t i = 0; i < kMeanCaseCount; ++i) {
    add_moment_records(configuration, "mean", kMeanCases[i].name, draws.estimators[i],
                       expectation.estimators[i], records);
  }
  add_moment_records(configuration, "self", "mean of 1/pdf", draws.inverse_pdf,
                     expectation.inverse_pdf, records);
}

std::vector<TestRecord> test_configuration(const Configuration& configuration,
                                           const Expectation& expectation) {
  const BoundSampler sampler = configuration.subject->bind(*configuration.map);
  std::vector<TestRecord> records;
  const Draws draws = draw_all(sampler, expectation, configuration);
  add_draw_records(configuration, expectation, draws, records);
  add_check_records(sampler, expectation, configuration, records);
  return records;
}

/// Turns p-values into outcomes, all at once, and standard errors into detectable effects.
void judge(GateResult& result) {
  std::vector<double> log10_p;
  for (const TestRecord& test : result.tests) {
    if (test.log10_p) log10_p.push_back(*test.log10_p);
  }
  const std::vector<bool> rejected = holm_rejections(log10_p, result.family_alpha);
  const double level = strictest_level(result.family_alpha, log10_p.size());
  std::size_t next = 0;
  for (TestRecord& test : result.tests) {
    if (!test.log10_p) continue;
    test.outcome = rejected[next++] ? Outcome::reject : Outcome::accept;
    if (test.dof > 0.0) {
      test.detectable_effect = std::sqrt(detectable_noncentrality(test.dof, level, 0.99) /
                                         static_cast<double>(test.samples));
    } else if (test.detectable_effect) {
      *test.detectable_effect *= detectable_z(level, 0.99);
    }
  }
}

}  // namespace

GateResult run_gate(std::span<const EnvironmentMap> maps, std::span<const Subject> subjects,
                    const GateOptions& options, const Progress& progress) {
  GateResult result{options.family_alpha, options.samples, options.seed, {}};
  std::vector<std::vector<TestRecord>> slots(maps.size() * subjects.size());
  std::mutex progress_mutex;
  std::size_t done = 0;
  if (progress) progress("gate", 0.0);
  parallel_for(slots.size(), [&](std::size_t slot) {
    const EnvironmentMap& map = maps[slot / subjects.size()];
    const Subject& subject = subjects[slot % subjects.size()];
    const Expectation expectation = expectation_of(map, subject.target);
    slots[slot] = test_configuration({&map, &subject, options.samples, options.seed}, expectation);
    const std::lock_guard lock(progress_mutex);
    ++done;
    if (progress) {
      progress("gate", static_cast<double>(done) / static_cast<double>(slots.size()));
    }
  });
  for (auto& slot : slots) {
    result.tests.insert(result.tests.end(), std::make_move_iterator(slot.begin()),
                        std::make_move_iterator(slot.end()));
  }
  judge(result);
  return result;
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
