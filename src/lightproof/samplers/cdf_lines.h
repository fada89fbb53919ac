// The distribution inside every run of 32 texels of a row, in the smallest form that the run needs:
// one line of the cache with 16-bit knots; where these would be too coarse, beside a lamp or the
// sun, two lines with 32-bit knots.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lightproof/core/grid.h"

namespace lightproof {

/// Texels of a run.
inline constexpr int kRunTexels = 32;

/// A texel of a run, found by a random number.
struct RunTexel {
  int index;
  double mass;      ///< its share of the run's mass
  double fraction;  ///< of the way through it, in [0,1)
};

/// Upper knots of a run in units of 1/kOne; from the last texel with mass on they are kOne, which
/// no scaled random number reaches.
template <class Integer, Integer kOne>
struct alignas(64) RunKnots {
  std::array<Integer, kRunTexels> upper;

  /// The texel that u, in [0,1), lies in: one with mass.
  RunTexel find(double u) const {
    const double scaled = u * kOne;
    const auto number = static_cast<Integer>(scaled);
    int index = 0;
    for (const Integer knot : upper) index += knot <= number ? 1 : 0;
    const double below = low(index);
    const double units = upper[static_cast<std::size_t>(index)] - below;
    return {index, units / kOne, (scaled - below) / units};
  }
  /// Share of the run's mass.
  double mass(int index) const {
    return (upper[static_cast<std::size_t>(index)] - low(index)) / kOne;
  }

 private:
  double low(int index) const {
    return index == 0 ? 0.0 : upper[static_cast<std::size_t>(index) - 1];
  }
};

/// All runs of a map, row by row; a row's last one may be shorter.
class CdfLines {
 public:
  explicit CdfLines(const Grid<double>& weights);

  /// Runs across, and rows.
  Extent extent() const { return extent_; }
  std::size_t index(int column, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(extent_.width) +
           static_cast<std::size_t>(column);
  }
  RunTexel find(std::size_t run, double u) const {
    const Narrow& knots = narrow_[run];
    return is_wide(knots) ? wide_[wide_index(knots)].find(u) : knots.find(u);
  }
  /// Share of the run's mass; of a run without any it says nothing.
  double mass(std::size_t run, int texel) const {
    const Narrow& knots = narrow_[run];
    return is_wide(knots) ? wide_[wide_index(knots)].mass(texel) : knots.mass(texel);
  }
  std::size_t bytes() const {
    return narrow_.size() * sizeof(Narrow) + wide_.size() * sizeof(Wide);
  }
  /// Runs that need the longer form.
  std::size_t wide_count() const { return wide_.size(); }

 private:
  static constexpr std::uint16_t kNarrowOne = 65535;
  static constexpr std::uint32_t kWideOne = 1U << 31U;
  using Narrow = RunKnots<std::uint16_t, kNarrowOne>;
  using Wide = RunKnots<std::uint32_t, kWideOne>;

  /// The last upper knot of a narrow run is kNarrowOne; of a wide one all that is kept in its place
  /// is where it is.
  static bool is_wide(const Narrow& knots) { return knots.upper.back() != kNarrowOne; }
  static std::size_t wide_index(const Narrow& knots) {
    return knots.upper[0] | std::size_t{knots.upper[1]} << 16U;
  }

  Extent extent_;
  std::vector<Narrow> narrow_;
  std::vector<Wide> wide_;
};

/// Sums of the weights of each run.
Grid<double> run_weights(const Grid<double>& weights);

}  // namespace lightproof
