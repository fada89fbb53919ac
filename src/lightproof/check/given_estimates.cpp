#include "lightproof/check/given_estimates.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "lightproof/check/compared_samples.h"
#include "lightproof/core/parallel.h"
#include "lightproof/gate/expectation.h"
#include "lightproof/stats/mean_evidence.h"
#include "lightproof/warp/mapping.h"

namespace lightproof {
namespace {

constexpr std::size_t kBatch = 4096;
constexpr double kInfinite = std::numeric_limits<double>::infinity();
/// Samples of one task; fixed, so that the split does not depend on the threads.
constexpr std::uint64_t kTaskSamples = std::uint64_t{1} << 18U;
constexpr std::uint64_t kTasksAtOnce = 16;
/// By how much a value may exceed the largest that was found in its block, and a density fall below
/// the least: inside a texel it may change, and another texel's may be more extreme.
constexpr double kBeyondSeen = 4.0;
constexpr std::uint64_t kMostCompared = std::uint64_t{1} << 22U;

/// Integrals of the map that samples estimate.
enum class Integrand : std::uint8_t { area, luminance, grey, red, green, blue };

struct Quantity {
  TestId test;
  Integrand integrand;
  const char* name;
};

constexpr Quantity kArea = {TestId::given_area, Integrand::area, "solid angle"};
constexpr Quantity kLight = {TestId::given_light, Integrand::luminance, "light"};
constexpr std::array kGrey = {Quantity{TestId::given_weights, Integrand::grey, "light"}};
constexpr std::array kColours = {Quantity{TestId::given_weights, Integrand::red, "red light"},
                                 Quantity{TestId::given_weights, Integrand::green, "green light"},
                                 Quantity{TestId::given_weights, Integrand::blue, "blue light"}};

std::vector<Quantity> quantities_of(const SampleDump& dump, bool judges_pdf) {
  std::vector<Quantity> quantities;
  if (judges_pdf) quantities = {kArea, kLight};
  if (dump.has_coloured_weights()) {
    quantities.insert(quantities.end(), kColours.begin(), kColours.end());
  } else if (dump.has_weights()) {
    quantities.insert(quantities.end(), kGrey.begin(), kGrey.end());
  }
  return quantities;
}

/// Blocks of whole texels, as many as bins at the most.
struct Blocks {
  Extent texels;
  Extent extent;

  explicit Blocks(Extent map)
      : texels(map),
        extent{std::min(map.width, kGateBins.width), std::min(map.height, kGateBins.height)} {}
  std::size_t of(int x, int y) const {
    const auto part = [](int at, int parts, int all) {
      return static_cast<int>(static_cast<std::int64_t>(at) * parts / all);
    };
    return static_cast<std::size_t>(part(y, extent.height, texels.height)) *
               static_cast<std::size_t>(extent.width) +
           static_cast<std::size_t>(part(x, extent.width, texels.width));
  }
  std::size_t count() const { return extent.count(); }
};

/// A sample's texel and what is given with it.
struct GivenSample {
  int x;
  int y;
  double pdf;
  SampleWeight weight;
};

bool is_usable(const DumpedSample& sample, bool has_pdf) {
  if (!std::isfinite(sample.direction.x)) return false;
  return !has_pdf || (sample.pdf.value > 0.0 && std::isfinite(sample.pdf.value));
}

bool is_weight(const SampleWeight& weight) {
  return std::ranges::all_of(weight, [](double w) { return w >= 0.0 && std::isfinite(w); });
}

/// Rows that cannot be what they should be: how many, and the first of them.
struct FaultyRows {
  std::uint64_t count = 0;
  std::uint64_t first = 0;

