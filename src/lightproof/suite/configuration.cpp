#include "lightproof/suite/configuration.h"

#include <fmt/format.h>

#include <cmath>
#include <numeric>

#include "lightproof/stats/goodness_of_fit.h"
#include "lightproof/stats/moment_tests.h"
#include "lightproof/stats/tails.h"
#include "lightproof/stats/uniformity.h"

namespace lightproof {
namespace {

/// Collects the records of one configuration.
class Records {
 public:
  Records(const Configuration& configuration, std::uint64_t samples)
      : configuration_(&configuration), samples_(samples) {}

  Measured& add(std::string_view oracle, std::string_view test) {
    return records_.emplace_back(Measured{record_of(*configuration_, oracle, test, samples_)});
  }

  void add_fit(std::string_view oracle, std::string_view test,
               std::span<const std::uint64_t> observed, std::span<const double> probability) {
    const GoodnessOfFit fit = cressie_read(observed, probability, samples_);
    auto& [record, detectable] = add(oracle, test);
    if (fit.dof > 0.0) {
      detectable = [dof = fit.dof](double level, double power, double samples) {
        return detectable_w(dof, level, power, samples);
      };
    }
    record.statistic = fit.statistic;
    record.dof = fit.dof;
    record.effect = fit.effect;
    if (fit.dof > 0.0 || fit.impossible_hits > 0) record.log10_p = fit.log10_p;
    // With a single possible cell every sample is in it, unless it is an impossible hit.
    if (fit.dof == 0.0 && fit.possible_cells <= 1) record.outcome = Outcome::accept;
    if (fit.dof == 0.0 && fit.possible_cells > 1) record.detail = "too few samples for two pools";
    if (fit.too_even && fit.log10_p < -3.0)
      record.detail = "counts nearer to the expectation than chance makes them";
    if (fit.impossible_hits > 0) {
      record.detail = fmt::format("{} samples in cells without light, the first is cell {}",
                                  fit.impossible_hits, *fit.first_impossible);
    }
  }

  /// `share`: of the other sample, of both.
  void add_two_samples(std::string_view test, const GoodnessOfFit& fit, double share) {
    auto& [record, detectable] = add("reference", test);
    record.statistic = fit.statistic;
    record.dof = fit.dof;
    record.effect = fit.effect;
    if (fit.possible_cells <= 1) record.outcome = Outcome::accept;
    if (fit.dof <= 0.0) return;
    record.log10_p = fit.log10_p;
    detectable = [dof = fit.dof, share](double level, double power, double samples) {
      return detectable_w(dof, level, power, samples * share);
    };
  }

  template <class Detectable>
  void add_uniformity(std::string_view test, const UniformityTest& uniformity,
                      const Detectable& found) {
    auto& [record, detectable] = add("reference", test);
    detectable = found;
    record.statistic = uniformity.statistic;
    record.log10_p = uniformity.log10_p;
    record.effect = uniformity.distance;
  }

  void add_worst(std::string_view test, std::span<const std::uint64_t> observed,
                 std::span<const double> probability) {
    const WorstCell worst = worst_cell(observed, probability, samples_);
    auto& [record, detectable] = add("reference", test);
    detectable = [worst](double level, double power, double samples) {
      return detectable_excess(worst, level, power, samples);
    };
    record.statistic = worst.observed;
    record.log10_p = worst.log10_p;
    if (worst.expected > 0.0) record.effect = worst.observed / worst.expected - 1.0;
    record.detail = fmt::format("cell {}: {} samples where {:.5g} were expected", worst.cell,
                                worst.observed, worst.expected);
  }

  /// `law`: of one sample of what is estimated, `exact` in the end.
  void add_z(std::string_view oracle, std::string_view test, const ZTest& z, const ExactLaw& law,
             double exact) {
    auto& [record, detectable] = add(oracle, test);
    detectable = [law, exact](double level, double power, double samples) {
      return detectable_factor(level, power, samples, law, exact) - 1.0;
    };
    record.statistic = z.z;
    record.log10_p = z.log10_p;
    record.effect = z.effect;
  }

  void add_check(const CheckResult& result) {
    TestRecord& record = add("check", result.name).record;
    record.effect = result.worst;
    record.outcome = result.passed ? Outcome::accept : Outcome::reject;
    record.detail = result.detail;
  }

