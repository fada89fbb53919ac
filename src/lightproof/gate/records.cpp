#include "lightproof/gate/records.h"

#include <fmt/format.h>

#include <cmath>
#include <exception>
#include <new>

#include "lightproof/core/error.h"
#include "lightproof/gate/sampler_failure.h"

namespace lightproof {
namespace {

void set_fit(TestRecord& record, const GoodnessOfFit& fit) {
  record.statistic = fit.statistic;
  record.dof = fit.dof;
  record.effect = fit.effect;
  if (fit.dof > 0.0 || fit.impossible_hits > 0) record.log10_p = fit.log10_p;
}

}  // namespace

std::optional<std::string> failure_of(const std::function<void()>& computation) {
  try {
    computation();
  } catch (const InputError&) {
    throw;
  } catch (const Interrupted&) {
    throw;
  } catch (const OutOfMemory&) {
    throw;
  } catch (const SamplerFailure&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    return error.what();
  }
  return std::nullopt;
}

Measured& Records::add(TestId test) {
  return records_.emplace_back(Measured{record_of(*run_, test, samples_)});
}

void Records::attempt(TestId test, const std::function<void()>& run) {
  const std::size_t before = records_.size();
  const std::optional<std::string> failure = failure_of(run);
  if (!failure) return;
  records_.erase(records_.begin() + static_cast<std::ptrdiff_t>(before), records_.end());
  add(test).record.detail = "could not be computed: " + *failure;
}

void Records::add_fit(TestId test, std::span<const std::uint64_t> observed,
                      std::span<const double> probability) {
  add_fit(test, [&] { return cressie_read(observed, probability, samples_); });
}

void Records::add_fit(TestId test, const Grid<std::uint64_t>& observed,
                      const Grid<double>& probability) {
  add_fit(test, [&] { return cressie_read(observed, probability, samples_); });
}

void Records::add_fit(TestId test, const std::function<GoodnessOfFit()>& compute) {
  attempt(test, [&] {
    const GoodnessOfFit fit = compute();
    Measured& added = add(test);
    TestRecord& record = added.record;
    if (fit.dof > 0.0) added.detectable = EffectOnCells{fit.dof};
    set_fit(record, fit);
    // With a single possible cell every sample is in it, unless it is an impossible hit.
    if (fit.dof == 0.0 && fit.possible_cells <= 1) record.outcome = Outcome::accept;
    if (fit.dof == 0.0 && fit.possible_cells > 1) record.detail = "too few samples for two pools";
    if (fit.underdispersed && fit.log10_p < -3.0)
      record.detail = "counts nearer to the expectation than chance makes them";
    if (fit.impossible_hits > 0) {
      record.detail = fmt::format("{} samples in cells without light, the first is cell {}",
                                  fit.impossible_hits, *fit.first_impossible);
    }
  });
}

void Records::add_partial_fit(TestId test, const GoodnessOfFit& fit, std::uint64_t fit_samples) {
  Measured& added = add(test);
  set_fit(added.record, fit);
  const double share = static_cast<double>(fit_samples) / static_cast<double>(samples_);
  added.detectable = EffectOnCells{fit.dof, share};
}

void Records::add_not_run(TestId test, std::string why) {
  TestRecord& record = add(test).record;
  record.outcome = Outcome::not_run;
  record.detail = std::move(why);
}

void Records::add_two_samples(TestId test, const GoodnessOfFit& fit, double share) {
  Measured& added = add(test);
  TestRecord& record = added.record;
  record.statistic = fit.statistic;
  record.dof = fit.dof;
  record.effect = fit.effect;
  if (fit.possible_cells <= 1) record.outcome = Outcome::accept;
  if (fit.dof <= 0.0) return;
  record.log10_p = fit.log10_p;
  added.detectable = EffectOnCells{fit.dof, share};
}

void Records::add_uniformity(TestId test, const UniformityTest& uniformity,
                             DetectableEffect detectable) {
  Measured& added = add(test);
  added.detectable = detectable;
  added.record.statistic = uniformity.statistic;
  added.record.log10_p = uniformity.log10_p;
  added.record.effect = uniformity.distance;
}

void Records::add_worst(TestId test, std::span<const std::uint64_t> observed,
                        std::span<const double> probability) {
  attempt(test, [&] {
    const WorstCell worst = worst_cell(observed, probability, samples_);
    Measured& added = add(test);
    TestRecord& record = added.record;
    added.detectable = ExcessOfWorstCell{worst.cells, worst.likeliest};
    record.statistic = worst.observed;
    record.log10_p = worst.log10_p;
    if (worst.expected > 0.0) record.effect = worst.observed / worst.expected - 1.0;
    record.detail = fmt::format("cell {}: {} samples where {:.5g} were expected", worst.cell,
                                worst.observed, worst.expected);
  });
}

void Records::add_z(TestId test, const ZTest& z, const ExactMoments& moments, double exact) {
  Measured& added = add(test);
  TestRecord& record = added.record;
  added.detectable = ErrorOfMean{moments, exact};
  record.statistic = z.z;
  record.log10_p = z.log10_p;
  record.effect = z.effect;
}

void Records::add_check(const CheckResult& result) {
  TestRecord& record = add(result.test).record;
  record.effect = result.worst;
  record.outcome = result.passed ? Outcome::accept : Outcome::reject;
  record.detail = result.detail;
}

void Records::add_invalid(TestId test, std::string_view what,
                          const InvalidSamples& invalid_samples) {
  TestRecord& record = add(test).record;
  record.statistic = static_cast<double>(invalid_samples.count);
  record.effect = record.statistic / static_cast<double>(samples_);
  record.outcome = invalid_samples.count == 0 ? Outcome::accept : Outcome::reject;
  if (!invalid_samples.first) return;
  const auto& [u, sample, number] = *invalid_samples.first;
  const std::string from = std::isnan(u.s) ? fmt::format("sample {}, counted from 0,", number)
                                           : fmt::format("u = ({:.17g}, {:.17g})", u.s, u.t);
  record.detail = fmt::format(
      "{} of {} samples {}; first: {} gives texel ({}, {}) at ({:.9g}, {:.9g}), pdf {:.3g}",
      invalid_samples.count, samples_, what, from, sample.x, sample.y, sample.at.s, sample.at.t,
      sample.pdf.value);
}

void Records::set_resolution_floor(double effect) {
  if (effect > 0.0 && !records_.empty()) records_.back().record.resolution_floor = effect;
}

void Records::set_detail(std::string detail) {
  if (!records_.empty()) records_.back().record.detail = std::move(detail);
}

}  // namespace lightproof
