#include "lightproof/gate/test_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>

#include "lightproof/gate/estimator_tests.h"
#include "lightproof/gate/records.h"
#include "lightproof/stats/goodness_of_fit.h"
#include "lightproof/stats/independence.h"
#include "lightproof/stats/tails.h"
#include "lightproof/stats/uniformity.h"

namespace lightproof {
namespace {

constexpr std::array kLagTests = {TestId::independence_lag_1,  TestId::independence_lag_2,
                                  TestId::independence_lag_4,  TestId::independence_lag_8,
                                  TestId::independence_lag_16, TestId::independence_lag_32,
                                  TestId::independence_lag_64};
static_assert(kLagTests.size() == kLags.size());

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
constexpr const char* kNoTransform =
    "no Rosenblatt transform of this distribution is known, which would make its samples uniform";
/// The tests of samples that the Rosenblatt transform has made uniform.
constexpr std::array<TestId, 15> kTransformed = {TestId::phi,
                                                 TestId::theta,
                                                 TestId::transformed_pair,
                                                 TestId::positions_first_row,
                                                 TestId::positions_between,
                                                 TestId::positions_last_row,
                                                 TestId::independence_lag_1,
                                                 TestId::independence_lag_2,
                                                 TestId::independence_lag_4,
                                                 TestId::independence_lag_8,
                                                 TestId::independence_lag_16,
                                                 TestId::independence_lag_32,
                                                 TestId::independence_lag_64,
                                                 TestId::run_sums_theta,
                                                 TestId::run_sums_phi};
constexpr const char* kNoPoints = "the source does not draw at given random numbers";

}  // namespace

std::string TestRun::name() const {
  return fmt::format("{}/{}/{}", instance->name, test_case->density_space, test_case->map);
}

std::string TestRun::key(std::string_view stage) const {
  return fmt::format("{}/{}/{}/{}/{}", stage, test_case->map, test_case->density_space,
                     instance->name, seed);
}

std::string purpose_of_gate(const TestCase& test_case, std::string_view sampler) {
  return fmt::format(
      "the gate over {}{}{}{}", sampler, sampler.empty() ? "" : " on ", test_case.map,
      test_case.density_space.empty() ? "" : fmt::format(" (density {})", test_case.density_space));
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
  records.add_fit(TestId::bins, draws.bins, expectation.bins);
  const std::vector<std::uint64_t> rows = row_counts(draws.texels);
  const std::vector<std::uint64_t> columns = column_counts(draws.texels);
  records.add_fit(TestId::texels, draws.texels, expectation.masses);
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
    records.add_fit(TestId::own_pdf_bins, draws.bins, own.bins);
  } else {
    records.add_not_run(TestId::own_pdf_bins,
                        fmt::format("the pdf has the integral {:.3g} over the square: it gives no "
                                    "probabilities of bins",
                                    own.integral));
  }
  if (expectation.transform) {
    records.attempt(TestId::phi, [&] {
      records.add_uniformity(TestId::phi, kuiper_test(draws.column_marginal), KuiperDistance());
    });
    records.attempt(TestId::theta, [&] {
      records.add_uniformity(TestId::theta, anderson_darling_test(draws.marginal),
                             AndersonDarlingDistance());
    });
    const std::vector<double> even = uniform_masses(kPairBins);
    records.add_fit(TestId::transformed_pair, serpentine(draws.pairs), even);
    add_positions(records, expectation, draws, run.instance->inverts_rows);
    for (std::size_t lag = 0; lag < kLags.size(); ++lag) add_pairs(records, draws, lag);
    add_runs(records, draws);
  } else {
    for (const TestId test : kTransformed) records.add_not_run(test, kNoTransform);
  }
  add_estimators(records, expectation, inspection, draws, uniform);
  return records.take();
}

std::vector<Measured> test_validity(const TestRun& run, const Draws& draws) {
  Records records(run, draws.samples);
  records.add_invalid(TestId::in_domain, "left the map", draws.out_of_domain);
  records.add_invalid(TestId::positive_density, "lie in texels without light", draws.zero_density);
  return records.take();
}

std::vector<Measured> test_unanswered(const TestRun& run, const SamplerFailure& failure,
                                      std::uint64_t samples) {
  Records records(run, samples);
  records.add_check({TestId::answers, false, 1.0, failure.what()});
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
  if (expectation.transform) {
    records.add_check(check_resolution(draws));
  } else {
    records.add_not_run(TestId::random_bits, kNoTransform);
  }
  const RandomStream stream = run.stream("checks");
  if (inspection.has_pdf) {
    records.add_check(check_pdf_integral(inspection.own));
    records.add_check(check_support(inspection.density));
    records.add_check(check_declared_density(inspection.density));
  } else {
    for (const TestId test : {TestId::pdf_integral, TestId::pdf_support}) {
      records.add_not_run(test, kNoPdf);
    }
    if (inspection.compares_samples) {
      records.add_check(check_declared_density(inspection.density));
    } else {
      records.add_not_run(TestId::declared_density, kNoPdf);
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
  if (sampler.runs_elsewhere) records.add_check({TestId::answers, true, 0.0, ""});
  if (run.instance->claims_reference_texels) {
    attempt(TestId::same_texel, [&] {
      return check_same_texel(sampler, *reference_implementation, expectation, stream, points);
    });
  }
  return records.take();
}

}  // namespace lightproof
