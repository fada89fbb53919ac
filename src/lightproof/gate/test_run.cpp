#include "lightproof/gate/test_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>

#include "lightproof/gate/records.h"
#include "lightproof/stats/goodness_of_fit.h"
#include "lightproof/stats/independence.h"
#include "lightproof/stats/moment_tests.h"
#include "lightproof/stats/tails.h"
#include "lightproof/stats/uniformity.h"

namespace lightproof {
namespace {

/// Below this share of the mean square the fourth central moment drowns in rounding, and there is
/// no test of the variance.
constexpr double kTestableVariance = 1e-5;

/// The largest value at the nodes of the quadrature, with room for what lies between them.
ExactMoments exact_moments(const reference::EstimatorMoments& exact) {
  const double largest = 1.1 * exact.largest;
  return {exact.mean(), exact.variance(), std::max(largest - exact.mean(), exact.mean())};
}

/// The moments of an estimator that would be one value everywhere but for the sampler's
/// rounding of densities, which it declares: it is unbiased all the same. None if there is no such
/// rounding, or more of it than is declared.
std::optional<ExactMoments> moments_of_rounding(const reference::EstimatorMoments& exact,
                                                const DensityComparison& density) {
  constexpr double kNoRounding = 1e-12;
  if (density.cells_off > 0 || density.rounding_variance <= kNoRounding) return std::nullopt;
  return ExactMoments{exact.mean(), exact.mean() * exact.mean() * density.rounding_variance,
                      exact.mean() * std::max(1.0, density.largest_weight_error)};
}

/// The tests of one estimator.
struct MomentTests {
  TestId mean;
  std::optional<TestId> variance;
  TestId constant;
};

/// The tests of the estimators of kMeanCases.
struct MeanCaseTests {
  MomentTests moments;
  TestId against_uniform;
};
constexpr std::array<MeanCaseTests, kMeanCaseCount> kMeanCaseTests = {{
    {{TestId::irradiance_z_mean, TestId::irradiance_z_variance, TestId::irradiance_z_constant},
     TestId::irradiance_z_uniform},
    {{TestId::irradiance_x_mean, TestId::irradiance_x_variance, TestId::irradiance_x_constant},
     TestId::irradiance_x_uniform},
}};
constexpr MomentTests kInversePdfTests = {TestId::inverse_pdf, std::nullopt,
                                          TestId::inverse_pdf_constant};

constexpr std::array kLagTests = {TestId::independence_lag_1,  TestId::independence_lag_2,
                                  TestId::independence_lag_4,  TestId::independence_lag_8,
                                  TestId::independence_lag_16, TestId::independence_lag_32,
                                  TestId::independence_lag_64};
static_assert(kLagTests.size() == kLags.size());

/// Mean and variance of an estimator; one whose exact variance is only rounding is compared with
/// its constant instead.
void add_moments(Records& records, const MomentTests& tests, const Moments& measured,
                 const reference::EstimatorMoments& exact, const DensityComparison& density) {
  if (exact.mean() <= 0.0) return;  // no light reaches this case
  if (measured.count() < 2) {
    records.add(tests.mean).record.detail = "no sample stayed on the map";
    return;
  }
  if (exact.variance() <= 1e-12 * exact.raw[1]) {
    if (const auto moments = moments_of_rounding(exact, density)) {
      records.add_z(tests.mean, mean_test(measured, *moments), *moments, exact.mean());
      return;
    }
    const double error = std::abs(measured.mean() / exact.mean() - 1.0);
    records.add_check({tests.constant, error <= 1e-6, error, ""});
    return;
  }
  const ExactMoments moments = exact_moments(exact);
  records.add_z(tests.mean, mean_test(measured, moments), moments, exact.mean());
  if (!tests.variance || exact.variance() <= kTestableVariance * exact.raw[1]) return;
  records.add_z(*tests.variance, variance_test(measured, moments, exact.fourth_central()),
                moments_of_squares(moments, exact.fourth_central()), exact.variance());
}

/// The sampler's estimate against that of uniform directions, which has errors of its own.
void add_against_uniform(Records& records, TestId test, const Moments& sampled,
                         const reference::EstimatorMoments& exact, const Moments& uniform,
                         const reference::EstimatorMoments& exact_uniform) {
  if (exact.mean() <= 0.0 || sampled.count() < 2 || exact_uniform.variance() <= 0.0) return;
  const ExactMoments moments = exact_moments(exact);
  const ExactMoments uniform_moments = exact_moments(exact_uniform);
  records.add_z(test, two_mean_test(sampled, moments, uniform, uniform_moments),
                moments_of_difference(moments, uniform_moments, 1.0), exact_uniform.mean());
}

/// More than half of the samples on a lattice of 2^-20 is no chance: one in 128 is expected.
CheckResult check_resolution(const Draws& draws) {
  const std::uint64_t most = std::max(draws.marginal_on_lattice, draws.conditional_on_lattice);
  const double share =
      static_cast<double>(most) / static_cast<double>(std::max<std::uint64_t>(1, draws.samples));
  const bool passed = share <= 0.5;
  return {TestId::random_bits, passed, share,
          passed ? "" : fmt::format("{:.3g} of the samples lie on a lattice of 2^-20", share)};
}

std::vector<double> uniform_masses(Extent bins) {
  return std::vector<double>(bins.count(), 1.0 / static_cast<double>(bins.count()));
}

constexpr std::array<std::string_view, 4> kPairNames = {"theta with theta", "theta with phi",
                                                        "phi with theta", "phi with phi"};

/// Pairs of transformed coordinates of samples that are so far apart in the sequence: four tables,
/// whose interactions are uncorrelated, so that statistics and degrees of freedom add up.
void add_pairs(Records& records, const Draws& draws, std::size_t lag) {
  const PairCounts counts = draws.successive.pairs(lag);
  const TestId test = kLagTests[lag];
  if (independence_dof(counts.total, kPairedCells) <= 0.0) {
    records.add_not_run(test, fmt::format("{} pairs are too few", counts.total));
    return;
  }
  records.attempt(test, [&] {
    std::vector<GoodnessOfFit> fits;
    for (const auto& pair : counts.pairs) fits.push_back(independence_fit(pair));
    const auto worst = std::max_element(fits.begin(), fits.end(), [](const auto& a, const auto& b) {
      return a.statistic < b.statistic;
    });
    records.add_partial_fit(test, sum_of_fits(fits, counts.total), counts.total);
    records.set_detail(fmt::format("most of it between {} of samples {} apart",
                                   kPairNames[static_cast<std::size_t>(worst - fits.begin())],
                                   kLags[lag]));
  });
}

void add_runs(Records& records, const Draws& draws) {
  const std::vector<double> even(kRunCells, 1.0 / kRunCells);
  for (const std::size_t coordinate : {0, 1}) {
    const auto runs = draws.successive.runs(coordinate);
    const std::uint64_t count = std::accumulate(runs.begin(), runs.end(), std::uint64_t{0});
    const TestId test = coordinate == 0 ? TestId::run_sums_theta : TestId::run_sums_phi;
    records.attempt(test, [&] {
      const GoodnessOfFit fit = cressie_read(runs, even, count);
      if (fit.dof > 0.0) {
        records.add_partial_fit(test, fit, count);
      } else {
        records.add_not_run(test, fmt::format("{} runs are too few", count));
      }
    });
  }
}

std::string why_no_positions(double mass, std::uint64_t samples, bool cannot_be_directed) {
  if (mass <= 0.0) return "no light lies there";
  return fmt::format("{} samples there are too few{}", samples,
                     cannot_be_directed ? ", and no points can be directed there: the sampler does "
                                          "not find its row by u.t alone"
                                        : "");
}

/// Positions inside cells, for the first row, the last one, and the bands between them together.
/// The rows of the poles hold few samples unless points can be directed there.
void add_positions(Records& records, const Expectation& expectation, const Draws& draws,
                   bool can_be_directed) {
  const std::vector<double> even = uniform_masses(kPositionCells);
  const auto add = [&](TestId test, std::size_t first, std::size_t last) {
    records.attempt(test, [&] {
      std::vector<GoodnessOfFit> fits;
      std::uint64_t counted = 0;
      double mass = 0.0;
      for (std::size_t band = first; band < last; ++band) {
        mass += expectation.bands[band].mass;
        const auto counts = draws.positions.row(static_cast<int>(band));
        const std::uint64_t count = std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
        fits.push_back(cressie_read(counts, even, count));
        counted += count;
      }
      const GoodnessOfFit fit = sum_of_fits(fits, counted);
      if (fit.dof > 0.0) return records.add_partial_fit(test, fit, counted);
      const bool is_pole = first == 0 || last == expectation.bands.size();
      records.add_not_run(test, why_no_positions(mass, counted, is_pole && !can_be_directed));
    });
  };
  const std::size_t bands = expectation.bands.size();
  if (bands > 0) add(TestId::positions_first_row, 0, 1);
  if (bands > 2) add(TestId::positions_between, 1, bands - 1);
  if (bands > 1) add(TestId::positions_last_row, bands - 1, bands);
}

constexpr const char* kNoPdf = "the source tells no density at given positions";
constexpr const char* kNoWeights = "the samples come without densities";
constexpr const char* kNoPoints = "the source does not draw at given random numbers";

void add_estimators(Records& records, const Expectation& expectation, const Inspection& inspection,
                    const Draws& draws, const UniformEstimates& uniform) {
  for (std::size_t i = 0; i < kMeanCaseCount; ++i) {
    const auto& [moments, against_uniform] = kMeanCaseTests[i];
    records.attempt(moments.mean, [&, &moments = moments, &against_uniform = against_uniform] {
      add_moments(records, moments, draws.estimators[i], expectation.estimators[i],
                  inspection.density);
      add_against_uniform(records, against_uniform, draws.estimators[i], expectation.estimators[i],
                          uniform[i], expectation.uniform[i]);
    });
  }
  records.attempt(kInversePdfTests.mean, [&] {
    add_moments(records, kInversePdfTests, draws.inverse_pdf, expectation.inverse_pdf,
                inspection.density);
  });
}

void add_estimators_not_run(Records& records) {
  for (const auto& [moments, against_uniform] : kMeanCaseTests) {
    records.add_not_run(moments.mean, kNoWeights);
    records.add_not_run(*moments.variance, kNoWeights);
    records.add_not_run(against_uniform, kNoWeights);
  }
  records.add_not_run(kInversePdfTests.mean, kNoWeights);
}

}  // namespace

std::string TestRun::name() const {
  return fmt::format("{}/{}/{}", instance->name, test_case->density_space, test_case->map);
}

RandomStream TestRun::stream(std::string_view purpose) const {
  return {fmt::format("{}/{}", name(), purpose), seed};
}

TestRecord record_of(const TestRun& run, TestId test, std::uint64_t samples) {
  TestRecord record;
  record.sampler = run.instance->name;
  record.density_space = run.test_case->density_space;
  record.map = run.test_case->map;
  record.source = run.test_case->source;
  record.test = test;
  record.samples = samples;
  record.seed = run.seed;
  record.known_defect = run.instance->known_defects;
  return record;
}

void require_power(TestRecord& record, double must_detect) {
  if (!decides_power(record.test) || record.outcome != Outcome::accept) return;
  // Where all samples lie in one bin nothing could be missed, and no effect is printed.
  if (record.test == TestId::bins ? record.dof <= 0.0 : !record.minimum_detectable_effect) return;
  if (record.minimum_detectable_effect.value_or(INFINITY) <= must_detect) return;
  record.outcome = Outcome::inconclusive;
  record.detail = fmt::format(
      "{} samples could have seen a deviation of {} at the least where {:.3g} is asked for: draw "
      "more, or ask for less with --must-detect",
      record.samples,
      record.minimum_detectable_effect ? fmt::format("{:.3g}", *record.minimum_detectable_effect)
                                       : "any size",
      must_detect);
}

Draws draw_samples_of(const TestRun& run, const Expectation& expectation,
                      const BoundSampler& sampler, std::string_view purpose, std::uint64_t samples,
                      std::uint64_t first) {
  /// Points directed at each pole's row, as a share of the samples.
  constexpr std::uint64_t kDirected = 64;
  const std::uint64_t begin = sampler.takes_points() ? 0 : first;
  Draws draws = draw_samples(sampler, expectation, run.stream(purpose), {begin, samples});
  if (!run.instance->inverts_rows || !sampler.takes_points() || expectation.bands.empty()) {
    return draws;
  }
  const std::size_t last = expectation.bands.size() - 1;
  for (const std::size_t band : last > 0 ? std::vector{std::size_t{0}, last} : std::vector{last}) {
    if (expectation.bands[band].mass <= 0.0) continue;
    // Where the sampler's own sums put the row, by the rounding that it declares: points that miss
    // some of it would fall unevenly inside.
    const MassRounding& rounding = run.instance->rounding;
    const double margin =
        std::max(0x1p-50, rounding.of_sums + rounding.relative * expectation.bands[band].mass);
    const std::string name = fmt::format("{}, directed at band {}", purpose, band);
    add_directed_positions(draws, sampler, expectation,
                           {band, margin, run.stream(name), samples / kDirected});
  }
  return draws;
}

std::vector<Measured> test_draws(const TestRun& run, const Expectation& expectation,
                                 const Inspection& inspection, const Draws& draws,
                                 const UniformEstimates& uniform) {
  const OwnDensity& own = inspection.own;
  Records records(run, draws.samples);
  records.add_fit(TestId::bins, serpentine(draws.bins), serpentine(expectation.bins));
  const std::vector<std::uint64_t> rows = row_counts(draws.texels);
  const std::vector<std::uint64_t> columns = column_counts(draws.texels);
  records.add_fit(TestId::texels, serpentine(draws.texels), serpentine(expectation.masses));
  const RoundingEffect rounding = rounding_effect(expectation, draws.samples);
  records.set_resolution_floor(rounding.texels * run.instance->resolution);
  records.add_fit(TestId::rows, rows, expectation.rows);
  records.set_resolution_floor(rounding.rows * run.instance->resolution);
  records.add_fit(TestId::columns, columns, expectation.columns);
  records.add_worst(TestId::worst_texel, draws.texels.values(), expectation.masses.values());
  records.add_worst(TestId::worst_row, rows, expectation.rows);
  records.add_worst(TestId::worst_column, columns, expectation.columns);
  if (!inspection.has_pdf) {
    records.add_not_run(TestId::own_pdf_bins, kNoPdf);
  } else if (std::isfinite(own.integral) && own.integral > 0.0) {
    records.add_fit(TestId::own_pdf_bins, serpentine(draws.bins), serpentine(own.bins));
  }
  if (expectation.transform) {
    records.attempt(TestId::phi, [&] {
      records.add_uniformity(TestId::phi, kuiper_test(draws.column_marginal),
                             minimum_detectable_kuiper_distance);
    });
    records.attempt(TestId::theta, [&] {
      records.add_uniformity(TestId::theta, anderson_darling_test(draws.marginal),
                             minimum_detectable_anderson_darling_distance);
    });
    const std::vector<double> even = uniform_masses(kPairBins);
    records.add_fit(TestId::transformed_pair, serpentine(draws.pairs), even);
    add_positions(records, expectation, draws, run.instance->inverts_rows);
    for (std::size_t lag = 0; lag < kLags.size(); ++lag) add_pairs(records, draws, lag);
    add_runs(records, draws);
  }
  if (inspection.has_weights) {
    add_estimators(records, expectation, inspection, draws, uniform);
  } else {
    add_estimators_not_run(records);
  }
  return records.take();
}

std::vector<Measured> test_validity(const TestRun& run, const Draws& draws) {
  Records records(run, draws.samples);
  records.add_invalid(TestId::in_domain, "left the map", draws.out_of_domain);
  records.add_invalid(TestId::positive_density, "lie in texels without light", draws.zero_density);
  return records.take();
}

ReferenceDraws draw_reference(BoundSampler sampler, const Expectation& expectation,
                              const RandomStream& stream, std::uint64_t samples) {
  Draws draws = draw_samples(sampler, expectation, stream, {0, samples / 4});
  return {std::move(sampler), draws.samples, std::move(draws.bins)};
}

std::vector<Measured> test_against_reference(
    const TestRun& run, const Draws& draws,
    const std::optional<ReferenceDraws>& reference_implementation) {
  if (!run.instance->claims_reference_texels) return {};
  const auto samples = static_cast<double>(reference_implementation->samples);
  Records records(run, draws.samples);
  records.attempt(TestId::two_samples, [&] {
    records.add_two_samples(
        TestId::two_samples,
        two_sample_fit(serpentine(draws.bins), serpentine(reference_implementation->bins)),
        samples / (samples + static_cast<double>(draws.samples)));
  });
  return records.take();
}

std::vector<Measured> test_exactly(const TestRun& run, const Expectation& expectation,
                                   const BoundSampler& sampler, const Inspection& inspection,
                                   const Draws& draws,
                                   const BoundSampler* reference_implementation) {
  Records records(run, draws.samples);
  const auto attempt = [&](TestId check, const auto& perform) {
    records.attempt(check, [&] { records.add_check(perform()); });
  };
  if (expectation.transform) records.add_check(check_resolution(draws));
  const RandomStream stream = run.stream("checks");
  if (inspection.has_pdf) {
    records.add_check(check_pdf_integral(inspection.own));
    records.add_check(check_support(inspection.density));
    records.add_check(check_declared_density(inspection.density));
  } else {
    for (const TestId test :
         {TestId::pdf_integral, TestId::pdf_support, TestId::declared_density}) {
      records.add_not_run(test, kNoPdf);
    }
  }
  const std::uint64_t points = std::min(draws.samples, kMostCheckPoints);
  if (inspection.has_pdf && inspection.has_weights && inspection.takes_points) {
    attempt(TestId::returned_pdf, [&] { return check_returned_pdf(sampler, stream, points); });
  } else {
    records.add_not_run(TestId::returned_pdf, !inspection.has_pdf       ? kNoPdf
                                              : !inspection.has_weights ? kNoWeights
                                                                        : kNoPoints);
  }
  if (inspection.takes_points) {
    for (const CheckResult& check : inspection.edges) records.add_check(check);
  } else {
    for (const TestId test : {TestId::next_to_one, TestId::edge_points}) {
      records.add_not_run(test, kNoPoints);
    }
  }
  if (run.instance->claims_reference_texels) {
    attempt(TestId::same_texel, [&] {
      return check_same_texel(sampler, *reference_implementation, expectation, stream, points);
    });
  }
  return records.take();
}

}  // namespace lightproof
