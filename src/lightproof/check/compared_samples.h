// The densities that come with samples, beside the declared ones.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

#include "lightproof/dump/sample_dump.h"
#include "lightproof/gate/density_check.h"

namespace lightproof {

/// Directions around a sample's own that rounding may have moved it to it from: as many on a circle
/// that is so much larger than the rounding that an edge within it lies between two of them.
void visit_around(Direction d, double rounding, const std::function<void(Direction)>& visit);

/// The most samples of a block.
inline constexpr std::size_t kSampleBlock = 4096;

/// Calls visit(first, block) for up to 2^22 samples, in blocks that are spread over the dump;
/// `first` is the number of a block's first sample.
void visit_spread(const SampleDump& dump,
                  const std::function<void(std::uint64_t, std::span<const DumpedSample>)>& visit);

/// A comparison of densities at samples.
class ComparedSamples {
 public:
  /// An empty comparison, of samples in texels of this mapping.
  explicit ComparedSamples(const Mapping& mapping) : mapping_(mapping) {
    found_.compared = "samples";
  }

  /// Adds what a sample's density says beside the declared one, from which it may be off by
  /// `tolerance`, relative.
  void add(const ComparedCell& cell, double tolerance);

  DensityComparison result() const { return found_; }

 private:
  Mapping mapping_;
  DensityComparison found_;
  double worst_ = 0.0;  ///< error of the worst sample over its tolerance
};

}  // namespace lightproof
