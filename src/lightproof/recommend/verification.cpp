#include "lightproof/recommend/verification.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <span>

#include "lightproof/accuracy/measurement.h"
#include "lightproof/results/accuracy_reading.h"
#include "lightproof/results/percent.h"

namespace lightproof {
namespace {

/// Steps between numbers of samples that are run to find one, and the largest of each run: what a
/// run finds ends the search of others.
constexpr std::uint64_t kSearchStep = 2;
constexpr std::array<std::uint64_t, 3> kSearchStages = {64, 2048, kMostDirections};

/// What is expected to take so many times as long as the best is given up.
constexpr double kTooSlow = 1.6;

/// Candidates that are verified at a time, and how often the number of samples of one is corrected.
constexpr std::size_t kVerifiedAtATime = 4;
constexpr int kMostAttempts = 4;

/// An error below so much of what is asked for has more samples than it needs; by which slope of
/// error against samples fewer are tried, at what share of them that is worth while, and how far a
/// power of two may lie from what that slope says.
constexpr double kGenerous = 0.85;
constexpr double kSteepestSlope = 0.85;
constexpr double kWorthTrying = 0.85;
constexpr double kPowerReach = 0.7;

/// Samples at one point in a round, and estimates at most.
constexpr std::uint64_t kSamplesOfARound = 4096;
constexpr std::uint64_t kMostEstimatesOfARound = 64;

/// Standard errors within which a measured error agrees with an exact one.
constexpr double kAgreement = 3.0;

constexpr int kSearchRounds = 6;

void sort_by_time(std::vector<Candidate>& candidates, const MethodDemand& demand) {
  std::ranges::stable_sort(candidates, {}, [&](const Candidate& candidate) {
    return candidate.seconds(demand, candidate.samples);
  });
}

/// "riemann has an error of 3.1 % at 4096 samples".
Obstacle measured_obstacle(const MethodDemand& demand, const Candidate& candidate,
                           const AccuracyPoint& point) {
  const EstimatorInfo& info = *candidate.info;
  const double error = credible_error(point);
  std::string reason =
      std::isfinite(error)
          ? fmt::format("{} has an error of {}", info.name, plain_percent(error))
          : fmt::format("the error of {} is carried by samples too rare to be seen", info.name);
  if (!info.ignores_budget) {
    reason += fmt::format(" at {} {}", point.samples, point.samples == 1 ? "sample" : "samples");
  }
  return {error / demand.error, reason + ", measured"};
}

/// The number of samples at which a measured line falls to the error, between two points by a
/// straight line on log-log paper; none if it does not.
std::optional<std::uint64_t> crossing(const EstimatorInfo& info,
                                      std::span<const AccuracyPoint> points, double error) {
  // From the right: a line that dips below the error and rises again does not reach it there.
  std::size_t i = points.size();
  while (i > 0 && credible_error(points[i - 1]) <= error) --i;
  if (i == points.size()) return std::nullopt;
  if (i == 0) return points.front().samples;
  const double above = credible_error(points[i - 1]);
  const double below = credible_error(points[i]);
  if (!std::isfinite(above) || !(below > 0.0)) return points[i].samples;
  const double share = std::log(above / error) / std::log(above / below);
  const auto more = static_cast<double>(points[i].samples);
  const auto fewer = static_cast<double>(points[i - 1].samples);
  return in_steps(info, fewer * std::pow(more / fewer, share));
}

/// A candidate whose number of samples is looked for.
class SearchedCandidate {
 public:
  SearchedCandidate(Candidate candidate, const MethodDemand& demand)
      : candidate_(std::move(candidate)),
        demand_(&demand),
        next_(hoped_samples(candidate_, demand)),
        most_(candidate_.info->ignores_budget ? 1
                                              : std::max(candidate_.info->samples_per_estimate,
                                                         most_samples(candidate_, demand))) {
    next_ = std::min(next_, most_);
  }

  const Candidate& candidate() const { return candidate_; }
  std::string_view name() const { return candidate_.info->name; }
  /// The last one that was run.
  const AccuracyPoint& last() const { return points_.back(); }

  /// Numbers of samples that have not been run, up to `end`, and no more than take so long.
  std::vector<std::uint64_t> next(std::uint64_t end, double most_seconds) {
    std::vector<std::uint64_t> samples;
    while (!is_at_end() && next_ <= end && !is_slower_than(most_seconds)) {
      samples.push_back(next_);
      next_ = next_ == most_ ? most_ + 1 : std::min(most_, next_ * kSearchStep);
    }
    return samples;
  }
  bool is_at_end() const { return next_ > most_; }
  /// Whether what is to be run next takes longer.
  bool is_slower_than(double seconds) const {
    return candidate_.seconds(*demand_, next_) > seconds;
  }
  void add(const AccuracyLine& line) {
    points_.insert(points_.end(), line.points.begin(), line.points.end());
  }
  /// The candidate at a number of samples that seems to reach the error.
  std::optional<Candidate> found() const {
    const auto samples = crossing(*candidate_.info, points_, demand_->error);
    if (!samples || *samples > most_) return std::nullopt;
    Candidate made = candidate_;
    made.samples = *samples;
    return made;
  }

