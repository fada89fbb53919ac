// What can be read off a chart of speed against accuracy: errors at equal time, times and samples
// to an error, and what nothing beats.
#pragma once

#include <optional>
#include <vector>

#include "lightproof/results/accuracy_chart.h"

namespace lightproof {

/// Whether the error was measured: its standard error is at most half of it. Where it is more, the
/// error is carried by rare estimates, few or none of which were seen.
bool is_measured(const AccuracyPoint& point);

/// The error that follows from exact moments where they are known, else the measured one; not a
/// number if neither is known.
double known_error(const AccuracyPoint& point);

/// A place on a line, which may lie between two of its points.
struct LinePoint {
  double samples = 0.0;
  double seconds = 0.0;
  double error = 0.0;
};

/// The fewest whole samples that reach it.
std::uint64_t whole_samples(const LinePoint& point);

/// What a line reaches in so many seconds, by straight lines between the logarithms of its points;
/// a biased one stays at its last point with more. None if its first estimate takes longer, or if
/// it was not measured for so long.
std::optional<LinePoint> at_time(const AccuracyLine& line, double seconds);

/// Where a line first reaches an error, in the same way. None if it does not within its points.
std::optional<LinePoint> at_error(const AccuracyLine& line, double error);

/// 1 / (error^2 x seconds) at the last point whose error is known: of an unbiased line the same at
/// all of its points, but for what an estimate takes that does not depend on its samples. Not a
/// number if no error is known, or if the error is 0.
double efficiency(const AccuracyLine& line);

/// A point and the line that it belongs to, both of a chart, which must outlive it.
struct ChartPoint {
  const AccuracyLine* line;
  const AccuracyPoint* point;
};

/// The processor time of a shading point with this share of the set-up: 0 if it is not counted,
/// 1e-4 if 10,000 points share it.
double total_seconds(const ChartPoint& point, double set_up_share);

/// The points than which no other is as fast and as exact, the fastest first. One that is slower
/// than another must have less than nine tenths of its error: smaller gains are within the noise.
std::vector<ChartPoint> pareto_front(const AccuracyChart& chart, double set_up_share = 0.0);

/// The line that reaches an error first, and where.
struct FastestLine {
  const AccuracyLine* line;
  LinePoint point;
};

/// None if no line reaches it.
std::optional<FastestLine> fastest_to(const AccuracyChart& chart, double error);

/// The lines that stand for all: those on the front, and of each family without one there the most
/// efficient.
std::vector<const AccuracyLine*> leading_lines(const AccuracyChart& chart,
                                               double set_up_share = 0.0);

}  // namespace lightproof
