#include "lightproof/gate/diagnosis.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>

#include "lightproof/gate/deviation.h"
#include "lightproof/gate/distribution_fit.h"
#include "lightproof/gate/position_fit.h"
#include "lightproof/gate/random_number_defects.h"
#include "lightproof/gate/records.h"
#include "lightproof/gate/residuals.h"
#include "lightproof/gate/single_texel_defects.h"

namespace lightproof {
namespace {

constexpr std::array<Signature, 16> kSignatures = {{
    {"off-the-map",
     "samples beside the map, or where the distribution has none, or without a density: a sum that "
     "ends below 1, a 0/0, directions that cannot be"},
    {"wrong-at-cdf-entries",
     "wrong only where the random number meets a CDF entry: lower for upper bound"},
    {"same-number", "one random number for both dimensions: the marginals are right"},
    {"repeated-numbers", "random numbers used more than once: counts are overdispersed everywhere"},
    {"stratified",
     "counts are underdispersed, so points are not independent: stratified or quasi-random"},
    {"coarse-numbers", "random numbers or sums with too few bits: single texels are off, all over"},
    {"one-texel", "a single texel is wrong"},
    {"one-texel-missing", "one texel that has light is never drawn"},
    {"other-measure-in-texel",
     "right texels, but positions inside them are uniform in solid angle where (s,t) is declared, "
     "or the reverse"},
    {"uneven-in-texel", "right texels, wrong positions inside them"},
    {"pdf-scaled", "the pdf is off by a constant factor"},
    {"pdf-of-another-measure", "the pdf is one over another measure: the Jacobian is missing"},
    {"pdf-of-another-position", "the pdf is that of another position than the sample's"},
    {"pdf-mismatch", "sample() returns a pdf that pdf() does not confirm"},
    {"dependent-samples", "each sample right, but samples depend on those before them"},
    {"unknown", "no known defect explains the samples"},
}};

/// What the judged records say.
class Verdicts {
 public:
  explicit Verdicts(std::span<const TestRecord> records) : records_(records) {}

  bool rejected(TestId test) const {
    const TestRecord* record = find(test);
    return record != nullptr && record->outcome == Outcome::reject;
  }
  bool any_rejected(std::span<const TestId> tests) const {
    return std::any_of(tests.begin(), tests.end(), [&](TestId test) { return rejected(test); });
  }
  bool only_rejected(std::initializer_list<TestId> tests) const {
    return std::all_of(records_.begin(), records_.end(), [&](const TestRecord& r) {
      return r.outcome != Outcome::reject ||
             std::find(tests.begin(), tests.end(), r.test) != tests.end();
    });
  }
  /// An edge of the random numbers' range is where samples leave the map.
  bool leaves_map() const { return rejected(TestId::next_to_one); }
  const TestRecord* find(TestId test) const {
    const auto found = std::find_if(records_.begin(), records_.end(),
                                    [&](const TestRecord& r) { return r.test == test; });
    return found == records_.end() ? nullptr : &*found;
  }

 private:
  std::span<const TestRecord> records_;
};

/// Bins that differ by less are the same, to what quadrature and floats leave.
constexpr double kIntegrated = 1e-6;

/// What the alternatives of a test case say of one sampler.
struct ScoredAlternatives {
  std::span<const Alternative> all;
  const DistributionScores& scores;

  const Alternative* find(std::string_view name) const {
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const Alternative& a) { return a.name == name; });
    return found == all.end() ? nullptr : &*found;
  }
  double from_own_pdf(const Alternative& distribution) const {
    return scores.from_own_pdf[static_cast<std::size_t>(&distribution - all.data())];
  }
};

/// The distribution that the sampler's own pdf integrates to: the only one that takes away 99 % of
/// what separates the bins of the pdf from the declared ones.
std::string_view distribution_of_pdf(const ScoredAlternatives& distributions,
                                     const Expectation& expectation, const OwnDensity& own) {
  const double declared = distance(expectation.bins, own.bins);
  if (!(declared > kIntegrated)) return {};
  std::string_view best;
  double least = 0.01 * declared;
  for (const Alternative& distribution : distributions.all) {
    const double d = distributions.from_own_pdf(distribution);
    if (!(d < least * (1.0 - 1e-9))) continue;  // of equals, the first
    least = d;
    best = distribution.name;
  }
  return best;
}

