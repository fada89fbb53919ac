#include "lightproof/check/given_estimates.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "lightproof/check/estimate_sums.h"
#include "lightproof/check/weight_check.h"
#include "lightproof/gate/expectation.h"
#include "lightproof/stats/mean_evidence.h"

namespace lightproof {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
/// By how much a value may exceed the largest that was found in its block, and a density fall below
/// the least: inside a texel it may change, and another texel's may be more extreme.
constexpr double kBeyondSeen = 4.0;

/// Evidence against one mean, and how far it is off.
struct Evidence {
  double log10_e = 0.0;
  double effect = 0.0;
  bool is_above = false;
};

/// Rounding may put samples of a bright block into a dark one beside it: as much of the whole.
constexpr double kSpilled = 1e-6;

/// The stronger evidence of both sides: over all texels for a mean that is too large, over those
/// that were found for one that is too small. Each has half of the weight.
Evidence evidence_of(const ValueSums& all, double exact, const ValueSums& seen, double exact_seen,
                     double largest) {
  const double half = std::log10(0.5);
  const auto effect = [](const ValueSums& sums, double mean) {
    return sums.sum / static_cast<double>(std::max<std::uint64_t>(1, sums.count)) / mean - 1.0;
  };
  Evidence above{-kInfinite, 0.0, true};
  Evidence below{-kInfinite, 0.0, false};
  if (exact > 0.0) above = {half + log10_evidence_above(all, exact), effect(all, exact), true};
  if (exact_seen > 0.0) {
    below = {half + log10_evidence_below(seen, exact_seen, std::max(exact_seen, largest)),
             effect(seen, exact_seen), false};
  }
  return above.log10_e >= below.log10_e ? above : below;
}

std::string words_of_block(const Blocks& blocks, std::size_t block) {
  const auto width = static_cast<std::size_t>(blocks.extent.width);
  const auto part = [](std::size_t i, int parts) { return static_cast<double>(i) / parts; };
  const std::size_t x = block % width;
  const std::size_t y = block / width;
  return fmt::format("s {:.4g} to {:.4g}, t {:.4g} to {:.4g}", part(x, blocks.extent.width),
                     part(x + 1, blocks.extent.width), part(y, blocks.extent.height),
                     part(y + 1, blocks.extent.height));
}

/// The evidence against one quantity: half of the weight is the whole's, the blocks share the rest.
struct Judged {
  Evidence whole;
  Evidence worst;           ///< of the blocks
  std::size_t block = 0;    ///< the worst
  double log10_e = 0.0;     ///< of all together
  double detectable = 0.0;  ///< relative deviation of the whole
};

Judged judged(const EstimateSums& estimates, std::size_t q, double log10_enough) {
  const std::size_t blocks = estimates.blocks().count();
  ValueSums all{estimates.rest(), 0.0, 0.0};
  ValueSums seen = all;
  double exact_seen = 0.0;
  double largest = 0.0;
  std::vector<double> logs;
  Judged result;
  result.worst.log10_e = -kInfinite;
  double of_map = 0.0;
  for (std::size_t block = 0; block < blocks; ++block) {
    of_map += estimates.exact_seen(q, block) + estimates.exact_others(q, block);
  }
  const auto add = [](ValueSums& sums, const ValueSums& more) {
    sums.sum += more.sum;
    sums.squares += more.squares;
  };
  for (std::size_t block = 0; block < blocks; ++block) {
    const ValueSums of_all = estimates.sums(q, block, true);
    const ValueSums of_seen = estimates.sums(q, block, false);
    const double of_block = estimates.exact_seen(q, block);
    const double bound = kBeyondSeen * estimates.largest(q, block);
    add(all, of_all);
    add(seen, of_seen);
    exact_seen += of_block;
    largest = std::max(largest, bound);
    const double of_all_texels =
        std::max(kSpilled * of_map, of_block + estimates.exact_others(q, block));
    const Evidence evidence = evidence_of(of_all, of_all_texels, of_seen, of_block, bound);
    logs.push_back(evidence.log10_e - std::log10(static_cast<double>(blocks)));
    if (evidence.log10_e > result.worst.log10_e) {
      result.worst = evidence;
      result.block = block;
    }
  }
  result.whole = evidence_of(all, of_map, seen, exact_seen, largest);
  // The largest of terms whose sum is the evidence, which it bounds from below.
  double most = result.whole.log10_e;
  for (const double log : logs) most = std::max(most, log);
  result.log10_e = most + std::log10(0.5);
  const auto n = static_cast<double>(estimates.rest());
  const double mean_square = n > 0.0 ? seen.squares / n / (exact_seen * exact_seen) : 0.0;
  result.detectable = detectable_by_evidence(log10_enough + 2.0 * std::log10(2.0), estimates.rest(),
                                             std::max(0.0, mean_square - 1.0),
                                             exact_seen > 0.0 ? largest / exact_seen : kInfinite);
  return result;
}

/// -log10 of a bound of P(Binomial(n, p) <= k) for k <= n p (Chernoff), else 0.
double log10_rarity_of_few(std::uint64_t n, double p, std::uint64_t k) {
  const auto trials = static_cast<double>(n);
  const double share = static_cast<double>(k) / trials;
  if (!(p > share)) return 0.0;
  p = std::min(p, 1.0 - 1e-12);
  double divergence = (1.0 - share) * std::log((1.0 - share) / (1.0 - p));
  if (share > 0.0) divergence += share * std::log(share / p);
  return trials * divergence / std::log(10.0);
}

/// Light of texels that the first fifth did not find, and the evidence that fewer samples lie there
/// than should. What should lie there follows from what is more even in the first fifth: densities,
/// which are then taken to be at least a quarter of the least in the block, or values of L/pdf,
/// which are then taken to be at most four times the largest anywhere. These must have been able to
/// add up to at least half of the light; where rare, bright samples carry it, densities decide.
struct LeftOutLight {
  double log10_e = 0.0;
  std::size_t block = 0;
  double share_of_block = 0.0;  ///< of all light
  double share_not_hit = 0.0;   ///< of all light, in texels that no sample hit
};

LeftOutLight left_out_light(const EstimateSums& estimates, std::size_t area, std::size_t light) {
  const std::size_t blocks = estimates.blocks().count();
  double largest_weight = 0.0;
  double largest_inverse = 0.0;
  for (std::size_t block = 0; block < blocks; ++block) {
    largest_weight = std::max(largest_weight, estimates.largest(light, block));
    largest_inverse = std::max(largest_inverse, estimates.largest(area, block));
  }
  const double all = estimates.all_light();
  const double unevenness_of_weights = largest_weight / all;
  const double unevenness_of_densities = largest_inverse / kSphere;
  const bool weights_decide =
      unevenness_of_weights >= 0.5 && unevenness_of_weights < unevenness_of_densities;
  const auto others = estimates.lit_others();
  LeftOutLight result;
  result.share_not_hit = estimates.light_not_hit() / all;
  if (estimates.rest() == 0) return result;
  for (std::size_t block = 0; block < blocks; ++block) {
    const auto [its_light, its_area] = others[block];
    if (!(its_light > 0.0)) continue;
    const double of_block = estimates.largest(area, block);
    const double inverse = of_block > 0.0 ? of_block : largest_inverse;
    const double least = weights_decide ? its_light / (kBeyondSeen * largest_weight)
                                        : its_area / (kBeyondSeen * inverse);
    const double log10_e =
        log10_rarity_of_few(estimates.rest(), least, estimates.hits_of_others(block)) -
        std::log10(static_cast<double>(blocks));
    if (log10_e <= result.log10_e) continue;
    result.log10_e = log10_e;
    result.block = block;
    result.share_of_block = its_light / all;
  }
  return result;
}

class Judge {
 public:
  Judge(const EstimateSums& estimates, const EnvironmentMap& map, const EstimateClaim& claim,
        const EstimateOptions& options)
      : estimates_(&estimates), map_(&map), claim_(&claim), options_(&options) {
    const std::size_t tests = estimates.quantities().size() + 1;
    enough_ = -std::log10(options.alpha / static_cast<double>(tests));
  }

