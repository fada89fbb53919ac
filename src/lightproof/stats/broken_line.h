// Where a line bends: a straight line against broken ones with one knee or two.
//
// A knee at x = k adds c max(x - k, 0) to a straight line. Candidates are all lines with one or two
// knees at measured x that have two points or more on either side, so that no single measurement
// makes a knee; fewer than five points have none. For each candidate alone the F-test of its one or
// two more parameters is exact, if the points scatter about a straight line by normal errors of one
// unknown size. But the smallest of all these p-values is no p-value: the place was chosen after
// looking. How it is distributed depends on the x alone, as neither slope nor size of the errors
// enters, so its own p-value is its rank among those of 9999 straight lines of random normal errors
// (a Monte Carlo test: Barnard 1963), which is exact too. Bonferroni's correction would do without,
// but costs a factor of up to two, as neighbouring candidates are much alike.
//
// With two knees beside one, what is level, rises, and is level again can be told from a straight
// line by ten points; by six, only if they hardly scatter. The level speaks of that decision. The
// candidate with the smallest p-value then is the description, without a further test: of lines
// with one knee that are just told from straight ones, up to a quarter get a second beside it.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace lightproof {

struct LinePoint {
  double x = 0.0;
  double y = 0.0;
};

struct Knee {
  std::size_t point = 0;  ///< that lies in the bend
  double slope_after = 0.0;
};

struct BrokenLine {
  double slope = 0.0;       ///< before the first knee
  std::vector<Knee> knees;  ///< one or two, ascending
  double p_value = 1.0;     ///< that a straight line seems to bend so clearly, anywhere
};

/// The clearest broken line, if its p-value is at most `level`. Points with ascending x.
std::optional<BrokenLine> find_knees(std::span<const LinePoint> points, double level);

}  // namespace lightproof