/// Whether the samples follow this distribution of the test case.
bool fits(const ScoredAlternatives& distributions, const Draws& draws, std::string_view name) {
  const Alternative* distribution = distributions.find(name);
  return distribution != nullptr &&
         log10_fit(draws, distribution->masses()) >= std::log10(kFitLevel);
}

bool fits_declared(const Expectation& expectation, const Draws& draws) {
  return log10_fit(draws, expectation.masses) >= std::log10(kFitLevel);
}

/// A name, and how sure it is.
struct Name {
  std::string_view defect;
  std::string confidence = {};
};

std::string confidence_of(const DistributionFit& fit) {
  return fmt::format(
      "the samples are 10^{:.3g} times as likely under it as under the next distribution ({}), and "
      "fit it with p = {:.2g}",
      fit.log10_odds, fit.next.empty() ? "the declared one" : fit.next,
      std::pow(10.0, fit.log10_p));
}

/// Whether the sampler's own pdf speaks against a distribution: it is not the declared density, the
/// samples do not contradict it, so that it is what is drawn, and the distribution leaves more than
/// a quarter of what separates the two. Quadrature of a pdf that has kinks inside texels, of
/// another look-up, leaves some of it for the right distribution.
bool own_pdf_excludes(std::string_view name, const ScoredAlternatives& distributions,
                      const Expectation& expectation, const Evidence& evidence,
                      const Verdicts& verdicts) {
  constexpr double kLeft = 0.25;
  const OwnDensity& own = evidence.inspection->own;
  const double declared = distance(expectation.bins, own.bins);
  if (!(declared > kIntegrated) || verdicts.find(TestId::own_pdf_bins) == nullptr ||
      verdicts.rejected(TestId::own_pdf_bins)) {
    return false;
  }
  const Alternative* distribution = distributions.find(name);
  return distribution != nullptr && distributions.from_own_pdf(*distribution) > kLeft * declared;
}

Name name_of_distribution(const ScoredAlternatives& distributions, const Expectation& expectation,
                          const Evidence& evidence, const Verdicts& verdicts,
                          const DistributionFit& likeliest) {
  // Distributions that few samples cannot tell apart are told apart by a pdf that is what is
  // drawn.
  if (likeliest.named() &&
      !own_pdf_excludes(likeliest.distribution, distributions, expectation, evidence, verdicts)) {
    return {likeliest.distribution, confidence_of(likeliest)};
  }
  const std::string_view own =
      distribution_of_pdf(distributions, expectation, evidence.inspection->own);
  if (!own.empty() && fits(distributions, *evidence.draws, own)) {
    return {own, "the sampler's own pdf is this distribution, and the samples do not reject it"};
  }
  return {};
}

constexpr std::array kPositions = {TestId::positions_first_row, TestId::positions_between,
                                   TestId::positions_last_row};
constexpr std::array kIndependence = {TestId::independence_lag_1,  TestId::independence_lag_2,
                                      TestId::independence_lag_4,  TestId::independence_lag_8,
                                      TestId::independence_lag_16, TestId::independence_lag_32,
                                      TestId::independence_lag_64};
constexpr std::array kRunSums = {TestId::run_sums_theta, TestId::run_sums_phi};

bool positions_are_wrong(const Verdicts& verdicts) { return verdicts.any_rejected(kPositions); }

/// Pairs say so whatever the coordinates' distributions are; sums over runs only where each
/// coordinate is uniform.
bool samples_depend(const Verdicts& verdicts) {
  if (verdicts.any_rejected(kIndependence)) return true;
  const bool uniform = !verdicts.rejected(TestId::phi) && !verdicts.rejected(TestId::theta) &&
                       !verdicts.rejected(TestId::transformed_pair) &&
                       !positions_are_wrong(verdicts);
  return uniform && verdicts.any_rejected(kRunSums);
}

