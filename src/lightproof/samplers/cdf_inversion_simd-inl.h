// What all inversions of a CdfTable share, for many samples at once: the points in units of CDF
// entries, and what follows from the CDF entries that a search has found.
#if defined(LIGHTPROOF_SAMPLERS_CDF_INVERSION_SIMD_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIGHTPROOF_SAMPLERS_CDF_INVERSION_SIMD_INL_H
#undef LIGHTPROOF_SAMPLERS_CDF_INVERSION_SIMD_INL_H
#else
#define LIGHTPROOF_SAMPLERS_CDF_INVERSION_SIMD_INL_H
#endif

#include "lightproof/samplers/cdf_table.h"
#include "lightproof/samplers/simd-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lightproof::HWY_NAMESPACE {

/// What is looked for in a block of samples, and what is found.
struct CdfCells {
  alignas(64) std::int32_t whole_s[kBatchBlock];  ///< in units of 2^-31, without fractions
  alignas(64) std::int32_t whole_t[kBatchBlock];
  alignas(64) std::int64_t y[kBatchBlock];
  alignas(64) std::int64_t x[kBatchBlock];
  alignas(64) std::int64_t row[kBatchBlock];     ///< its CDF entries: the lower and the upper one
  alignas(64) std::int64_t column[kBatchBlock];  ///< its CDF entries
};

/// Where in which cells the points lie.
struct FoundCells {
  Number x;
  Number y;
  Number column_fraction;
  Number row_fraction;
  Number mass;
};

/// In units of 2^-31.
HWY_INLINE Number scaled_to_entries(const double* points) {
  return hn::Mul(load(points), number(kCdfOne));
}

HWY_INLINE void set_whole(const BlockPoints& points, CdfCells& cells, std::size_t i) {
  store(to_int32(scaled_to_entries(points.s + i)), cells.whole_s + i);
  store(to_int32(scaled_to_entries(points.t + i)), cells.whole_t + i);
}

/// The mass of found cells, in units of 2^-31, and the share of it that lies before the number.
struct FoundCell {
  Number units;
  Number fraction;
};
HWY_INLINE FoundCell found_cell(const std::int64_t* entries, Number scaled) {
  const Int pair = load(entries);
  const Number low = to_number(low_half(pair));
  const Number units = hn::Sub(to_number(high_half(pair)), low);
  return {units, hn::Div(hn::Sub(scaled, low), units)};
}

HWY_INLINE FoundCells found_cells(const BlockPoints& points, const CdfCells& cells, std::size_t i) {
  const FoundCell row_fraction = found_cell(cells.row + i, scaled_to_entries(points.t + i));
  const FoundCell column_fraction = found_cell(cells.column + i, scaled_to_entries(points.s + i));
  return {to_number(load(cells.x + i)), to_number(load(cells.y + i)), column_fraction.fraction,
          row_fraction.fraction,
          hn::Mul(hn::Mul(number(0x1p-62), row_fraction.units), column_fraction.units)};
}

/// Writes a vector of samples.
template <class Output>
HWY_INLINE void store_found(const PositionKernel& positions, const FoundCells& found,
                            const Output& to) {
  positions.store_samples({found.x, found.y}, found.column_fraction, found.row_fraction, found.mass,
                          to);
}

}  // namespace lightproof::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // LIGHTPROOF_SAMPLERS_CDF_INVERSION_SIMD_INL_H
