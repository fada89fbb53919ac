#include "lightproof/suite/diagnosis.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <numeric>

#include "lightproof/stats/goodness_of_fit.h"
#include "reference/texel_masses.h"

namespace lightproof {
namespace {

constexpr std::array<Signature, 14> kSignatures = {{
    {"off-the-map", "samples beside the map or without a density: a sum that ends below 1, a 0/0"},
    {"wrong-at-knots", "wrong only where the random number meets a knot: lower for upper bound"},
    {"same-number", "one random number for both dimensions: the marginals are right"},
    {"repeated-numbers", "random numbers used more than once: counts scatter too far everywhere"},
    {"stratified", "points too even to be independent: stratified or quasi-random ones"},
    {"coarse-numbers", "random numbers or sums with too few bits: single texels are off, all over"},
    {"one-place", "a single texel is wrong"},
    {"uneven-in-texel", "right texels, wrong places inside them"},
    {"pdf-scaled", "the pdf is off by a constant factor"},
    {"pdf-of-another-measure", "the pdf is one over another measure: the Jacobian is missing"},
    {"pdf-of-another-place", "the pdf is that of another place than the sample's"},
    {"noisy-pdf", "the pdf is a little off from place to place"},
    {"clumped", "some places are drawn too often, others too seldom, without a pattern known here"},
    {"unknown", "no defect known here explains it"},
}};

/// What the judged records say.
class Verdicts {
 public:
  explicit Verdicts(std::span<const TestRecord> records) : records_(records) {}

  bool rejected(std::string_view oracle, std::string_view test) const {
    const TestRecord* record = find(oracle, test);
    return record != nullptr && record->outcome == Outcome::reject;
  }
  bool any_rejected(std::string_view oracle) const {
    return std::any_of(records_.begin(), records_.end(), [&](const TestRecord& r) {
      return r.oracle == oracle && r.outcome == Outcome::reject;
    });
  }
  const TestRecord* find(std::string_view oracle, std::string_view test) const {
    const auto found = std::find_if(records_.begin(), records_.end(), [&](const TestRecord& r) {
      return r.oracle == oracle && r.test == test;
    });
    return found == records_.end() ? nullptr : &*found;
  }

