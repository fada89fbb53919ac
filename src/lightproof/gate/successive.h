// Counts that show whether samples depend on those before them: pairs of samples at several lags,
// and sums over short runs.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lightproof/core/grid.h"

namespace lightproof {

/// Distances in the sequence of samples at which pairs are counted.
inline constexpr std::array<std::size_t, 7> kLags = {1, 2, 4, 8, 16, 32, 64};
/// How many equal cells each transformed coordinate has.
inline constexpr int kPairedCells = 8;
/// How many successive samples' transformed coordinates are added up.
inline constexpr std::size_t kRunLength = 16;
/// How many cells the sums over runs have, equally likely where the samples are independent.
inline constexpr int kRunCells = 32;

/// Transformed coordinates of a sample, each uniform in [0,1]; not a number if the sample left the
/// map.
struct TransformedSample {
  double marginal;     ///< mass below the sample's t
  double conditional;  ///< mass to its left at its t, as a share of all mass there
};

/// The cells of both coordinates in one number; a last one for a sample that left the map.
std::uint8_t cells_code(const TransformedSample& sample);

/// The four pairs of a sample's coordinates with those of another, counted over
/// kPairedCells x kPairedCells: row = the earlier sample's cell, column = the later one's.
struct PairCounts {
  enum Pair {
    marginal_marginal,
    marginal_conditional,
    conditional_marginal,
    conditional_conditional
  };
  std::array<Grid<std::uint64_t>, 4> pairs;
  std::uint64_t total = 0;
};

/// Counts of pairs of successive samples and of sums over runs. `merge` in any order gives the same
/// counts.
class SuccessiveCounts {
 public:
  /// Counts the pairs of a stretch of the sequence, in its order, as cells_code(); its first
  /// samples are not paired with those of another stretch.
  void add_pairs(std::span<const std::uint8_t> codes);
  /// Counts the sums over runs of kRunLength samples, one after the other; what does not fill a run
  /// is left out.
  void add_runs(std::span<const TransformedSample> samples);
  void merge(const SuccessiveCounts& other);

  /// The counts of pairs at the distance kLags[lag].
  PairCounts pairs(std::size_t lag) const;
  /// The counts of sums over runs, by their kRunCells cells: of the marginal coordinates (0) or of
  /// the conditional ones (1).
  std::span<const std::uint64_t> runs(std::size_t coordinate) const { return runs_[coordinate]; }

 private:
  static constexpr std::size_t kCodes = static_cast<std::size_t>(kPairedCells) * kPairedCells;
  /// How many codes a sample has; the last one stands for a sample that left the map.
  static constexpr std::size_t kStride = kCodes + 1;

  /// Empty until something is added: counts are kept for every task.
  std::array<std::vector<std::uint64_t>, kLags.size()> codes_;
  std::array<std::vector<std::uint64_t>, 2> runs_ = {std::vector<std::uint64_t>(kRunCells),
                                                     std::vector<std::uint64_t>(kRunCells)};
};

}  // namespace lightproof
