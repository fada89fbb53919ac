// Where lines bend: straight lines against segmented ones with one breakpoint or two.
//
// A breakpoint at x = k adds c max(x - k, 0) to a straight line. Candidates are all lines with one
// or two breakpoints at measured x that have two points or more on either side, so that no single
// measurement makes one; fewer than five points have none. For each candidate alone the F-test of
// its one or two more parameters is exact, if the points scatter about a straight line by normal
// errors of one unknown size. But the smallest of all these p-values is no p-value: the breakpoint
// was chosen after looking. How it is distributed depends on the x alone, as neither slope nor size
// of the errors enters, so its own p-value is its rank among those of straight lines of random
// normal errors (a Monte Carlo test: Barnard 1963), which is exact too. Bonferroni's correction
// would do without, but costs a factor of up to two, as neighbouring candidates are much alike.
//
// With two breakpoints beside one, what is level, rises, and is level again can be told from a
// straight line by ten points; by six, only if they hardly scatter. The p-value speaks of that
// decision. The candidate with the smallest p-value then is the description, without a further
// test: of lines with one breakpoint that are just told from straight ones, up to a quarter get a
// second beside it.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace lightproof {

/// A measured point of a line.
struct DataPoint {
  double x = 0.0;
  double y = 0.0;
};

/// Where the slope of a line changes.
struct Breakpoint {
  std::size_t point = 0;     ///< index of the measured point at which it changes
  double slope_after = 0.0;  ///< slope from there to the next breakpoint or the end
};

/// A line of two or three segments.
struct SegmentedLine {
  double slope = 0.0;                   ///< slope before the first breakpoint
  std::vector<Breakpoint> breakpoints;  ///< one or two, ascending
  double p_value = 1.0;  ///< P(a straight line seems to have so clear a breakpoint, anywhere)
};

/// For each of several lines, of points with ascending x, the clearest segmented one if Holm's
/// procedure (see stats/family.h) tells it from a straight one. If all are straight, none of them
/// gets a breakpoint with a probability of at least 1 - alpha, however many lines there are.
std::vector<std::optional<SegmentedLine>> segmented_lines(
    std::span<const std::vector<DataPoint>> lines, double alpha);

}  // namespace lightproof
