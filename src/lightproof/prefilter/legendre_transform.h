// The part of a spherical harmonic transform along the meridian: for one order m, between the rows
// of a map and the coefficients of the associated Legendre functions P_l^m, normalised so that
// P_l^m(cos) e^(im phi) has the norm 1 on the sphere.
//
// Forwards a row is an area: the functions are integrated over its band exactly, by a recursion of
// their own, so that a map that is constant in each texel is expanded without error, however few
// rows it has. Backwards a row is the latitude through its centres.
//
// Rows are folded at the equator, where P_l^m is even or odd with l - m: half of the values are
// computed. Every function here writes to its own rows alone; the recursions run over vectors of
// rows.
#pragma once

#include <cstddef>
#include <span>

#include "lightproof/core/huge_pages.h"
#include "lightproof/prefilter/legendre_kernels.h"

namespace lightproof {

/// The Legendre transform of the rows of a map to coefficients.
class BandTransform {
 public:
  /// For maps of this many rows, up to this degree.
  BandTransform(int height, int degree);

  /// The number of folded rows with the padding that fills them up to whole vectors.
  std::size_t padded_rows() const { return blocks_ * vectors_ * lanes_; }
  /// The row of the lower half (or the middle one) that a padded row is; of the padding it is
  /// rows() or more.
  int row_of(std::size_t index) const;
  int rows() const { return (height_ + 1) / 2; }
  int degree() const { return degree_; }

  /// coefficients[l - m][part], for l = m … degree: the sums over all rows of the integrals of
  /// P_l^m over cos(theta) times what the row holds. `even` and `odd` are the sum and the
  /// difference of row y and row height - 1 - y, [part][padded row]; 0 in the padding.
  void analyse(const LegendreRecursion& recursion, int order, std::span<const double> even,
               std::span<const double> odd, std::span<double> coefficients) const;

 private:
  void set_edges();
  void set_seeds();

  int height_;
  int degree_;
  std::size_t lanes_;
  std::size_t vectors_;  ///< of rows in a block
  std::size_t blocks_;
  TableVector<double> cosines_;    ///< of the edges, [block][vectors + 1][lane]
  TableVector<double> squares_;    ///< of their sines
  TableVector<double> sectoral_;   ///< P_m^m at the edges, [m][…]
  TableVector<double> integrals_;  ///< of P_m^m over the bands, [m][padded row]
};

/// The inverse Legendre transform, from coefficients to the latitudes of row centres.
class LatitudeTransform {
 public:
  LatitudeTransform(int height, int degree);

  /// Folded rows, filled up to whole vectors.
  std::size_t padded_rows() const { return cosines_.size(); }
  int rows() const { return (height_ + 1) / 2; }
  int degree() const { return degree_; }

  /// even[part][padded row], odd[part][padded row]: the sums over l of coefficients[l - m][part]
  /// P_l^m at the row's latitude, over even and odd l - m. Row y has even + odd, row height - 1 - y
  /// even - odd.
  void synthesise(const LegendreRecursion& recursion, int order,
                  std::span<const double> coefficients, std::span<double> even,
                  std::span<double> odd) const;

 private:
  int height_;
  int degree_;
  TableVector<double> cosines_;
  TableVector<double> sectoral_;  ///< P_m^m, [m][padded row]
};

}  // namespace lightproof
