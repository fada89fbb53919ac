#include "lightproof/stats/segmented_regression.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <list>
#include <numbers>
#include <utility>

#include "lightproof/core/parallel.h"
#include "lightproof/core/random.h"
#include "lightproof/stats/family.h"
#include "lightproof/stats/tails.h"

namespace lightproof {
namespace {

using Vector = std::vector<double>;

/// Points that must lie on either side of a breakpoint.
constexpr std::size_t kBeyond = 2;
/// Straight lines that a line is ranked among, at the least.
constexpr std::size_t kLeastStraight = 9999;
/// The number of lines that may bend as clearly as one that is told from them at Holm's strictest
/// level.
constexpr double kRanksAtLevel = 4.0;

double product(const Vector& a, const Vector& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

double squared(const Vector& a) { return product(a, a); }

/// a - factor b
Vector difference(Vector a, double factor, const Vector& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] -= factor * b[i];
  return a;
}

Vector of_length_one(Vector values) {
  const double length = std::sqrt(squared(values));
  for (double& value : values) value /= length;
  return values;
}

Vector from_mean(Vector values) {
  double mean = 0.0;
  for (const double value : values) mean += value / static_cast<double>(values.size());
  for (double& value : values) value -= mean;
  return values;
}

/// What a straight line leaves of values.
struct Straightened {
  double slope = 0.0;
  Vector residuals;
};

Straightened straightened(const Vector& centred_x, const Vector& values) {
  const Vector centred = from_mean(values);
  const double slope = product(centred_x, centred) / squared(centred_x);
  return {slope, difference(centred, slope, centred_x)};
}

/// Whether the residuals are no more than what rounding leaves of values on a line.
bool is_rounding(const Vector& residuals, const Vector& values) {
  double largest = 0.0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  // Sums of n terms, of the mean and of the slope.
  const auto count = static_cast<double>(values.size());
  const double error = count * largest * std::numeric_limits<double>::epsilon();
  return squared(residuals) <= count * error * error;
}

/// A segmented line, by how it deviates from a straight one.
struct Candidate {
  std::vector<std::size_t> points;  ///< in the bends
  std::vector<Straightened> bends;  ///< of each breakpoint alone
  std::vector<Vector> directions;   ///< the residuals of the bends made orthonormal
};

/// The points at which a line may bend, one for each x.
std::vector<std::size_t> breakpoints_of(const Vector& x) {
  std::vector<std::size_t> breakpoints;
  for (std::size_t i = kBeyond; i + kBeyond < x.size(); ++i) {
    const bool inside = x[i] > x[kBeyond - 1] && x[i] < x[x.size() - kBeyond];
    if (inside && x[i] > x[i - 1]) breakpoints.push_back(i);
  }
  return breakpoints;
}

Candidate with_one_breakpoint(const Vector& x, std::size_t point) {
  Vector beyond;
  for (const double value : x) beyond.push_back(std::max(value - x[point], 0.0));
  const Straightened bend = straightened(from_mean(x), beyond);
  return {{point}, {bend}, {of_length_one(bend.residuals)}};
}

Candidate with_two_breakpoints(const Candidate& first, const Candidate& second) {
  const Vector& along = first.directions.front();
  const Straightened& bend = second.bends.front();
  const Vector across = difference(bend.residuals, product(along, bend.residuals), along);
  return {{first.points.front(), second.points.front()},
          {first.bends.front(), bend},
          {along, of_length_one(across)}};
}

/// The lines with one breakpoint, then those with two.
std::vector<Candidate> candidates_of(const Vector& x) {
  std::vector<Candidate> candidates;
  for (const std::size_t breakpoint : breakpoints_of(x))
    candidates.push_back(with_one_breakpoint(x, breakpoint));
  const std::size_t ones = candidates.size();
  for (std::size_t i = 0; i < ones; ++i) {
    for (std::size_t k = i + 1; k < ones; ++k) {
      candidates.push_back(with_two_breakpoints(candidates[i], candidates[k]));
    }
  }
  return candidates;
}

/// P-value of the F-test of one or two breakpoints that leave this share of the squares of `count`
/// residuals of a straight line.
double p_value_of(std::size_t breakpoints, double left, std::size_t count) {
  const auto dof = static_cast<double>(count - 2 - breakpoints);
  if (breakpoints == 2) return std::pow(left, 0.5 * dof);
  return 2.0 * student_upper(std::sqrt((1.0 - left) / left * dof), dof);
}

struct Clearest {
  const Candidate* candidate = nullptr;
  double p_value = 1.0;  ///< of this candidate alone
};

Clearest clearest_of(const std::vector<Candidate>& candidates, const Vector& residuals) {
  const double all = squared(residuals);
  const double rounding =
      static_cast<double>(residuals.size()) * std::numeric_limits<double>::epsilon();
  std::array<double, 2> least = {1.0, 1.0};  // share that one breakpoint leaves, and two
  std::array<const Candidate*, 2> best = {};
  for (const Candidate& candidate : candidates) {
    double left = 1.0;
    for (const Vector& direction : candidate.directions) {
      const double along = product(direction, residuals);
      left -= along * along / all;
    }
    if (left < rounding) left = 0.0;
    const std::size_t kind = candidate.points.size() - 1;
    if (left >= least[kind]) continue;
    least[kind] = left;
    best[kind] = &candidate;
  }
  Clearest clearest;
  for (std::size_t kind = 0; kind < best.size(); ++kind) {
    if (best[kind] == nullptr) continue;
    const double p = p_value_of(kind + 1, least[kind], residuals.size());
    if (clearest.candidate == nullptr || p < clearest.p_value) clearest = {best[kind], p};
  }
  return clearest;
}

/// Residuals of a straight line of standard normal errors.
Vector random_residuals(const Vector& centred_x, const RandomStream& stream) {
  Vector errors;
  for (std::size_t i = 0; i < centred_x.size(); ++i) {
    const SquarePoint u = stream.point(i);
    errors.push_back(std::sqrt(-2.0 * std::log(1.0 - u.s)) *
                     std::cos(2.0 * std::numbers::pi * u.t));
  }
  return straightened(centred_x, errors).residuals;
}

/// The slopes of the least-squares fit.
SegmentedLine fitted(const Candidate& candidate, const Straightened& line) {
  Vector changes(candidate.points.size());
  for (std::size_t i = changes.size(); i-- > 0;) {
    const Vector& direction = candidate.directions[i];
    double along = product(direction, line.residuals);
    for (std::size_t k = i + 1; k < changes.size(); ++k) {
      along -= changes[k] * product(direction, candidate.bends[k].residuals);
    }
    changes[i] = along / product(direction, candidate.bends[i].residuals);
  }
  SegmentedLine segmented = {line.slope, {}};
  for (std::size_t i = 0; i < changes.size(); ++i) {
    segmented.slope -= changes[i] * candidate.bends[i].slope;
  }
  double slope = segmented.slope;
  for (std::size_t i = 0; i < changes.size(); ++i) {
    segmented.breakpoints.push_back({candidate.points[i], slope += changes[i]});
  }
  return segmented;
}

/// The test of lines whose points have these x.
class Bends {
 public:
  Bends(Vector x, std::size_t straight_lines)
      : x_(std::move(x)), candidates_(candidates_of(x_)), straight_(straight_lines) {
    const RandomStream stream("straight lines", 1);
    const Vector centred = from_mean(x_);
    parallel_chunks(straight_.size(), kChunk, [&](std::size_t, std::size_t i, std::size_t end) {
      for (; i < end; ++i) {
        straight_[i] =
            clearest_of(candidates_, random_residuals(centred, stream.substream(i))).p_value;
      }
    });
    std::ranges::sort(straight_);
  }