  void add_strays(std::string_view test, std::string_view what, const Strays& strays) {
    TestRecord& record = add("check", test).record;
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

  /// The step of the sampler's sums makes an effect of this size by itself.
  void set_resolution_floor(double effect) {
    if (effect > 0.0) records_.back().record.resolution_floor = effect;
  }

  std::vector<Measured> take() { return std::move(records_); }

 private:
  const Configuration* configuration_;
  std::uint64_t samples_;
  std::vector<Measured> records_;
};

/// Below this share of the mean square the fourth central moment drowns in rounding, and there is
/// no test of the variance.
constexpr double kTestableVariance = 1e-5;

/// The largest value at the nodes of the quadrature, with room for what lies between them.
ExactLaw law_of(const reference::EstimatorMoments& exact) {
  const double largest = 1.1 * exact.largest;
  return {exact.mean(), exact.variance(), std::max(largest - exact.mean(), exact.mean())};
}

/// Mean and variance of an estimator; one whose exact variance is only rounding is compared with
/// its constant instead.
void add_moments(Records& records, std::string_view oracle, std::string_view test,
                 const Moments& measured, const reference::EstimatorMoments& exact) {
  if (exact.mean() <= 0.0) return;  // no light reaches this case
  if (measured.count() < 2) {
    records.add(oracle, test).record.detail = "no sample stayed on the map";
    return;
  }
  if (exact.variance() <= 1e-12 * exact.raw[1]) {
    const double error = std::abs(measured.mean() / exact.mean() - 1.0);
    records.add_check({std::string(test) + " is constant", error <= 1e-6, error, ""});
    return;
  }
  const ExactLaw law = law_of(exact);
  records.add_z(oracle, test, mean_test(measured, law), law, exact.mean());
  if (oracle != "mean" || exact.variance() <= kTestableVariance * exact.raw[1]) return;
  records.add_z("variance", test, variance_test(measured, law, exact.fourth_central()),
                law_of_squares(law, exact.fourth_central()), exact.variance());
}

/// The sampler's estimate against that of uniform directions, which has errors of its own.
void add_against_uniform(Records& records, std::string_view test, const Moments& sampled,
                         const reference::EstimatorMoments& exact, const Moments& uniform,
                         const reference::EstimatorMoments& exact_uniform) {
  if (exact.mean() <= 0.0 || sampled.count() < 2 || exact_uniform.variance() <= 0.0) return;
  const ExactLaw law = law_of(exact);
  const ExactLaw uniform_law = law_of(exact_uniform);
  records.add_z("mean", fmt::format("{}, against uniform", test),
                two_mean_test(sampled, law, uniform, uniform_law),
                law_of_difference(law, uniform_law, 1.0), exact_uniform.mean());
}

/// More than half of the samples on a lattice of 2^-20 is no chance: one in 128 is expected.
CheckResult check_resolution(const Draws& draws) {
  const std::uint64_t most = std::max(draws.along_on_lattice, draws.across_on_lattice);
  const double share =
      static_cast<double>(most) / static_cast<double>(std::max<std::uint64_t>(1, draws.samples));
  const bool passed = share <= 0.5;
  return {"random numbers have more than 20 bits", passed, share,
          passed ? "" : fmt::format("{:.3g} of the samples lie on a lattice of 2^-20", share)};
}

std::vector<double> uniform_masses(Extent bins) {
  return std::vector<double>(bins.count(), 1.0 / static_cast<double>(bins.count()));
}

}  // namespace

std::string Configuration::name() const {
  return fmt::format("{}/{}/{}", candidate->name, problem->weighting, problem->map);
}

RandomStream Configuration::stream(std::string_view purpose) const {
  return {fmt::format("{}/{}", name(), purpose), seed};
}

TestRecord record_of(const Configuration& configuration, std::string_view oracle,
                     std::string_view test, std::uint64_t samples) {
  TestRecord record;
  record.sampler = configuration.candidate->name;
  record.weighting = configuration.problem->weighting;
  record.map = configuration.problem->map;
  record.source = configuration.problem->source;
  record.oracle = oracle;
  record.test = test;
  record.samples = samples;
  record.seed = configuration.seed;
  record.known_defect = configuration.candidate->known_defects;
  return record;
}

std::vector<Measured> test_draws(const Configuration& configuration, const Expectation& expectation,
                                 const OwnDensity& own, const Draws& draws,
                                 const UniformEstimates& uniform) {
  Records records(configuration, draws.samples);
  records.add_fit("reference", "bins 16x32", serpentine(draws.bins), serpentine(expectation.bins));
  const std::vector<std::uint64_t> rows = row_counts(draws.texels);
  const std::vector<std::uint64_t> columns = column_counts(draws.texels);
  records.add_fit("reference", "texels", serpentine(draws.texels), serpentine(expectation.masses));
  const RoundingEffect rounding = rounding_effect(expectation, draws.samples);
  records.set_resolution_floor(rounding.texels * configuration.candidate->resolution);
  records.add_fit("reference", "rows", rows, expectation.rows);
  records.set_resolution_floor(rounding.rows * configuration.candidate->resolution);
  records.add_fit("reference", "columns", columns, expectation.columns);
  records.add_worst("worst texel", draws.texels.values(), expectation.masses.values());
  records.add_worst("worst row", rows, expectation.rows);
  records.add_worst("worst column", columns, expectation.columns);
  if (std::isfinite(own.integral) && own.integral > 0.0) {
    records.add_fit("self", "bins 16x32 of its own pdf", serpentine(draws.bins),
                    serpentine(own.bins));
  }
  if (expectation.transform) {
    records.add_uniformity("phi (Kuiper)", kuiper_test(draws.column), detectable_kuiper_distance);
    records.add_uniformity("theta (Anderson-Darling)", anderson_darling_test(draws.along),
                           detectable_anderson_darling_distance);
    const std::vector<double> even = uniform_masses(kPairBins);
    records.add_fit("reference", "transformed pair", serpentine(draws.pairs), even);
  }
  for (std::size_t i = 0; i < kMeanCaseCount; ++i) {
    add_moments(records, "mean", kMeanCases[i].name, draws.estimators[i],
                expectation.estimators[i]);
    add_against_uniform(records, kMeanCases[i].name, draws.estimators[i], expectation.estimators[i],
                        uniform[i], expectation.uniform[i]);
  }
  add_moments(records, "self", "mean of 1/pdf", draws.inverse_pdf, expectation.inverse_pdf);
  return records.take();
}

std::vector<Measured> test_strays(const Configuration& configuration, const Draws& draws) {
  Records records(configuration, draws.samples);
  records.add_strays("samples stay on the map", "left the map", draws.lost);
  records.add_strays("no dark texel is drawn", "lie in texels without light", draws.dark);
  return records.take();
}

Twin draw_twin(BoundSampler sampler, const Expectation& expectation, const RandomStream& stream,
               std::uint64_t samples) {
  Draws draws = draw_samples(sampler, expectation, stream, {0, samples / 4});
  return {std::move(sampler), draws.samples, std::move(draws.bins)};
}

std::vector<Measured> test_against_twin(const Configuration& configuration, const Draws& draws,
                                        const std::optional<Twin>& twin) {
  if (!configuration.candidate->has_twin) return {};
  const auto samples = static_cast<double>(twin->samples);
  Records records(configuration, draws.samples);
  records.add_two_samples("two samples with linear_scan",
                          two_sample_fit(serpentine(draws.bins), serpentine(twin->bins)),
                          samples / (samples + static_cast<double>(draws.samples)));
  return records.take();
}

std::vector<Measured> test_exactly(const Configuration& configuration,
                                   const Expectation& expectation, const BoundSampler& sampler,
                                   const Inspection& inspection, const Draws& draws,
                                   const BoundSampler* twin) {
  Records records(configuration, draws.samples);
  if (expectation.transform) records.add_check(check_resolution(draws));
  const RandomStream stream = configuration.stream("checks");
  records.add_check(check_pdf_integral(inspection.own));
  const std::uint64_t points = std::min(draws.samples, kMostCheckPoints);
  records.add_check(check_returned_pdf(sampler, stream, points));
  for (const CheckResult& check : inspection.edges) records.add_check(check);
  if (configuration.candidate->has_twin) {
    records.add_check(check_same_texel(sampler, *twin, expectation, stream, points));
  }
  return records.take();
}

}  // namespace lightproof
