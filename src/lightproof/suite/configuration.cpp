#include "lightproof/suite/configuration.h"

#include <fmt/format.h>

#include <cmath>
#include <numeric>

#include "lightproof/stats/goodness_of_fit.h"
#include "lightproof/stats/moment_tests.h"
#include "lightproof/stats/uniformity.h"

namespace lightproof {
namespace {

/// Collects the records of one configuration.
class Records {
 public:
  Records(const Configuration& configuration, std::uint64_t samples)
      : configuration_(&configuration), samples_(samples) {}

  TestRecord& add(std::string_view oracle, std::string_view test) {
    TestRecord record;
    record.sampler = configuration_->candidate->name;
    record.weighting = configuration_->problem->weighting;
    record.map = configuration_->problem->map;
    record.source = configuration_->problem->source;
    record.oracle = oracle;
    record.test = test;
    record.samples = samples_;
    record.seed = configuration_->seed;
    record.known_defect = configuration_->candidate->known_defects;
    records_.push_back(record);
    return records_.back();
  }

  void add_fit(std::string_view oracle, std::string_view test,
               std::span<const std::uint64_t> observed, std::span<const double> probability) {
    const GoodnessOfFit fit = cressie_read(observed, probability, samples_);
    TestRecord& record = add(oracle, test);
    record.statistic = fit.statistic;
    record.dof = fit.dof;
    record.effect = fit.effect;
    if (fit.dof > 0.0 || fit.impossible_hits > 0) record.log10_p = fit.log10_p;
    // With a single possible cell every sample is in it, unless it is an impossible hit.
    if (fit.dof == 0.0 && fit.possible_cells <= 1) record.outcome = Outcome::accept;
    if (fit.dof == 0.0 && fit.possible_cells > 1) record.detail = "too few samples for two pools";
    if (fit.too_even) record.detail = "counts nearer to the expectation than chance makes them";
    if (fit.impossible_hits > 0) {
      record.detail = fmt::format("{} samples in cells without light, the first is cell {}",
                                  fit.impossible_hits, *fit.first_impossible);
    }
  }

  void add_uniformity(std::string_view test, const UniformityTest& uniformity) {
    TestRecord& record = add("reference", test);
    record.statistic = uniformity.statistic;
    record.log10_p = uniformity.log10_p;
    record.effect = uniformity.distance;
  }

  void add_worst(std::string_view test, std::span<const std::uint64_t> observed,
                 std::span<const double> probability) {
    const WorstCell worst = worst_cell(observed, probability, samples_);
    TestRecord& record = add("reference", test);
    record.statistic = worst.observed;
    record.log10_p = worst.log10_p;
    if (worst.expected > 0.0) record.effect = worst.observed / worst.expected - 1.0;
    record.detail = fmt::format("cell {}: {} samples where {:.5g} were expected", worst.cell,
                                worst.observed, worst.expected);
  }

  void add_z(std::string_view oracle, std::string_view test, const ZTest& z,
             double standard_error) {
    TestRecord& record = add(oracle, test);
    record.statistic = z.z;
    record.log10_p = z.log10_p;
    record.effect = z.effect;
    record.detectable_effect = standard_error;
  }

  void add_check(const CheckResult& result) {
    TestRecord& record = add("check", result.name);
    record.effect = result.worst;
    record.outcome = result.passed ? Outcome::accept : Outcome::reject;
    record.detail = result.detail;
  }

  void add_strays(std::string_view test, std::string_view what, const Strays& strays) {
    TestRecord& record = add("check", test);
    record.statistic = static_cast<double>(strays.count);
    record.effect = record.statistic / static_cast<double>(samples_);
    record.outcome = strays.count == 0 ? Outcome::accept : Outcome::reject;
    if (!strays.first) return;
    const auto& [u, sample] = *strays.first;
    record.detail = fmt::format(
        "{} of {} samples {}; first: u = ({:.17g}, {:.17g}) gives texel ({}, {}) at ({:.9g}, "
        "{:.9g}), pdf {:.3g}",
        strays.count, samples_, what, u.s, u.t, sample.x, sample.y, sample.at.s, sample.at.t,
        sample.pdf.value);
  }

  std::vector<TestRecord> take() { return std::move(records_); }

