// The first two dimensions of Sobol's sequence (Sobol 1967) with the direction numbers of Joe and
// Kuo (2008, "Constructing Sobol sequences with better two-dimensional projections"), a
// (0,2)-sequence in base 2; and its scrambling after Owen (1995, "Randomly permuted (t,m,s)-nets
// and (t,s)-sequences"), by which the error of smooth integrands falls with N^(-3/2).
#pragma once

#include <cstdint>

#include "lightproof/points/point_set.h"
#include "lightproof/points/radical_inverse.h"
#include "lightproof/points/random_words.h"
#include "lightproof/points/unit_fraction.h"

namespace lightproof {

/// The second dimension of Sobol's sequence with its bits in reverse order. Its direction numbers
/// are those of the primitive polynomial 1 + x: as polynomials over GF(2), mirrored, the powers of
/// 1 + x. The point is therefore the index as a polynomial, taken at 1 + x in place of x, and a
/// power 2^k of 1 + x is 1 + x^(2^k): five steps take the place of a loop over 32 numbers.
constexpr std::uint32_t reversed_sobol_second(std::uint32_t index) {
  index ^= index >> 16U;
  index ^= (index & 0xff00ff00U) >> 8U;
  index ^= (index & 0xf0f0f0f0U) >> 4U;
  index ^= (index & 0xccccccccU) >> 2U;
  return index ^ ((index & 0xaaaaaaaaU) >> 1U);
}

/// Owen's scrambling of a number whose bits are in reverse order: every bit is turned over or not,
/// at random for each value of the bits before it. Here they are the lower ones, and products with
/// even numbers and sums carry upwards alone (Laine and Karras 2011, "Stratified Sampling for
/// Stochastic Transparency"; Burley 2020, "Practical Hash-based Owen Scrambling", JCGT 9(4)); the
/// constants are Vegdahl's (2021, "Building a Better LK Hash").
constexpr std::uint32_t owen_scrambled_reversed(std::uint32_t word, std::uint32_t seed) {
  word ^= word * 0x3d20adeaU;
  word += seed;
  word *= (seed >> 16U) | 1U;
  word ^= word * 0x05526c56U;
  return word ^ (word * 0x53a22864U);
}

/// Sobol's points; a seed scrambles them. Any 2^m of them from a multiple of 2^m on are a
/// (0,m,2)-net, scrambled or not.
class Sobol {
 public:
  explicit Sobol(PointSeed seed) : is_scrambled_(seed.has_value()), seeds_(shift_of(seed)) {}

  SquarePoint point(std::uint32_t index) const {
    WordPair reversed = {index, reversed_sobol_second(index)};
    if (is_scrambled_) {
      reversed = {owen_scrambled_reversed(reversed.s, seeds_.s),
                  owen_scrambled_reversed(reversed.t, seeds_.t)};
    }
    return {from_fixed_point(reversed_bits(reversed.s)),
            from_fixed_point(reversed_bits(reversed.t))};
  }

 private:
  bool is_scrambled_;
  WordPair seeds_;
};

}  // namespace lightproof