  void add(std::uint64_t row) {
    if (count++ == 0) first = row;
  }
  void merge(const FaultyRows& other) {
    if (count == 0) first = other.first;
    count += other.count;
  }
};

class Estimates {
 public:
  Estimates(const SampleDump& dump, const EnvironmentMap& map, const EnvironmentMap& colours,
            bool judges_pdf)
      : dump_(&dump),
        colours_(&colours),
        mapping_(map.mapping),
        luminance_(luminance_of(map)),
        blocks_(luminance_.extent()),
        quantities_(quantities_of(dump, judges_pdf)),
        judges_pdf_(judges_pdf),
        is_seen_(luminance_.extent()),
        is_hit_(luminance_.extent()) {
    first_ = std::max<std::uint64_t>(1, dump.count() / 5);
    rest_ = dump.count() - first_;
    see();
    set_exact();
    count_rest();
  }

  /// Sums of a quantity over a block: of the texels that the first fifth found, and of the others.
  struct Sums {
    ValueSums seen;
    ValueSums others;
  };

  const std::vector<Quantity>& quantities() const { return quantities_; }
  const Blocks& blocks() const { return blocks_; }
  std::uint64_t rest() const { return rest_; }
  const FaultyRows& faulty() const { return faulty_; }
  const FaultyRows& faulty_weights() const { return faulty_weights_; }

  /// Exact integrals over a block's texels, found by the first fifth or not.
  double exact_seen(std::size_t q, std::size_t block) const { return exact_seen_[at(q, block)]; }
  double exact_others(std::size_t q, std::size_t block) const {
    return exact_others_[at(q, block)];
  }
  /// All samples of the rest count, whatever block they lie in.
  ValueSums sums(std::size_t q, std::size_t block, bool with_others) const {
    ValueSums sums = sums_[at(q, block)].seen;
    if (with_others) sums.merge(sums_[at(q, block)].others);
    sums.count = rest_;
    return sums;
  }
  double largest(std::size_t q, std::size_t block) const { return largest_[at(q, block)]; }
  std::uint64_t hits_of_others(std::size_t block) const { return hits_of_others_[block]; }

  /// Luminance times solid angle of the texels in which no sample at all lies.
  double light_not_hit() const {
    double light = 0.0;
    for_each_texel([&](int x, int y, double solid_angle) {
      if (is_seen_(x, y) == 0 && is_hit_(x, y) == 0) light += luminance_(x, y) * solid_angle;
    });
    return light;
  }
  /// Exact light, and solid angle in steradian, of the lit texels of a block in which the first
  /// fifth has no sample.
  struct LitOthers {
    double light = 0.0;
    double area = 0.0;
  };
  std::vector<LitOthers> lit_others() const {
    std::vector<LitOthers> others(blocks_.count());
    for_each_texel([&](int x, int y, double solid_angle) {
      if (is_seen_(x, y) != 0 || !(luminance_(x, y) > 0.0)) return;
      LitOthers& of_block = others[blocks_.of(x, y)];
      of_block.light += luminance_(x, y) * solid_angle;
      of_block.area += solid_angle;
    });
    return others;
  }
  double all_light() const {
    double light = 0.0;
    for_each_texel(
        [&](int x, int y, double solid_angle) { light += luminance_(x, y) * solid_angle; });
    return light;
  }

 private:
  std::size_t at(std::size_t q, std::size_t block) const { return q * blocks_.count() + block; }

  template <class Visit>
  void for_each_texel(const Visit& visit) const {
    const Extent extent = luminance_.extent();
    for (int y = 0; y < extent.height; ++y) {
      for (int x = 0; x < extent.width; ++x) {
        visit(x, y, texel_solid_angle(mapping_, extent, x, y));
      }
    }
  }

  double radiance(Integrand integrand, int x, int y) const {
    switch (integrand) {
      case Integrand::area:
        return 1.0;
      case Integrand::luminance:
      case Integrand::grey:
        return luminance_(x, y);
      case Integrand::red:
        return colours_->radiance(x, y).r;
      case Integrand::green:
        return colours_->radiance(x, y).g;
      case Integrand::blue:
        return colours_->radiance(x, y).b;
    }
    return 0.0;
  }