 private:
  Candidate candidate_;
  const MethodDemand* demand_;
  std::uint64_t next_;
  std::uint64_t most_;
  std::vector<AccuracyPoint> points_;
};

/// The search of all.
class Searching {
 public:
  Searching(const MethodDemand& demand, const std::vector<Candidate>& candidates)
      : demand_(&demand) {
    for (const Candidate& candidate : candidates) {
      if (is_uncertain(candidate, demand)) {
        open_.emplace_back(candidate, demand);
      } else {
        keep(candidate);
      }
    }
  }

  void run_up_to(std::uint64_t end, const RunEstimators& run) {
    SamplesOf samples;
    for (SearchedCandidate& one : open_) {
      const auto next = one.next(end, most_seconds());
      if (!next.empty()) samples[one.name()] = next;
    }
    if (samples.empty()) return;
    const MeasuredLines lines = run(samples, {kSearchRounds, fmt::format("search to {}", end)});
    std::erase_if(open_, [&](SearchedCandidate& one) {
      if (!samples.contains(one.name())) return false;
      one.add(lines.find(one.name())->second);
      const auto found = one.found();
      if (found) keep(*found);
      return found.has_value();
    });
  }

  Search finish() {
    for (const SearchedCandidate& one : open_) {
      if (one.is_at_end()) {
        search_.failed.emplace_back(one.candidate(),
                                    measured_obstacle(*demand_, one.candidate(), one.last()));
      } else {
        search_.too_slow.push_back(one.candidate());
      }
    }
    sort_by_time(search_.found, *demand_);
    return std::move(search_);
  }

 private:
  /// A choice and a rival are looked for.
  double most_seconds() const {
    return search_.found.size() < 2 ? std::numeric_limits<double>::infinity() : kTooSlow * best_;
  }
  void keep(const Candidate& candidate) {
    best_ = std::min(best_, candidate.seconds(*demand_, candidate.samples));
    search_.found.push_back(candidate);
  }

  const MethodDemand* demand_;
  std::vector<SearchedCandidate> open_;
  Search search_;
  double best_ = std::numeric_limits<double>::infinity();  ///< time of what was found
};

/// More samples for a candidate that missed the error; none if no number of them helps, or if that
/// is too many.
std::optional<Obstacle> correct(Candidate& candidate, const MethodDemand& demand,
                                const AccuracyPoint& point, int attempt) {
  const double ratio = credible_error(point) / demand.error;
  if (candidate.info->ignores_budget || attempt == kMostAttempts || !std::isfinite(ratio)) {
    return measured_obstacle(demand, candidate, point);
  }
  const double samples = static_cast<double>(candidate.samples) * ratio * ratio;
  candidate.samples = in_steps(*candidate.info, samples);
  return obstacle_to(demand, candidate, candidate.samples);
}

/// Fewer samples for what reached the error with more than it needs, where nothing says how the
/// error falls; 0 if there are none to try. `missed` are the most that are known not to do, or 0.
std::uint64_t fewer_samples(const Verified& reached, const MethodDemand& demand,
                            std::uint64_t missed) {
  const EstimatorInfo& info = *reached.candidate.info;
  const double ratio = credible_error(reached.point()) / demand.error;
  if (info.ignores_budget || !is_uncertain(reached.candidate, demand) || !(ratio < kGenerous)) {
    return 0;
  }
  const auto samples = static_cast<double>(reached.candidate.samples);
  const double fewer = missed > 0 ? std::sqrt(static_cast<double>(missed) * samples)
                                  : samples * std::pow(ratio, 1.0 / kSteepestSlope);
  // Nets are evenest at powers of two.
  const auto power =
      static_cast<double>(std::bit_floor(static_cast<std::uint64_t>(fewer / kPowerReach)));
  const bool is_near =
      power >= kPowerReach * fewer && power > static_cast<double>(missed) && power < samples;
  const std::uint64_t wanted = in_steps(info, is_near ? power : fewer);
  const bool is_worth_it = static_cast<double>(wanted) <= kWorthTrying * samples;
  return wanted > missed && is_worth_it ? wanted : 0;
}

/// A candidate on its way to the fewest samples that do.
class VerifiedCandidate {
 public:
  VerifiedCandidate(Candidate candidate, const MethodDemand& demand)
      : candidate_(std::move(candidate)), demand_(&demand) {}

