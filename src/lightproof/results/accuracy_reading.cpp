#include "lightproof/results/accuracy_reading.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace lightproof {
namespace {

constexpr double kMeasured = 0.5;  // standard error over the error
constexpr double kGain = 0.9;      // error over that of a faster one on the front

bool is_known(double error) { return std::isfinite(error) && error > 0.0; }

std::vector<LinePoint> known_points(const AccuracyLine& line) {
  std::vector<LinePoint> points;
  for (const AccuracyPoint& point : line.points) {
    const double error = known_error(point);
    if (!is_known(error) || !(point.seconds > 0.0)) continue;
    points.push_back({static_cast<double>(point.samples), point.seconds, error});
  }
  return points;
}

double between(double a, double b, double share) {
  return std::exp(std::lerp(std::log(a), std::log(b), share));
}

LinePoint between(const LinePoint& a, const LinePoint& b, double share) {
  return {between(a.samples, b.samples, share), between(a.seconds, b.seconds, share),
          between(a.error, b.error, share)};
}

/// How far `value` lies on the way from a to b, by their logarithms.
double share_of_way(double a, double b, double value) {
  return a == b ? 0.0 : std::log(value / a) / std::log(b / a);
}

bool is_on(const std::vector<const AccuracyLine*>& lines, const AccuracyLine& line) {
  return std::find(lines.begin(), lines.end(), &line) != lines.end();
}

}  // namespace

bool is_measured(const AccuracyPoint& point) { return point.rmse_error <= kMeasured * point.rmse; }

double known_error(const AccuracyPoint& point) {
  return is_known(point.predicted) || !is_measured(point) ? point.predicted : point.rmse;
}

std::uint64_t whole_samples(const LinePoint& point) {
  // Logarithms leave a whole number a little off.
  return static_cast<std::uint64_t>(std::ceil(point.samples * (1.0 - 1e-9)));
}

std::optional<LinePoint> at_time(const AccuracyLine& line, double seconds) {
  const std::vector<LinePoint> points = known_points(line);
  if (points.empty() || points.front().seconds > seconds) return std::nullopt;
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (points[i].seconds < seconds) continue;
    const LinePoint& before = points[i - 1];
    return between(before, points[i], share_of_way(before.seconds, points[i].seconds, seconds));
  }
  const bool stays = line.is_biased || points.back().seconds == seconds;
  return stays ? std::optional(points.back()) : std::nullopt;
}

std::optional<LinePoint> at_error(const AccuracyLine& line, double error) {
  const std::vector<LinePoint> points = known_points(line);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].error > error) continue;
    if (i == 0) return points[i];
    const LinePoint& before = points[i - 1];
    return between(before, points[i], share_of_way(before.error, points[i].error, error));
  }
  return std::nullopt;
}

double efficiency(const AccuracyLine& line) {
  const std::vector<LinePoint> points = known_points(line);
  if (points.empty()) return std::nan("");
  const LinePoint& last = points.back();
  return 1.0 / (last.error * last.error * last.seconds);
}

double total_seconds(const ChartPoint& point, double set_up_share) {
  return point.point->seconds + set_up_share * point.line->set_up_processor_seconds;
}

std::vector<ChartPoint> pareto_front(const AccuracyChart& chart, double set_up_share) {
  std::vector<ChartPoint> points;
  for (const AccuracyLine& line : chart.lines) {
    for (const AccuracyPoint& point : line.points) {
      if (is_known(known_error(point))) points.push_back({&line, &point});
    }
  }
  const auto costs = [&](const ChartPoint& p) {
    return std::pair(total_seconds(p, set_up_share), known_error(*p.point));
  };
  std::stable_sort(points.begin(), points.end(),
                   [&](const ChartPoint& a, const ChartPoint& b) { return costs(a) < costs(b); });
  std::vector<ChartPoint> front;
  for (const ChartPoint& p : points) {
    if (front.empty() || known_error(*p.point) < kGain * known_error(*front.back().point)) {
      front.push_back(p);
    }
  }
  return front;
}

std::optional<FastestLine> fastest_to(const AccuracyChart& chart, double error) {
  std::optional<FastestLine> fastest;
  for (const AccuracyLine& line : chart.lines) {
    const std::optional<LinePoint> point = at_error(line, error);
    if (!point || (fastest && fastest->point.seconds <= point->seconds)) continue;
    fastest = {&line, *point};
  }
  return fastest;
}

std::vector<const AccuracyLine*> leading_lines(const AccuracyChart& chart, double set_up_share) {
  std::vector<const AccuracyLine*> leading;
  for (const ChartPoint& p : pareto_front(chart, set_up_share)) {
    if (!is_on(leading, *p.line)) leading.push_back(p.line);
  }
  const std::vector<const AccuracyLine*> front = leading;
  for (const AccuracyLine& line : chart.lines) {
    const auto rival = std::find_if(leading.begin(), leading.end(), [&](const AccuracyLine* other) {
      return other->family == line.family;
    });
    if (rival == leading.end()) {
      leading.push_back(&line);
    } else if (!is_on(front, **rival) && efficiency(line) > efficiency(**rival)) {
      *rival = &line;
    }
  }
  return leading;
}

}  // namespace lightproof