/// The name of a defect of the pdf alone: samples follow the declared density, and the pdf is
/// another.
Name name_of_wrong_pdf(const ScoredAlternatives& distributions, const Expectation& expectation,
                       const Evidence& evidence, const Verdicts& verdicts) {
  const Inspection& inspection = *evidence.inspection;
  const bool returned = verdicts.rejected(TestId::returned_pdf);
  const std::string whole =
      "pdf() shows it all over the map, and the samples fit the declared distribution";
  if (verdicts.rejected(TestId::declared_density)) {
    const bool has_support =
        inspection.density.undeclared_unreachable_cells == 0 && inspection.density.unlit_cells == 0;
    if (!returned && has_support && inspection.density.ratio.is_constant()) {
      return {"pdf-scaled", whole};
    }
    if (!returned && (inspection.density.times_jacobian.is_constant() ||
                      inspection.density.over_jacobian.is_constant())) {
      return {"pdf-of-another-measure", whole};
    }
    const std::string_view distribution =
        distribution_of_pdf(distributions, expectation, inspection.own);
    // The records show a distribution's shape. What has it, is 0 nowhere that it should not be, and
    // is no probability, is a density over something else.
    const bool is_density = check_pdf_integral(inspection.own).passed;
    if (!distribution.empty() && (is_density || has_support)) {
      return {is_density ? distribution : "pdf-of-another-measure", whole};
    }
  }
  if (!returned) return {};
  if (const auto position = inspection.returned_pdf_of) {
    return {"pdf-of-another-position",
            fmt::format("wherever the two differ, the returned pdf is pdf() {}", *position)};
  }
  return {"pdf-mismatch", "the two differ, and the samples fit the declared distribution"};
}

/// The name of a sampler whose texels are right, and whose positions inside them, or whose pdf's,
/// are uniform in the other measure.
Name name_of_other_measure(const Expectation& expectation, const Evidence& evidence,
                           const Verdicts& verdicts) {
  const RatioRange& over_other = evidence.inspection->density.over_other_measure;
  // The whole pdf, not a multiple of it.
  const bool pdf = verdicts.rejected(TestId::declared_density) && over_other.is_constant() &&
                   std::abs(over_other.largest - 1.0) <= kIntegrated;
  if (!pdf && !positions_are_wrong(verdicts)) return {};
  const Draws& draws = *evidence.draws;
  if (!fits_declared(expectation, draws)) return {};
  const PositionFit fit = fit_of_other_measure(expectation, draws);
  if (positions_are_wrong(verdicts) && fit.named()) {
    return {"other-measure-in-texel",
            fmt::format("positions inside texels are 10^{:.3g} times as likely under it, and fit "
                        "it with p = {:.2g}",
                        fit.log10_odds, std::pow(10.0, fit.log10_p))};
  }
  if (!pdf) return {};
  if (fit.log10_odds <= -std::log10(kNamingOdds)) {
    return {"pdf-of-another-measure",
            "inside texels pdf() is uniform in the other measure, and the samples are not"};
  }
  return {"other-measure-in-texel",
          "pdf() shows it all over the map, and the samples do not speak against it"};
}

Name name_of(const ScoredAlternatives& distributions, const Expectation& expectation,
             const Evidence& evidence) {
  const Verdicts verdicts(evidence.records);
  const Draws& draws = *evidence.draws;
  if (draws.out_of_domain.count > 0 || verdicts.rejected(TestId::in_domain)) {
    return {"off-the-map", "certain: such samples were drawn"};
  }
  if (const auto defect = name_of_number_defect(expectation, draws); !defect.empty()) {
    return {defect, "the samples fit what it predicts"};
  }
  const bool declared = fits_declared(expectation, draws);
  if (declared && samples_depend(verdicts)) {
    return {"dependent-samples",
            "pairs of samples show it, whose counts fit the declared distribution"};
  }
  const bool only_edges = verdicts.only_rejected({TestId::next_to_one, TestId::edge_points});
  if (only_edges) {
    return {verdicts.leaves_map() ? "off-the-map" : "wrong-at-cdf-entries",
            "certain: the random numbers that do it are named"};
  }
  if (is_one_texel_missing(expectation, draws, evidence.inspection->density)) {
    return {"one-texel-missing",
            "pdf() is 0 there, none of the samples to be expected lies there, and all others fit"};
  }
  // A distribution that is near the declared one may be likelier by far while both fit; it comes
  // first, as does a pdf that says so: points directed at a row miss some of it if the row sums are
  // another distribution's.
  const DistributionFit likeliest =
      likeliest_distribution(distributions.all, distributions.scores, draws);
  if (!likeliest.named()) {
    Name measure = name_of_other_measure(expectation, evidence, verdicts);
    if (!measure.defect.empty()) return measure;
  }
  if (declared && !likeliest.named()) {
    Name pdf = name_of_wrong_pdf(distributions, expectation, evidence, verdicts);
    if (!pdf.defect.empty()) return pdf;
    if (positions_are_wrong(verdicts)) {
      return {"uneven-in-texel",
              "positions show it, and counts of texels fit the declared distribution"};
    }
  }
  const Name distribution =
      name_of_distribution(distributions, expectation, evidence, verdicts, likeliest);
  if (!distribution.defect.empty()) return distribution;
  if (!declared && is_in_one_texel(expectation, draws)) {
    return {"one-texel", "all other texels fit the declared distribution"};
  }
  if (verdicts.leaves_map()) return {"off-the-map", "edges of the random numbers do it"};
  return {"unknown"};
}

