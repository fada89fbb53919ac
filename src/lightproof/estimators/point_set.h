// Estimators that draw each direction from one density, at the points of a set that is more even
// than random ones, randomized anew for every estimate (Cranley and Patterson 1976; Owen 1995; for
// lighting by a map Kollig and Keller 2002, "Efficient Multidimensional Sampling").
#pragma once

#include <string_view>

#include "lightproof/estimators/estimator.h"
#include "lightproof/render/direction_source.h"

namespace lightproof {

/// Draws from this source at all points of the point set of this name, as many as the budget has,
/// seeded by the stream's point where the budget begins. Every estimate is unbiased; its samples
/// depend on each other. Of a map it keeps what the one-sample estimator keeps. Throws InputError
/// if there is no such point set.
PreparedEstimator prepare_point_set(const EnvironmentMap& map, DirectionSource source,
                                    std::string_view point_set);

}  // namespace lightproof
