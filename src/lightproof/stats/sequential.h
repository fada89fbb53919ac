// Goodness of fit that may be looked at after every sample, and stopped at any time.
//
// An e-process: a non-negative martingale under the null that starts at 1, so by Ville's
// inequality (1939) it ever reaches 1/alpha with a probability of at most alpha, whatever the rule
// of stopping. This one is the Bayes factor of a Dirichlet-multinomial distribution against the
// exact cell probabilities p (Good 1967; as a sequential test Lindon and Malek 2022). With the
// prior Dirichlet(c p) and counts n_i of sum N
//
//   E = Gamma(c) / Gamma(N + c) * prod_i Gamma(n_i + c p_i) / (Gamma(c p_i) p_i^n_i).
//
// The concentration c says how large a defect the prior expects: its mean square effect
// w^2 = sum (q - p)^2 / p is (k - 1) / (c + 1) over k cells. The test is the average of E over a
// geometric grid of c, which is an e-process as well, and so needs no guess of the effect.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace lightproof {

/// The smallest effect w for which the test is made: what 24-bit random numbers and a float CDF do
/// to a correct sampler is of this size.
inline constexpr double kSmallestSequentialEffect = 0x1p-10;

/// The sequential test of counts against the exact probabilities of cells.
class SequentialTest {
 public:
  /// Tests against the probabilities of cells, which sum to 1 within 1e-9; cells of 0 cannot be
  /// hit.
  explicit SequentialTest(std::span<const double> probability);

  /// log10 E of the counts of all cells from the first sample on; +infinity after a hit of an
  /// impossible cell. Samples that are in no cell are the caller's to judge.
  double log10_e(std::span<const std::uint64_t> counts) const;

  /// Whether E has reached 1/alpha. Stopping as soon as it has is a false alarm with a probability
  /// of at most alpha.
  static bool rejects(double log10_e, double alpha);

  /// The effect w with which E reaches 1/alpha within so many samples, with this power. Where
  /// counts are near enough to normal, log E of one concentration is (t X - k' log(1 + s)) / 2 with
  /// s = N / (c + 1), t = s / (1 + s) and X a non-central chi-square of k' = k - 1 degrees of
  /// freedom and N w^2; the best one, over their number, bounds the average from below. Infinite
  /// for a single cell.
  double minimum_detectable_effect(double alpha, double power, double samples) const;

  /// The concentrations c that E is averaged over, with equal weights: powers of two times the
  /// smallest.
  std::span<const double> concentrations() const { return concentrations_; }

 private:
  std::vector<double> probability_;
  std::vector<double> concentrations_;
};

}  // namespace lightproof