/// The density that has the texels of another one, and the other measure inside them; none of the
/// texture-space density.
const DensityInfo* with_other_positions(DensitySpace density_space) {
  const auto found =
      std::find_if(kDensities.begin(), kDensities.end(), [&](const DensityInfo& density) {
        return density.texel_measure == texel_measure(density_space) &&
               density.position_measure != position_measure(density_space);
      });
  return found == kDensities.end() ? nullptr : &*found;
}

/// The words of a signature, and what they mean for this declared density.
std::string in_words(const Signature& signature, const Expectation& expectation) {
  if (signature.name != "other-measure-in-texel") return std::string(signature.diagnosis);
  const bool is_square = position_measure(expectation.density_space) == MapMeasure::square;
  const std::string words =
      fmt::format("right texels, but positions inside them are uniform in {}, not in {}",
                  is_square ? "solid angle" : "(s,t)", is_square ? "(s,t)" : "solid angle");
  const DensityInfo* density = with_other_positions(expectation.density_space);
  if (density == nullptr) return words;
  return words +
         fmt::format(": the samples fit density {} ({}) better", density->label, density->name);
}

std::string words_of(const ScoredAlternatives& distributions, const Name& name,
                     const Expectation& expectation, const Evidence& evidence) {
  for (const Signature& signature : kSignatures) {
    if (signature.name != name.defect) continue;
    const std::string what = describe_deviation(expectation, evidence);
    if (name.defect != "unknown" || what.empty()) return in_words(signature, expectation);
    return fmt::format("{}: {}", signature.diagnosis, what);
  }
  const Alternative* distribution = distributions.find(name.defect);
  return distribution != nullptr ? std::string(distribution->diagnosis) : std::string();
}

Rejection rejection_of(const ScoredAlternatives& distributions, const Expectation& expectation,
                       const Evidence& evidence, std::optional<std::string> failure) {
  Name name{"unknown"};
  std::string words;
  if (!failure) {
    failure = failure_of([&] {
      name = name_of(distributions, expectation, evidence);
      words = words_of(distributions, name, expectation, evidence);
    });
  }
  if (failure) {
    name = {"unknown"};
    words = "the diagnosis could not be computed: " + *failure;
  }
  const TestRecord& first = evidence.records.front();
  return {first.sampler,
          first.density_space,
          first.map,
          std::string(name.defect),
          words,
          residuals(expectation, *evidence.draws),
          cumulative_divergence(expectation, *evidence.draws),
          name.confidence};
}

}  // namespace

std::span<const Signature> signatures() { return kSignatures; }

std::vector<Rejection> diagnose(const TestCase& test_case, const Expectation& expectation,
                                std::span<const Evidence> rejected) {
  std::vector<Rejection> rejections(rejected.size());
  if (rejected.empty()) return rejections;
  std::vector<Alternative> alternatives;
  std::vector<DistributionScores> scores(rejected.size());
  const auto no_scores = failure_of([&] {
    alternatives = test_case.alternatives();
    std::vector<Scored> scored;
    for (const Evidence& evidence : rejected) {
      scored.push_back({evidence.draws, &evidence.inspection->own.bins});
    }
    scores = score_distributions(alternatives, expectation, scored);
  });
  for_each_holding_grids(rejected.size(), expectation, [&](std::size_t i) {
    const ScoredAlternatives distributions{alternatives, scores[i]};
    rejections[i] = rejection_of(distributions, expectation, rejected[i], no_scores);
  });
  return rejections;
}

}  // namespace lightproof
