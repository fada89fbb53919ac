// Tables whose masses are rounded to few bits: half floats, or bytes that hold a small float. What
// is drawn is the density of the rounded masses, so that estimates stay unbiased.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "lightproof/core/direction.h"
#include "lightproof/core/grid.h"
#include "lightproof/estimators/light_samples.h"
#include "lightproof/samplers/texel_positions.h"

namespace lightproof {

/// What a texel's luminance is rounded to, relative to the brightest one of its row. A texel with
/// light has at least the smallest positive number, so that none loses its mass.
enum class MassForm {
  half,  ///< IEEE half float: 11 significant bits, from 2^-24 on
  byte,  ///< 3 bits after the leading one and 5 of an exponent, from 2^-30 on
};

/// Rows by cumulative sums in double; in a row, cumulative sums of every 32 texels, then the
/// rounded luminances of these one by one.
class RoundedTable {
 public:
  /// Throws InputError if the map is black.
  RoundedTable(const EnvironmentMap& map, MassForm form);

  LightSample sample(SquarePoint u) const;
  /// The probability of a texel.
  double mass(int x, int y) const;
  /// The memory of the table.
  std::size_t bytes() const;

 private:
  std::uint16_t code(std::size_t texel) const {
    return form_ == MassForm::half ? halves_[texel] : bytes_[texel];
  }
  double value(std::size_t texel) const;
  std::span<const double> runs_of(int y) const;

  MassForm form_;
  Extent extent_;
  std::vector<std::uint16_t> halves_;  ///< the numbers as stored, of one form or the other
  std::vector<std::uint8_t> bytes_;
  std::vector<double> rows_;  ///< cumulative light of the rows
  std::vector<double> runs_;  ///< cumulative values of the runs in each row
  TexelPositions positions_;
};

/// Directions by such a table. Throws InputError if the map is black.
PreparedSource rounded_table_source(const EnvironmentMap& map, MassForm form);

/// The density of such a table, per steradian, at any position in the square of latitude and
/// longitude. Throws
/// InputError if the map is black.
std::function<PerSteradian(SquarePoint)> rounded_table_pdf(const EnvironmentMap& map,
                                                           MassForm form);

/// What rounding adds to the variance of one sample of ∫ L, relative to its square: the sum of
/// m^2/M less 1, m and M the probabilities of texels before and after. 0 of a black map.
double rounded_table_variance(const EnvironmentMap& map, MassForm form);

}  // namespace lightproof