  TestRecord record(TestId test) const {
    TestRecord record;
    record.sampler = claim_->name;
    record.density_space = claim_->density;
    record.map = map_->name;
    record.source = map_->source;
    record.test = test;
    record.samples = estimates_->rest();
    record.seed = options_->seed;
    record.outcome = Outcome::accept;
    return record;
  }

  /// A record, and the deviation that it would have shown.
  struct OfQuantity {
    TestRecord record;
    double detectable;
  };
  OfQuantity of_quantity(std::size_t q) const {
    const Quantity& quantity = estimates_->quantities()[q];
    const Judged found = judged(*estimates_, q, enough_);
    TestRecord result = record(quantity.test);
    set_evidence(result, found.log10_e);
    const bool is_of_whole = found.whole.log10_e + 1.0 >= found.worst.log10_e;
    result.effect = is_of_whole ? found.whole.effect : found.worst.effect;
    if (std::isfinite(found.detectable)) result.minimum_detectable_effect = found.detectable;
    if (result.outcome == Outcome::reject) {
      result.detail = fmt::format(
          "{:.3g} % {} than the exact {} {}", 100.0 * std::abs(result.effect),
          result.effect < 0.0 ? "less" : "more", quantity.name,
          is_of_whole ? "all over" : "in " + words_of_block(estimates_->blocks(), found.block));
    }
    return {std::move(result), found.detectable};
  }

