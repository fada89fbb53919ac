// Where a straight line bends.
//
// For each place k in question the broken line y = a + b x + c max(x - k, 0) is fitted by least
// squares. If the points scatter about one straight line, by normal errors of one unknown size,
// then c over its standard error follows Student's t with n - 3 degrees of freedom, exactly, for
// each k. The p-value of the sharpest bend is two-sided and multiplied by the number of places
// (Bonferroni): the place was chosen after looking, so the F-test of the broken against the
// straight line, which takes it for known, would call too many knees. The places are the measured x
// with two points or more on either side: no single measurement makes a knee, and fewer than five
// points have none.
//
// What does not bend but curve leaves residuals about both lines and is called only where its
// middle stands out; with six or seven points, and so three or four degrees of freedom, a knee has
// to be some six to ten times its standard error.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

namespace lightproof {

struct LinePoint {
  double x = 0.0;
  double y = 0.0;
};

struct Knee {
  std::size_t point = 0;  ///< that lies in the bend
  double slope_before = 0.0;
  double slope_after = 0.0;
  double p_value = 1.0;  ///< that a straight line seems to bend so sharply, anywhere
};

/// The sharpest bend, if its p-value is at most `level`. Points with ascending x.
std::optional<Knee> find_knee(std::span<const LinePoint> points, double level);

}  // namespace lightproof