  const Candidate& candidate() const { return candidate_; }

  /// What a run at candidate().samples says: whether another one is to follow.
  bool goes_on_after(AccuracyLine line, int attempt) {
    const AccuracyPoint& point = line.points.front();
    const double error = credible_error(point);
    // A smaller number of samples is chosen for its error: chance may have made that small.
    if (error <= (reached_ ? 1.0 : kMissed) * demand_->error) {
      reached_ = Verified{candidate_, std::move(line)};
    } else if (reached_) {
      missed_ = candidate_.samples;
    } else {
      missed_ = candidate_.samples;
      obstacle_ = correct(candidate_, *demand_, point, attempt);
      return !obstacle_;
    }
    if (attempt == kMostAttempts) return false;
    candidate_ = reached_->candidate;
    candidate_.samples = fewer_samples(*reached_, *demand_, missed_);
    return candidate_.samples > 0;
  }

  void put_into(Verification& all) && {
    if (reached_) {
      all.reaching.push_back(*std::move(reached_));
    } else {
      all.failed.emplace_back(std::move(candidate_), *std::move(obstacle_));
    }
  }

 private:
  Candidate candidate_;
  const MethodDemand* demand_;
  std::optional<Verified> reached_;
  std::optional<Obstacle> obstacle_;
  std::uint64_t missed_ = 0;  ///< the most samples that are known not to do
};

/// Runs a few candidates until each reaches the error or is out.
void verify_some(const RunEstimators& run, const MethodDemand& demand,
                 std::span<const Candidate> candidates, Verification& all) {
  std::vector<VerifiedCandidate> open;
  for (const Candidate& candidate : candidates) open.emplace_back(candidate, demand);
  for (int attempt = 1; !open.empty(); ++attempt) {
    SamplesOf samples;
    for (const VerifiedCandidate& one : open) {
      samples[one.candidate().info->name] = {one.candidate().samples};
    }
    MeasuredLines lines = run(samples, {kFinalRounds, fmt::format("verification {}", attempt)});
    std::erase_if(open, [&](VerifiedCandidate& one) {
      AccuracyLine& line = lines.find(one.candidate().info->name)->second;
      if (one.goes_on_after(std::move(line), attempt)) return false;
      std::move(one).put_into(all);
      return true;
    });
  }
}

}  // namespace

RunEstimators run_on(const LitReceiver& lit, std::uint64_t seed) {
  return [&lit, seed](const SamplesOf& samples, const RunKind& kind) {
    const AccuracyOptions how = {
        .quality = {"", kMostDirections, kind.rounds, kReceiverPoints},
        .seed = seed,
        .purpose = kind.purpose,
        .select = [&](const EstimatorInfo& info) { return samples.contains(info.name); },
        .samples = [&](const EstimatorInfo& info) { return samples.at(info.name); },
        .samples_of_a_round = kSamplesOfARound,
        .most_estimates_of_a_round = kMostEstimatesOfARound};
    MeasuredLines lines;
    for (AccuracyLine& line : measure_accuracy(lit, how).lines) {
      std::string name = line.estimator;
      lines.emplace(std::move(name), std::move(line));
    }
    return lines;
  };
}

double credible_error(const AccuracyPoint& point) {
  const bool agrees = std::abs(point.rmse - point.predicted) <= kAgreement * point.rmse_error;
  if (agrees) return point.predicted;
  if (is_measured(point)) return point.rmse;
  return std::isfinite(point.predicted) ? point.predicted : std::numeric_limits<double>::infinity();
}

Search search_samples(const RunEstimators& run, const MethodDemand& demand,
                      const std::vector<Candidate>& candidates) {
  Searching searching(demand, candidates);
  for (const std::uint64_t end : kSearchStages) searching.run_up_to(end, run);
  return searching.finish();
}

Verification verify(const RunEstimators& run, const MethodDemand& demand,
                    const std::vector<Candidate>& candidates) {
  Verification all;
  std::span<const Candidate> left(candidates);
  const auto is_done = [&] {
    return left.empty() ||
           (all.reaching.size() >= 2 && all.reaching.front().seconds(demand) <=
                                            left.front().seconds(demand, left.front().samples));
  };
  while (!is_done()) {
    const auto some = left.first(std::min(kVerifiedAtATime, left.size()));
    left = left.subspan(some.size());
    verify_some(run, demand, some, all);
    std::ranges::stable_sort(all.reaching, {},
                             [&](const Verified& one) { return one.seconds(demand); });
  }
  all.too_slow.assign(left.begin(), left.end());
  return all;
}

}  // namespace lightproof