  /// Makes an accepting record inconclusive if none of those that say the same could have seen as
  /// much as is asked for.
  void require_power(TestRecord& record, double detectable) const {
    if (record.outcome != Outcome::accept || detectable <= options_->must_detect) return;
    record.outcome = Outcome::inconclusive;
    record.detail = fmt::format(
        "{} samples could have seen a deviation of {} at the least where {:.3g} is asked for: draw "
        "more, or ask for less with --must-detect",
        estimates_->rest(),
        std::isfinite(detectable) ? fmt::format("{:.3g}", detectable) : "any size",
        options_->must_detect);
  }

  TestRecord of_left_out_light() const {
    const LeftOutLight found = left_out_light(*estimates_, 0, 1);
    TestRecord result = record(TestId::light_reached);
    set_evidence(result, found.log10_e);
    result.effect = found.share_not_hit;
    if (result.outcome == Outcome::reject) {
      result.effect = found.share_of_block;
      result.detail = fmt::format(
          "a hole: {:.3g} % of all light lies in texels in {} where almost no sample does",
          100.0 * found.share_of_block, words_of_block(estimates_->blocks(), found.block));
    } else if (found.share_not_hit > options_->must_detect) {
      result.outcome = Outcome::inconclusive;
      result.detail = fmt::format(
          "{:.3g} % of the light lies in texels that no sample hit: too few samples to tell a hole "
          "from a small density",
          100.0 * found.share_not_hit);
    }
    return result;
  }

  TestRecord of_rows() const {
    TestRecord result = record(TestId::in_domain);
    const FaultyRows& faulty = estimates_->faulty();
    result.statistic = static_cast<double>(faulty.count);
    // Of faulty rows the first fifth counts as well.
    result.samples = estimates_->count();
    result.effect = static_cast<double>(faulty.count) /
                    static_cast<double>(std::max<std::uint64_t>(1, estimates_->count()));
    if (faulty.count > 0) {
      result.outcome = Outcome::reject;
      result.detail = fmt::format(
          "{} rows are no directions, or without a positive, finite "
          "density; first: sample {}, counted from 0",
          faulty.count, faulty.first);
    }
    return result;
  }

 private:
  void set_evidence(TestRecord& record, double log10_e) const {
    record.statistic = std::max(0.0, log10_e);
    record.log10_p = std::min(0.0, -log10_e);
    if (log10_e >= enough_) record.outcome = Outcome::reject;
  }

