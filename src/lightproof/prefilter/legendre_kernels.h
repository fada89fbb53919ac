// The recursions of the associated Legendre functions over vectors of rows. Used by
// legendre_transform.h alone, which says what they compute. All arrays are aligned to 64 bytes.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace lightproof {

/// Real and imaginary part of red, green and blue.
inline constexpr std::size_t kParts = 6;

/// Normalisation taken out of the recursion of P_l^m:
///   P_(l+1) = forward x P_l - back P_(l-1),  forward_l = a_(l+1), back_l = a_(l+1)/a_l,
///   a_l = sqrt((4l^2 - 1)/(l^2 - m^2)).
struct LegendreRecursion {
  LegendreRecursion(int order, int degree);

  std::vector<double> forward;  ///< [l - m], l = m … degree + 1
  std::vector<double> back;
};

/// One block of rows, and where its coefficients go.
struct LegendreBlock {
  std::size_t vectors;
  std::size_t padded_rows;  ///< from part to part of the rows' values
  const double* cosines;
  const double* even;
  const double* odd;
  // States of the recursions, l and l - 1: sin^2 P at the edges, integrals over the bands.
  double* at_edges;
  double* at_edges_before;
  double* integrals;
  double* integrals_before;
};

/// The rows of one vector, and where their values go.
struct LatitudeRows {
  std::size_t padded_rows;  ///< from part to part
  const double* cosines;
  const double* sectoral;  ///< P_m^m
  double* even;
  double* odd;
};

/// Doubles in a vector of this processor.
std::size_t row_lanes();

/// Adds the block's rows to coefficients[l - m][part], which has room for an even number of
/// degrees.
void analyse_block(const LegendreRecursion& recursion, int order, const LegendreBlock& block,
                   std::span<double> coefficients);

/// Sums the series of an even number of degrees at a vector of rows.
void synthesise_rows(const LegendreRecursion& recursion, std::span<const double> coefficients,
                     const LatitudeRows& rows);

}  // namespace lightproof
