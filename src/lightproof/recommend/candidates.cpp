#include "lightproof/recommend/candidates.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "lightproof/estimators/registry.h"

namespace lightproof {
namespace {

/// What keeps an estimator from reaching the error; the nearest miss of a family is told.
struct Obstacle {
  double distance = std::numeric_limits<double>::infinity();  ///< how many times too much
  std::string reason;
};

/// Two digits: "3.1 %".
std::string percent(double share) { return fmt::format("{:.2g} %", 100.0 * share); }

/// The slope of error against samples that points in even order may have at best, where only an
/// upper bound is predicted; and how many times fewer samples occlusion may need.
constexpr double kBestSlope = 0.85;
constexpr double kOcclusionGain = 4.0;

/// Why the estimator cannot be taken; nothing if it can.
std::optional<Obstacle> obstacle_of(const MethodDemand& demand, const Candidate& candidate,
                                    std::uint64_t samples) {
  const EstimatorInfo& info = *candidate.info;
  if (info.ignores_occlusion && demand.is_occluded) {
    return Obstacle{1e30, fmt::format("{} ignores what is in the way of light", info.name)};
  }
  if (samples == 0) {
    const double floor =
        candidate.error.law == ErrorLaw::constant ? candidate.error.at(1) : candidate.error.bias;
    return Obstacle{floor / demand.error,
                    fmt::format("the floor of {} is {}", info.name, percent(floor))};
  }
  const std::uint64_t most_samples = kMostDirections / info.candidates;
  const auto most = static_cast<double>(most_samples);
  if (static_cast<double>(samples) > most) {
    return Obstacle{
        static_cast<double>(samples) / most,
        fmt::format("{} needs {:.2g} samples", info.name, static_cast<double>(samples))};
  }
  const double seconds = candidate.seconds(demand, samples);
  if (seconds > demand.budget_seconds) {
    return Obstacle{seconds / demand.budget_seconds,
                    fmt::format("{} takes {:.2g} ms a shading point", info.name, 1e3 * seconds)};
  }
  const auto memory = static_cast<double>(demand.memory.value_or(0));
  if (demand.memory && candidate.cost.bytes > memory) {
    return Obstacle{candidate.cost.bytes / std::max(1.0, memory),
                    fmt::format("{} takes {:.2g} MB", info.name, 1e-6 * candidate.cost.bytes)};
  }
  return std::nullopt;
}

}  // namespace

bool is_uncertain(const PredictedError& error, const MethodDemand& demand) {
  return error.law == ErrorLaw::at_most ||
         (error.law == ErrorLaw::independent && demand.is_occluded);
}

std::uint64_t in_steps(const EstimatorInfo& info, double samples) {
  const double step = static_cast<double>(info.samples_per_estimate);
  return static_cast<std::uint64_t>(step * std::max(1.0, std::ceil(samples / step - 1e-9)));
}

std::uint64_t fewest_samples(const Candidate& candidate, const MethodDemand& demand) {
  if (candidate.samples == 0 || !demand.will_be_tried || !is_uncertain(candidate.error, demand)) {
    return candidate.samples;
  }
  double fewest = static_cast<double>(candidate.samples);
  if (candidate.error.law == ErrorLaw::at_most) fewest = std::pow(fewest, 0.5 / kBestSlope);
  if (demand.is_occluded) fewest /= kOcclusionGain;
  return in_steps(*candidate.info, fewest);
}

std::string obstacle_to(const MethodDemand& demand, const Candidate& candidate,
                        std::uint64_t samples) {
  const auto obstacle = obstacle_of(demand, candidate, samples);
  return obstacle ? obstacle->reason : "";
}

std::optional<std::uint64_t> samples_for(const EstimatorInfo& info, const PredictedError& predicted,
                                         double error) {
  if (predicted.law == ErrorLaw::constant) {
    if (predicted.at(1) > error) return std::nullopt;
    return 1;
  }
  const double left = error * error - predicted.bias * predicted.bias;
  if (!(left > 0.0)) return std::nullopt;
  constexpr double kMost = 1e15;
  // What a sample adds may fall with their number, so that fewer do than the variance of one says.
  double samples = std::min(kMost, predicted.variance / left);
  for (double less = samples;; samples = less) {
    const auto rounded = static_cast<std::uint64_t>(std::max(1.0, std::ceil(less)));
    less = std::min(kMost, predicted.variance_of(rounded) / left);
    if (less >= 0.99 * samples) break;
  }
  return in_steps(info, samples * (1.0 - 1e-12));
}

Candidates candidates_for(const MethodDemand& demand, const Prediction& prediction,
                          const MethodCosts& costs, Extent map) {
  Candidates all;
  std::map<EstimatorFamily, Obstacle> obstacles;
  std::vector<EstimatorFamily> reached;
  for (const EstimatorPrediction& row : prediction.estimators) {
    const EstimatorInfo& info = estimator_by_name(row.estimator);
    auto cost = costs.of(row.estimator, map);
    if (!row.error || !cost) continue;
    Candidate candidate{&info, *row.error, *std::move(cost),
                        samples_for(info, *row.error, demand.error).value_or(0)};
    if (auto obstacle = obstacle_of(demand, candidate, fewest_samples(candidate, demand))) {
      Obstacle& nearest = obstacles[info.family];
      if (obstacle->distance < nearest.distance) nearest = *std::move(obstacle);
      continue;
    }
    reached.push_back(info.family);
    all.reaching.push_back(std::move(candidate));
  }
  std::ranges::stable_sort(all.reaching, {}, [&](const Candidate& candidate) {
    return candidate.seconds(demand, candidate.samples);
  });
  for (const auto& [family, obstacle] : obstacles) {
    if (std::ranges::find(reached, family) != reached.end()) continue;
    all.unreached.push_back({std::string(to_string(family)), obstacle.reason});
  }
  return all;
}

}  // namespace lightproof
