// Estimators that are the mean over samples of one source of directions, whichever it is.
#pragma once

#include <string_view>

#include "lightproof/estimators/estimator.h"
#include "lightproof/estimators/light_samples.h"

namespace lightproof {

/// The mean over independent samples, at the points of the stream.
PreparedEstimator independent_samples(PreparedSource source);

/// The mean over samples at all points of the point set of this name, as many as the budget has,
/// seeded by the stream's point where the budget begins. Throws InputError if there is no such
/// point set.
PreparedEstimator samples_at_points(PreparedSource source, std::string_view point_set);

}  // namespace lightproof