  const EstimateSums* estimates_;
  const EnvironmentMap* map_;
  const EstimateClaim* claim_;
  const EstimateOptions* options_;
  double enough_;
};

/// What the rejected tests look like.
std::pair<const char*, const char*> name_of(const std::vector<TestRecord>& tests) {
  const auto rejected = [&](TestId test, int sign = 0) {
    return std::ranges::any_of(tests, [&](const TestRecord& record) {
      return record.test == test && record.outcome == Outcome::reject &&
             (sign == 0 || (record.effect > 0.0) == (sign > 0));
    });
  };
  if (rejected(TestId::in_domain)) {
    return {"off-the-map", "rows that are no samples: no direction, or no positive density"};
  }
  if (rejected(TestId::light_reached)) {
    return {"hole", "light that the samples leave out, however many there are"};
  }
  for (const TestId test : {TestId::given_area, TestId::given_light}) {
    if (rejected(test, 1)) {
      return {"pdf-too-small",
              "the given pdf is smaller than the density with which samples are drawn"};
    }
    if (rejected(test, -1)) {
      return {"pdf-too-large",
              "the given pdf is larger than the density with which samples are drawn"};
    }
  }
  if (rejected(TestId::weight_is_light)) {
    return {"wrong-weights", "the weights are not light over pdf"};
  }
  return {"wrong-weights", "the weights do not add up to the light"};
}

/// Standardised deviations of the light of the blocks, as residuals of bins.
Grid<double> residuals_of(const EstimateSums& estimates) {
  Grid<double> residual(kGateBins);
  if (estimates.quantities().empty()) return residual;
  const std::size_t q = estimates.quantities().size() > 1 ? 1 : 0;
  const auto n = static_cast<double>(std::max<std::uint64_t>(1, estimates.rest()));
  const auto width = static_cast<std::size_t>(estimates.blocks().extent.width);
  for (std::size_t block = 0; block < estimates.blocks().count(); ++block) {
    const ValueSums sums = estimates.sums(q, block, true);
    const double exact = estimates.exact_seen(q, block) + estimates.exact_others(q, block);
    const double mean = sums.sum / n;
    const double variance = std::max(0.0, sums.squares / n - mean * mean) / n;
    if (!(variance > 0.0)) continue;
    residual(static_cast<int>(block % width), static_cast<int>(block / width)) =
        (mean - exact) / std::sqrt(variance);
  }
  return residual;
}

}  // namespace

EstimateFindings judge_estimates(const SampleDump& dump, const EnvironmentMap& map,
                                 const EnvironmentMap& colours, const EstimateClaim& claim,
                                 const EstimateOptions& options) {
  const EstimateSums estimates(dump, map, colours, claim.judges_pdf);
  const Judge judge(estimates, map, claim, options);
  EstimateFindings found;
  if (claim.judges_pdf) {
    found.tests.push_back(judge.of_rows());
    found.tests.push_back(judge.of_left_out_light());
  }
  const std::size_t of_pdf = claim.judges_pdf ? 2 : 0;
  std::vector<Judge::OfQuantity> quantities;
  for (std::size_t q = 0; q < estimates.quantities().size(); ++q) {
    quantities.push_back(judge.of_quantity(q));
  }
  for (std::size_t q = 0; q < quantities.size(); ++q) {
    // Solid angle and light say the same of a pdf: the one of even samplers, the other of those
    // that draw by light.
    const double detectable = q < of_pdf
                                  ? std::min(quantities[0].detectable, quantities[1].detectable)
                                  : quantities[q].detectable;
    judge.require_power(quantities[q].record, detectable);
    found.tests.push_back(std::move(quantities[q].record));
  }
  if (dump.has_weights()) {
    TestRecord check = judge.record(TestId::weight_is_light);
    if (estimates.faulty_weights().count > 0) {
      check.outcome = Outcome::reject;
      check.statistic = static_cast<double>(estimates.faulty_weights().count);
      check.detail = fmt::format(
          "{} weights are negative or not finite; first: sample {}, counted "
          "from 0",
          estimates.faulty_weights().count, estimates.faulty_weights().first);
    } else if (dump.has_pdf()) {
      check_weights(dump, map, colours, claim.tolerance, check);
    } else {
      check.outcome = Outcome::not_run;
      check.detail = "the samples come without densities";
    }
    found.tests.push_back(std::move(check));
  }
  const bool is_rejected = std::ranges::any_of(
      found.tests, [](const TestRecord& test) { return test.outcome == Outcome::reject; });
  if (!is_rejected) return found;
  const auto [name, words] = name_of(found.tests);
  found.rejections.push_back(
      {claim.name, claim.density, map.name, name, words, residuals_of(estimates), {}, ""});
  return found;
}

}  // namespace lightproof