 private:
  std::span<const TestRecord> records_;
};

bool counts_are_wrong(const Verdicts& verdicts) {
  for (const char* test : {"bins 16x32", "texels", "rows", "columns", "worst texel", "worst row",
                           "worst column", "two samples with linear_scan", "sequential"}) {
    if (verdicts.rejected("reference", test)) return true;
  }
  return false;
}

/// The logarithm of how many times likelier the counts are under `law` than as declared.
double likelihood_gain(const Draws& draws, const Grid<double>& law, const Grid<double>& declared) {
  constexpr double kImpossible = 1e-300;
  double gain = 0.0;
  for (std::size_t i = 0; i < law.values().size(); ++i) {
    const auto count = static_cast<double>(draws.texels.values()[i]);
    if (count == 0.0) continue;
    gain += count * std::log(std::max(law.values()[i], kImpossible) /
                             std::max(declared.values()[i], kImpossible));
  }
  return gain;
}

/// Divergence of the bins beyond what chance leaves.
double bin_excess(const Draws& draws, const Grid<double>& masses, Weighting weighting) {
  const auto bins = serpentine(reference::bin_masses(masses, weighting, kGateBins));
  const GoodnessOfFit fit = cressie_read(serpentine(draws.bins), bins, draws.samples);
  return fit.statistic - fit.dof;
}

/// The law under which the counts of texels are likeliest, and how much of the bins' divergence it
/// takes away.
struct Explanation {
  std::string_view law = {};
  double share = 0.0;
};

/// A gain in log-likelihood below this is chance (and nothing is named by it).
constexpr double kTellingGain = 12.0;

Explanation best_law(const Problem& problem, const Expectation& expectation, const Draws& draws) {
  Explanation best;
  Grid<double> best_masses;
  double most = kTellingGain;
  for (const Alternative& law : problem.alternatives()) {
    Grid<double> masses = law.masses();
    const double gain = likelihood_gain(draws, masses, expectation.masses);
    if (!(gain > most * (1.0 + 1e-9))) continue;  // of equals, the first
    most = gain;
    best.law = law.name;
    best_masses = std::move(masses);
  }
  if (best.law.empty()) return best;
  const Weighting weighting = expectation.weighting;
  const double before = bin_excess(draws, expectation.masses, weighting);
  const double after = bin_excess(draws, best_masses, weighting);
  // Where the bins saw nothing there is nothing to take away.
  const double noise = 6.0 * std::sqrt(2.0 * static_cast<double>(kGateBins.count()));
  best.share = before < noise ? 1.0 : (before - std::max(0.0, after)) / before;
  return best;
}

/// The law whose bins are nearest to those of the sampler's own pdf; none if the declared one is.
std::string_view law_of_pdf(const Problem& problem, const Expectation& expectation,
                            const OwnDensity& own) {
  const auto distance = [&](const Grid<double>& bins) {
    double sum = 0.0;
    for (std::size_t i = 0; i < bins.values().size(); ++i) {
      sum += std::abs(bins.values()[i] - own.bins.values()[i]);
    }
    return sum;
  };
  std::string_view best;
  double least = distance(expectation.bins);
  for (const Alternative& law : problem.alternatives()) {
    const double d =
        distance(reference::bin_masses(law.masses(), expectation.weighting, kGateBins));
    if (d < 0.5 * least) {
      least = d;
      best = law.name;
    }
  }
  return best;
}

/// Divergence per degree of freedom: 1 on average where all is right.
double dispersion(const Grid<std::uint64_t>& counts, const Grid<double>& masses,
                  std::uint64_t samples) {
  const GoodnessOfFit fit = cressie_read(serpentine(counts), serpentine(masses), samples);
  return fit.dof <= 0.0 ? 1.0 : fit.statistic / fit.dof;
}

/// Whether counts scatter by the same factor at every scale: nothing but the numbers is wrong.
bool scatters_everywhere(const Expectation& expectation, const Draws& draws) {
  const double bins = dispersion(draws.bins, expectation.bins, draws.samples);
  const double texels = dispersion(draws.texels, expectation.masses, draws.samples);
  return bins > 1.3 && texels > 1.3 && bins < 1.5 * texels && texels < 1.5 * bins;
}

bool too_even(const Expectation& expectation, const Draws& draws, const Verdicts& verdicts) {
  return verdicts.rejected("reference", "bins 16x32") &&
         dispersion(draws.bins, expectation.bins, draws.samples) < 0.7;
}

/// Whether one transformed coordinate follows from the other: each takes many values, but most
/// samples of a row lie in two bins.
bool is_one_number(const Draws& draws) {
  std::uint64_t together = 0;
  std::vector<std::uint64_t> columns(static_cast<std::size_t>(kPairBins.width));
  std::uint64_t fullest_row = 0;
  for (int y = 0; y < kPairBins.height; ++y) {
    const auto row = draws.pairs.row(y);
    std::vector<std::uint64_t> counts(row.begin(), row.end());
    std::transform(counts.begin(), counts.end(), columns.begin(), columns.begin(), std::plus<>());
    fullest_row =
        std::max(fullest_row, std::accumulate(counts.begin(), counts.end(), std::uint64_t{0}));
    std::nth_element(counts.begin(), counts.begin() + 1, counts.end(), std::greater<>());
    together += counts[0] + counts[1];
  }
  const std::uint64_t fullest =
      std::max(fullest_row, *std::max_element(columns.begin(), columns.end()));
  return 2 * together > draws.samples && 8 * fullest < draws.samples;
}

/// Whether the transformed coordinates take few values only.
bool is_coarse(const Draws& draws) {
  return 2 * std::max(draws.along_on_lattice, draws.across_on_lattice) > draws.samples;
}

/// Whether a few texels hold most of the divergence.
bool is_in_one_place(const Expectation& expectation, const Draws& draws) {
  const double n = static_cast<double>(draws.samples);
  std::vector<double> parts;
  double total = 0.0;
  for (std::size_t i = 0; i < draws.texels.values().size(); ++i) {
    const double expected = n * expectation.masses.values()[i];
    if (expected < kPooledExpectation) continue;
    const double d = static_cast<double>(draws.texels.values()[i]) - expected;
    parts.push_back(d * d / expected - 1.0);
    total += parts.back();
  }
  if (parts.size() < 4) return false;
  std::nth_element(parts.begin(), parts.begin() + 1, parts.end(), std::greater<>());
  return parts[0] + parts[1] > 0.5 * total;
}

std::string_view name_of_wrong_counts(const Problem& problem, const Expectation& expectation,
                                      const Evidence& evidence, const Verdicts& verdicts) {
  if (too_even(expectation, *evidence.draws, verdicts)) return "stratified";
  if (is_one_number(*evidence.draws)) return "same-number";
  const Explanation explanation = best_law(problem, expectation, *evidence.draws);
  if (!explanation.law.empty() && explanation.share > 0.8) return explanation.law;
  if (scatters_everywhere(expectation, *evidence.draws)) return "repeated-numbers";
  if (is_in_one_place(expectation, *evidence.draws)) return "one-place";
  if (!explanation.law.empty() && explanation.share > 0.3) return explanation.law;
  return "clumped";
}

std::string_view name_of_wrong_pdf(const Problem& problem, const Expectation& expectation,
                                   const Evidence& evidence, const Verdicts& verdicts) {
  const bool own_bins = verdicts.rejected("self", "bins 16x32 of its own pdf");
  if (verdicts.rejected("check", "pdf integrates to 1") &&
      !verdicts.rejected("check", "pdf of the sample")) {
    return own_bins ? "pdf-of-another-measure" : "pdf-scaled";
  }
  if (own_bins) {
    const std::string_view law = law_of_pdf(problem, expectation, *evidence.own);
    return law.empty() ? "pdf-of-another-place" : law;
  }
  const TestRecord* returned = verdicts.find("check", "pdf of the sample");
  if (verdicts.rejected("check", "pdf of the sample")) {
    return returned->effect > 0.5 ? "pdf-of-another-place" : "noisy-pdf";
  }
  if (!verdicts.any_rejected("mean") && !verdicts.any_rejected("variance")) return "unknown";
  // A law too near to the declared one for any count may still be the likelier one.
  const Explanation explanation = best_law(problem, expectation, *evidence.draws);
  return explanation.law.empty() ? "noisy-pdf" : explanation.law;
}

std::string_view name_of(const Problem& problem, const Expectation& expectation,
                         const Evidence& evidence) {
  const Verdicts verdicts(evidence.records);
  if (evidence.draws->lost.count > 0 || verdicts.rejected("check", "samples stay on the map")) {
    return "off-the-map";
  }
  if (is_coarse(*evidence.draws)) return "coarse-numbers";
  if (counts_are_wrong(verdicts)) {
    return name_of_wrong_counts(problem, expectation, evidence, verdicts);
  }
  for (const char* test : {"phi (Kuiper)", "theta (Anderson-Darling)", "transformed pair"}) {
    if (!verdicts.rejected("reference", test)) continue;
    // A law too near to the declared one for the counts may still be the likelier one.
    const Explanation explanation = best_law(problem, expectation, *evidence.draws);
    return explanation.law.empty() ? "uneven-in-texel" : explanation.law;
  }
  const bool pdf = verdicts.rejected("check", "pdf integrates to 1") ||
                   verdicts.rejected("check", "pdf of the sample") || verdicts.any_rejected("self");
  if (pdf) return name_of_wrong_pdf(problem, expectation, evidence, verdicts);
  if (verdicts.rejected("check", "u next to 1")) return "off-the-map";
  if (verdicts.any_rejected("check")) return "wrong-at-knots";
  return name_of_wrong_pdf(problem, expectation, evidence, verdicts);
}

std::string_view words_of(const Problem& problem, std::string_view name) {
  for (const Signature& signature : kSignatures) {
    if (signature.name == name) return signature.diagnosis;
  }
  for (const Alternative& law : problem.alternatives()) {
    if (law.name == name) return law.diagnosis;
  }
  return {};
}

Grid<double> residuals(const Expectation& expectation, const Draws& draws) {
  Grid<double> residual(kGateBins);
  const double n = static_cast<double>(draws.samples);
  for (std::size_t i = 0; i < residual.values().size(); ++i) {
    const double expected = n * expectation.bins.values()[i];
    const double observed = static_cast<double>(draws.bins.values()[i]);
    residual.values()[i] = expected > 0.0 ? (observed - expected) / std::sqrt(expected) : observed;
  }
  return residual;
}

/// Pearson's divergence of the marginal of rows 0..y.
std::vector<double> cumulative_divergence(const Expectation& expectation, const Draws& draws) {
  std::vector<double> sums;
  double sum = 0.0;
  const double n = static_cast<double>(draws.samples);
  for (int y = 0; y < draws.texels.extent().height; ++y) {
    const double expected = n * expectation.rows[static_cast<std::size_t>(y)];
    double observed = 0.0;
    for (const std::uint64_t count : draws.texels.row(y)) observed += static_cast<double>(count);
    const double d = observed - expected;
    sum += expected > 0.0 ? d * d / expected : observed;
    sums.push_back(sum);
  }
  return sums;
}

}  // namespace

std::span<const Signature> signatures() { return kSignatures; }

Rejection diagnose(const Problem& problem, const Expectation& expectation,
                   const Evidence& evidence) {
  const TestRecord& first = evidence.records.front();
  const std::string_view name = name_of(problem, expectation, evidence);
  return {first.sampler,
          first.weighting,
          first.map,
          std::string(name),
          std::string(words_of(problem, name)),
          residuals(expectation, *evidence.draws),
          cumulative_divergence(expectation, *evidence.draws)};
}

}  // namespace lightproof