  double value(Integrand integrand, const GivenSample& sample) const {
    switch (integrand) {
      case Integrand::area:
        return 1.0 / sample.pdf;
      case Integrand::luminance:
        return luminance_(sample.x, sample.y) / sample.pdf;
      case Integrand::grey:
      case Integrand::red:
        return sample.weight[0];
      case Integrand::green:
        return sample.weight[1];
      case Integrand::blue:
        return sample.weight[2];
    }
    return 0.0;
  }

  /// Calls visit(sample) for the usable samples of a range.
  template <class Visit>
  void visit_range(std::uint64_t first, std::uint64_t count, FaultyRows& faulty,
                   FaultyRows& faulty_weights, const Visit& visit) const {
    std::vector<DumpedSample> samples(kBatch);
    std::vector<SampleWeight> weights(dump_->has_weights() ? kBatch : 0);
    const Extent extent = luminance_.extent();
    for (std::uint64_t done = 0; done < count; done += kBatch) {
      const auto size = static_cast<std::size_t>(std::min<std::uint64_t>(kBatch, count - done));
      dump_->read(first + done, std::span(samples).first(size));
      if (!weights.empty()) dump_->read_weights(first + done, std::span(weights).first(size));
      for (std::size_t i = 0; i < size; ++i) {
        if (!is_usable(samples[i], judges_pdf_)) {
          faulty.add(first + done + i);
          continue;
        }
        if (!weights.empty() && !is_weight(weights[i])) {
          faulty_weights.add(first + done + i);
          continue;
        }
        const SquarePoint point = square_point_of(mapping_, samples[i].direction);
        visit(GivenSample{cell_of(point.s, extent.width), cell_of(point.t, extent.height),
                          samples[i].pdf.value, weights.empty() ? SampleWeight{} : weights[i]});
      }
    }
  }

  /// Splits a range into tasks, makes a part of each in parallel, and hands them on in order.
  template <class Part, class Make, class Take>
  static void for_each_part(std::uint64_t begin, std::uint64_t count, const Make& make,
                            const Take& take) {
    constexpr std::uint64_t kAtOnce = kTasksAtOnce * kTaskSamples;
    for (std::uint64_t start = 0; start < count; start += kAtOnce) {
      const std::uint64_t size = std::min(kAtOnce, count - start);
      std::vector<Part> parts(static_cast<std::size_t>((size + kTaskSamples - 1) / kTaskSamples));
      parallel_for(parts.size(), [&](std::size_t task) {
        const std::uint64_t first = start + task * kTaskSamples;
        parts[task] = make(begin + first, std::min(kTaskSamples, start + size - first));
      });
      for (const Part& part : parts) take(part);
    }
  }

  static void mark(Grid<std::uint8_t>& texels, int x, int y) {
    std::atomic_ref<std::uint8_t>(texels(x, y)).store(1, std::memory_order_relaxed);
  }

  /// The first fifth: which texels it finds, and the largest values in their blocks.
  void see() {
    struct Part {
      std::vector<double> largest;
      FaultyRows faulty;
      FaultyRows faulty_weights;
    };
    largest_.assign(quantities_.size() * blocks_.count(), 0.0);
    for_each_part<Part>(
        0, first_,
        [&](std::uint64_t begin, std::uint64_t count) {
          Part part{std::vector<double>(largest_.size()), {}, {}};
          visit_range(begin, count, part.faulty, part.faulty_weights, [&](const GivenSample& s) {
            mark(is_seen_, s.x, s.y);
            const std::size_t block = blocks_.of(s.x, s.y);
            for (std::size_t q = 0; q < quantities_.size(); ++q) {
              double& most = part.largest[at(q, block)];
              most = std::max(most, value(quantities_[q].integrand, s));
            }
          });
          return part;
        },
        [&](const Part& part) {
          for (std::size_t i = 0; i < largest_.size(); ++i) {
            largest_[i] = std::max(largest_[i], part.largest[i]);
          }
          faulty_.merge(part.faulty);
          faulty_weights_.merge(part.faulty_weights);
        });
  }

