// Sums over the samples of a dump, block by block of a map's texels, of what they estimate: the
// solid angle by 1/pdf, the light by L/pdf and by given weights; beside the exact integrals.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lightproof/core/grid.h"
#include "lightproof/dump/sample_dump.h"
#include "lightproof/gate/expectation.h"
#include "lightproof/image/environment_map.h"
#include "lightproof/results/test_id.h"
#include "lightproof/stats/mean_evidence.h"
#include "lightproof/warp/mapping.h"

namespace lightproof {

/// Integrals of the map that samples estimate.
enum class EstimatedIntegrand : std::uint8_t { area, luminance, grey, red, green, blue };

struct Quantity {
  TestId test;
  EstimatedIntegrand integrand;
  const char* name;
};

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

/// Whether a row is a direction, with a positive, finite density if it has one.
bool is_usable(const DumpedSample& sample, bool has_pdf);

struct GivenSample;

/// The sums. The first fifth of the samples shows which texels are drawn and how large values are
/// in a block; the rest is summed.
class EstimateSums {
 public:
  /// Reads the dump, whose samples lie on `map`; `colours` is the map of coloured weights. All
  /// three must outlive the sums.
  EstimateSums(const SampleDump& dump, const EnvironmentMap& map, const EnvironmentMap& colours,
               bool judges_pdf);

  /// Sums of a quantity over a block: of the texels that the first fifth found, and of the others.
  struct Sums {
    ValueSums seen;
    ValueSums others;
  };

  const std::vector<Quantity>& quantities() const { return quantities_; }
  const Blocks& blocks() const { return blocks_; }
  std::uint64_t count() const { return first_ + rest_; }
  std::uint64_t rest() const { return rest_; }
  /// The rows at fault among all samples, those of the first fifth included.
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
  double light_not_hit() const;
  /// Exact light, and solid angle in steradian, of the lit texels of a block in which the first
  /// fifth has no sample.
  struct LitOthers {
    double light = 0.0;
    double area = 0.0;
  };
  /// An entry for each block.
  std::vector<LitOthers> lit_others() const;
  /// Luminance times solid angle of all texels.
  double all_light() const;

 private:
  std::size_t at(std::size_t q, std::size_t block) const { return q * blocks_.count() + block; }
  template <class Visit>
  void for_each_texel(const Visit& visit) const;
  double radiance(EstimatedIntegrand integrand, int x, int y) const;
  double value(EstimatedIntegrand integrand, const GivenSample& sample) const;
  /// Calls visit(sample) for the usable samples of a range.
  template <class Visit>
  void visit_range(std::uint64_t first, std::uint64_t count, FaultyRows& faulty,
                   FaultyRows& faulty_weights, const Visit& visit) const;
  /// The first fifth: which texels it finds, and the largest values in their blocks.
  void screen();
  void set_exact();
  void count_rest();

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

}  // namespace lightproof
