// Medians, and how far chance moves them.
#pragma once

#include <span>
#include <vector>

namespace lightproof {

/// The median: the middle value, or the mean of the two in the middle. NaN if there are no values.
double median(std::vector<double> values);

/// The standard error of the median of these values, by Maritz & Jarrett (1978): the exact standard
/// deviation of the median of a sample of the same size drawn from the values themselves, which a
/// bootstrap would only approach. 0 below two values.
double median_error(std::vector<double> values);

}  // namespace lightproof