  void set_exact() {
    exact_seen_.assign(largest_.size(), 0.0);
    exact_others_.assign(largest_.size(), 0.0);
    for_each_texel([&](int x, int y, double solid_angle) {
      std::vector<double>& exact = is_seen_(x, y) != 0 ? exact_seen_ : exact_others_;
      const std::size_t block = blocks_.of(x, y);
      for (std::size_t q = 0; q < quantities_.size(); ++q) {
        exact[at(q, block)] += radiance(quantities_[q].integrand, x, y) * solid_angle;
      }
    });
  }

  void count_rest() {
    struct Part {
      std::vector<Sums> sums;
      std::vector<std::uint64_t> hits_of_others;
      FaultyRows faulty;
      FaultyRows faulty_weights;
    };
    sums_.resize(largest_.size());
    hits_of_others_.resize(blocks_.count());
    for_each_part<Part>(
        first_, rest_,
        [&](std::uint64_t begin, std::uint64_t count) {
          Part part{
              std::vector<Sums>(sums_.size()), std::vector<std::uint64_t>(blocks_.count()), {}, {}};
          visit_range(begin, count, part.faulty, part.faulty_weights, [&](const GivenSample& s) {
            const std::size_t block = blocks_.of(s.x, s.y);
            const bool is_seen = is_seen_(s.x, s.y) != 0;
            if (!is_seen) {
              mark(is_hit_, s.x, s.y);
              ++part.hits_of_others[block];
            }
            for (std::size_t q = 0; q < quantities_.size(); ++q) {
              Sums& sums = part.sums[at(q, block)];
              (is_seen ? sums.seen : sums.others).add(value(quantities_[q].integrand, s));
            }
          });
          return part;
        },
        [&](const Part& part) {
          for (std::size_t i = 0; i < sums_.size(); ++i) {
            sums_[i].seen.merge(part.sums[i].seen);
            sums_[i].others.merge(part.sums[i].others);
          }
          for (std::size_t i = 0; i < hits_of_others_.size(); ++i) {
            hits_of_others_[i] += part.hits_of_others[i];
          }
          faulty_.merge(part.faulty);
          faulty_weights_.merge(part.faulty_weights);
        });
  }