  const Vector& x() const { return x_; }

  /// The clearest one through these points; none if rounding alone bends.
  std::optional<SegmentedLine> clearest(const Vector& y) const {
    const Straightened line = straightened(from_mean(x_), y);
    if (is_rounding(line.residuals, y)) return std::nullopt;
    const auto [candidate, p_value] = clearest_of(candidates_, line.residuals);
    if (candidate == nullptr) return std::nullopt;
    SegmentedLine segmented = fitted(*candidate, line);
    segmented.p_value = rank_of(p_value);
    return segmented;
  }

 private:
  static constexpr std::size_t kChunk = 256;

  /// The rank of the smallest p-value of all candidates among those of straight lines.
  double rank_of(double p_value) const {
    const auto as_clear = std::ranges::upper_bound(straight_, p_value) - straight_.begin();
    return static_cast<double>(as_clear + 1) / static_cast<double>(straight_.size() + 1);
  }

  Vector x_;
  std::vector<Candidate> candidates_;
  Vector straight_;  ///< smallest p-values of straight lines, ascending
};

Vector column_of(const std::vector<DataPoint>& points, double DataPoint::*coordinate) {
  Vector values;
  for (const DataPoint& point : points) values.push_back(point.*coordinate);
  return values;
}

/// Tests of lines, each made once for all that have the same x.
class AllBends {
 public:
  explicit AllBends(std::size_t straight_lines) : straight_lines_(straight_lines) {}

  const Bends& of(const Vector& x) {
    const auto found = std::ranges::find(tests_, x, &Bends::x);
    return found != tests_.end() ? *found : tests_.emplace_back(x, straight_lines_);
  }

 private:
  std::size_t straight_lines_;
  std::list<Bends> tests_;
};

}  // namespace

std::vector<std::optional<SegmentedLine>> segmented_lines(
    std::span<const std::vector<DataPoint>> lines, double alpha) {
  const auto may_bend = [](const std::vector<DataPoint>& points) {
    return !breakpoints_of(column_of(points, &DataPoint::x)).empty();
  };
  const auto tested = static_cast<std::size_t>(std::ranges::count_if(lines, may_bend));
  const double ranks = kRanksAtLevel / strictest_level(alpha, tested);
  AllBends tests(std::max(kLeastStraight, static_cast<std::size_t>(ranks)));
  std::vector<std::optional<SegmentedLine>> clearest(lines.size());
  std::vector<std::size_t> members;
  std::vector<double> log10_p;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (!may_bend(lines[i])) continue;
    clearest[i] =
        tests.of(column_of(lines[i], &DataPoint::x)).clearest(column_of(lines[i], &DataPoint::y));
    members.push_back(i);
    log10_p.push_back(clearest[i] ? std::log10(clearest[i]->p_value) : 0.0);
  }
  const std::vector<bool> rejected = holm_rejections(log10_p, alpha);
  for (std::size_t k = 0; k < members.size(); ++k) {
    if (!rejected[k]) clearest[members[k]].reset();
  }
  return clearest;
}

}  // namespace lightproof
