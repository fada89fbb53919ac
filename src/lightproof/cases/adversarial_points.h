// Points of the unit square at which inversions of a CDF err, if they err.
#pragma once

#include <vector>

#include "lightproof/core/measure.h"
#include "lightproof/samplers/cdf_table.h"

namespace lightproof {

/// The largest number below 1 that a random number can be.
inline constexpr double kLastBelowOne = 1.0 - 0x1p-53;

/// Numbers in [0, 1): every CDF entry with its two neighbours, and the ends of the interval.
std::vector<double> adversarial_numbers(CdfEntries entries);

/// Points whose coordinates are both adversarial_numbers() of the marginal CDF of the rows.
std::vector<SquarePoint> adversarial_points(const CdfTable& table);

/// Points whose s is one of the adversarial_numbers() of a row's conditional CDF, and whose t leads
/// to the middle or to the first point of that row. Rows without light have none.
std::vector<SquarePoint> adversarial_points_of_rows(const CdfTable& table);

}  // namespace lightproof