  const SampleDump* dump_;
  const EnvironmentMap* colours_;
  Mapping mapping_;
  Grid<double> luminance_;
  Blocks blocks_;
  std::vector<Quantity> quantities_;
  bool judges_pdf_;
  std::uint64_t first_ = 0;
  std::uint64_t rest_ = 0;
  Grid<std::uint8_t> is_seen_;  ///< by the first fifth
  Grid<std::uint8_t> is_hit_;   ///< by the rest, of those that are not
  std::vector<double> largest_;
  std::vector<double> exact_seen_;
  std::vector<double> exact_others_;
  std::vector<Sums> sums_;
  std::vector<std::uint64_t> hits_of_others_;
  FaultyRows faulty_;
  FaultyRows faulty_weights_;
};

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

Judged judged(const Estimates& estimates, std::size_t q, double log10_enough) {
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

LeftOutLight left_out_light(const Estimates& estimates, std::size_t area, std::size_t light) {
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
  Judge(const Estimates& estimates, const EnvironmentMap& map, const EstimateClaim& claim,
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
    result.effect = static_cast<double>(faulty.count) /
                    static_cast<double>(std::max<std::uint64_t>(1, estimates_->rest()));
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

  const Estimates* estimates_;
  const EnvironmentMap* map_;
  const EstimateClaim* claim_;
  const EstimateOptions* options_;
  double enough_;
};

/// The weights beside L/pdf, of up to 2^22 samples that are spread over the dump.
class WeightCheck {
 public:
  WeightCheck(const SampleDump& dump, const EnvironmentMap& map, const EnvironmentMap& colours,
              double tolerance)
      : dump_(&dump),
        mapping_(map.mapping),
        luminance_(luminance_of(map)),
        colours_(&colours),
        tolerance_(tolerance + 2.0 * dump.rounding()) {}

  void set(TestRecord& record) const {
    std::vector<DumpedSample> samples(kBatch);
    std::vector<SampleWeight> weights(kBatch);
    const std::uint64_t blocks = (dump_->count() + kBatch - 1) / kBatch;
    const std::uint64_t step = std::max<std::uint64_t>(1, blocks * kBatch / kMostCompared);
    std::uint64_t off = 0;
    record.samples = 0;
    for (std::uint64_t number = 0; number < blocks; number += step) {
      const std::uint64_t first = number * kBatch;
      const auto size =
          static_cast<std::size_t>(std::min<std::uint64_t>(kBatch, dump_->count() - first));
      dump_->read(first, std::span(samples).first(size));
      dump_->read_weights(first, std::span(weights).first(size));
      record.samples += size;
      for (std::size_t i = 0; i < size; ++i) {
        if (!is_usable(samples[i], true)) continue;
        const double error = error_of(samples[i], weights[i]);
        if (error <= tolerance_) continue;  // false for NaN
        ++off;
        if (off > 1 && !(error > record.effect)) continue;
        record.effect = error;
        record.detail = fmt::format(
            "the worst: sample {}, counted from 0: weight {:.6g} where "
            "L/pdf is {:.6g}",
            first + i, weights[i][0], expected(samples[i])[0]);
      }
    }
    record.statistic = static_cast<double>(off);
    if (off == 0) return;
    record.outcome = Outcome::reject;
    record.detail = fmt::format("{} weights are off, {}", off, record.detail);
  }

 private:
  SampleWeight light_at(Direction d) const {
    const SquarePoint at = square_point_of(mapping_, d);
    const int x = cell_of(at.s, luminance_.extent().width);
    const int y = cell_of(at.t, luminance_.extent().height);
    if (!dump_->has_coloured_weights()) {
      return {luminance_(x, y), luminance_(x, y), luminance_(x, y)};
    }
    const Rgb rgb = colours_->radiance(x, y);
    return {rgb.r, rgb.g, rgb.b};
  }

  SampleWeight expected(const DumpedSample& sample) const {
    SampleWeight light = light_at(sample.direction);
    for (double& channel : light) channel /= sample.pdf.value;
    return light;
  }

  static double distance(const SampleWeight& weight, const SampleWeight& light, double pdf) {
    double most = 0.0;
    double largest = 0.0;
    for (std::size_t c = 0; c < weight.size(); ++c) {
      most = std::max(most, std::abs(weight[c] - light[c] / pdf));
      largest = std::max(largest, light[c] / pdf);
      if (std::isnan(weight[c])) return kInfinite;
    }
    return most == 0.0 ? 0.0 : most / largest;
  }

  /// By the texel, or one within the rounding of the direction, that fits best.
  double error_of(const DumpedSample& sample, const SampleWeight& weight) const {
    double least = distance(weight, light_at(sample.direction), sample.pdf.value);
    if (least <= tolerance_) return least;
    visit_around(sample.direction, dump_->rounding(), [&](Direction turned) {
      least = std::min(least, distance(weight, light_at(turned), sample.pdf.value));
    });
    return least;
  }

  const SampleDump* dump_;
  Mapping mapping_;
  Grid<double> luminance_;
  const EnvironmentMap* colours_;
  double tolerance_;
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
Grid<double> residuals_of(const Estimates& estimates) {
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
  const Estimates estimates(dump, map, colours, claim.judges_pdf);
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
      WeightCheck(dump, map, colours, claim.tolerance).set(check);
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
