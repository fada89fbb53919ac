// How evenly points fill the unit square: discrepancies, exactly and by brute force.
#pragma once

#include <span>

#include "lightproof/core/measure.h"

namespace lightproof {

/// The star discrepancy: the largest difference between the share of the points in a box
/// [0,a) x [0,b) and its area, over all boxes. In O(N^2), by the boxes whose sides go through
/// points (Bundschuh and Zhu 1993). There is at least one point, and all are in [0,1]^2.
double star_discrepancy(std::span<const SquarePoint> points);

/// The L2 star discrepancy: the root mean square of the same differences, the corner (a,b) being
/// uniform. In O(N^2), by Warnock's formula (1972). Of N independent uniform points the mean of its
/// square is 5/(36 N).
double l2_star_discrepancy(std::span<const SquarePoint> points);

}  // namespace lightproof