 private:
  const Configuration* configuration_;
  std::uint64_t samples_;
  std::vector<TestRecord> records_;
};

/// Below this share of the mean square the fourth central moment drowns in rounding, and there is
/// no test of the variance.
constexpr double kTestableVariance = 1e-5;

/// Mean and variance of an estimator; one whose exact variance is only rounding is compared with
/// its constant instead.
void add_moments(Records& records, std::string_view oracle, std::string_view test,
                 const Moments& measured, const reference::EstimatorMoments& exact) {
  if (exact.mean() <= 0.0) return;  // no light reaches this case
  if (measured.count() < 2) {
    records.add(oracle, test).detail = "no sample stayed on the map";
    return;
  }
  if (exact.variance() <= 1e-12 * exact.raw[1]) {
    const double error = std::abs(measured.mean() / exact.mean() - 1.0);
    records.add_check({std::string(test) + " is constant", error <= 1e-6, error, ""});
    return;
  }
  const double n = static_cast<double>(measured.count());
  records.add_z(oracle, test, mean_test(measured, exact.mean(), exact.variance()),
                std::sqrt(exact.variance() / n) / exact.mean());
  if (oracle != "mean" || exact.variance() <= kTestableVariance * exact.raw[1]) return;
  records.add_z("variance", test, variance_test(measured, exact.variance(), exact.fourth_central()),
                std::sqrt((exact.fourth_central() - exact.variance() * exact.variance()) / n) /
                    exact.variance());
}

/// More than half of the samples on a lattice of 2^-20 is no chance: one in 128 is expected.
CheckResult check_resolution(const Draws& draws) {
  const double share = static_cast<double>(draws.on_lattice) /
                       static_cast<double>(std::max<std::uint64_t>(1, draws.samples));
  const bool passed = share <= 0.5;
  return {"random numbers have more than 20 bits", passed, share,
          passed ? "" : fmt::format("{:.3g} of the samples lie on a lattice of 2^-20", share)};
}

std::vector<double> uniform_masses(Extent bins) {
  return std::vector<double>(bins.count(), 1.0 / static_cast<double>(bins.count()));
}

std::vector<std::uint64_t> marginal_of_rows(const Grid<std::uint64_t>& texels) {
  std::vector<std::uint64_t> counts;
  for (int y = 0; y < texels.extent().height; ++y) {
    const auto row = texels.row(y);
    counts.push_back(std::accumulate(row.begin(), row.end(), std::uint64_t{0}));
  }
  return counts;
}

std::vector<std::uint64_t> marginal_of_columns(const Grid<std::uint64_t>& texels) {
  std::vector<std::uint64_t> counts(static_cast<std::size_t>(texels.extent().width));
  for (int y = 0; y < texels.extent().height; ++y) {
    for (int x = 0; x < texels.extent().width; ++x) {
      counts[static_cast<std::size_t>(x)] += texels(x, y);
    }
  }
  return counts;
}

}  // namespace

std::string Configuration::name() const {
  return fmt::format("{}/{}/{}", candidate->name, problem->weighting, problem->map);
}

RandomStream Configuration::stream(std::string_view purpose) const {
  return {fmt::format("{}/{}", name(), purpose), seed};
}

std::vector<TestRecord> test_draws(const Configuration& configuration,
                                   const Expectation& expectation, const OwnDensity& own,
                                   const Draws& draws) {
  Records records(configuration, draws.samples);
  records.add_fit("reference", "bins 16x32", serpentine(draws.bins), serpentine(expectation.bins));
  const std::vector<std::uint64_t> rows = marginal_of_rows(draws.texels);
  const std::vector<std::uint64_t> columns = marginal_of_columns(draws.texels);
  records.add_fit("reference", "texels", serpentine(draws.texels), serpentine(expectation.masses));
  records.add_fit("reference", "rows", rows, expectation.rows);
  records.add_fit("reference", "columns", columns, expectation.columns);
  records.add_worst("worst texel", draws.texels.values(), expectation.masses.values());
  records.add_worst("worst row", rows, expectation.rows);
  records.add_worst("worst column", columns, expectation.columns);
  if (std::isfinite(own.integral) && own.integral > 0.0) {
    records.add_fit("self", "bins 16x32 of its own pdf", serpentine(draws.bins),
                    serpentine(own.bins));
  }
  if (expectation.transform) {
    records.add_uniformity("phi (Kuiper)", kuiper_test(draws.column));
    records.add_uniformity("theta (Anderson-Darling)", anderson_darling_test(draws.along));
    const std::vector<double> even = uniform_masses(kPairBins);
    records.add_fit("reference", "transformed pair", serpentine(draws.pairs), even);
  }
  for (std::size_t i = 0; i < kMeanCaseCount; ++i) {
    add_moments(records, "mean", kMeanCases[i].name, draws.estimators[i],
                expectation.estimators[i]);
  }
  add_moments(records, "self", "mean of 1/pdf", draws.inverse_pdf, expectation.inverse_pdf);
  return records.take();
}

std::vector<TestRecord> test_exactly(const Configuration& configuration,
                                     const Expectation& expectation, const BoundSampler& sampler,
                                     const OwnDensity& own, const Draws& draws) {
  Records records(configuration, draws.samples);
  records.add_strays("samples stay on the map", "left the map", draws.lost);
  records.add_strays("no dark texel is drawn", "lie in texels without light", draws.dark);
  if (expectation.transform) records.add_check(check_resolution(draws));
  const RandomStream stream = configuration.stream("checks");
  records.add_check(check_pdf_integral(own));
  records.add_check(check_returned_pdf(sampler, stream));
  records.add_check(check_edges(sampler, expectation));
  if (configuration.candidate->twin) {
    records.add_check(
        check_same_texel(sampler, configuration.candidate->twin(), expectation, stream));
  }
  return records.take();
}

}  // namespace lightproof
