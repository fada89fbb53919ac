#include "lightproof/recommend/candidates.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "lightproof/accuracy/measurement.h"
#include "lightproof/estimators/registry.h"
#include "lightproof/results/percent.h"

namespace lightproof {
namespace {

/// What nothing can mend is further away than any number.
constexpr double kOutOfReach = 1e30;

/// The slope of error against samples that points in even order may have at best, where only an
/// upper bound is predicted; and how many times fewer samples occlusion may need.
constexpr double kBestSlope = 0.85;
constexpr double kOcclusionGain = 4.0;

/// What the error of any number of samples stays above, by the prediction.
double floor_of(const PredictedError& error) {
  return error.model == ErrorModel::constant ? error.at(1) : error.bias;
}

std::optional<Obstacle> too_many_samples(const EstimatorInfo& info, std::uint64_t samples) {
  const std::uint64_t most = kMostDirections / info.candidates;
  if (samples <= most) return std::nullopt;
  const auto needed = static_cast<double>(samples);
  return Obstacle{needed / static_cast<double>(most),
                  fmt::format("{} needs {:.2g} samples, of {} at most", info.name, needed, most)};
}

std::optional<Obstacle> too_much_time(const MethodDemand& demand, const Candidate& candidate,
                                      std::uint64_t samples) {
  const double seconds = candidate.seconds(demand, samples);
  if (seconds <= demand.budget_seconds) return std::nullopt;
  return Obstacle{seconds / demand.budget_seconds,
                  fmt::format("{} takes {:.2g} ms a shading point, of {:.2g} ms allowed",
                              candidate.info->name, 1e3 * seconds, 1e3 * demand.budget_seconds)};
}

std::optional<Obstacle> too_much_memory(const MethodDemand& demand, const Candidate& candidate) {
  const auto memory = static_cast<double>(demand.memory.value_or(0));
  if (!demand.memory || candidate.cost.bytes <= memory) return std::nullopt;
  return Obstacle{candidate.cost.bytes / std::max(1.0, memory),
                  fmt::format("{} takes {:.2g} MB, of {:.2g} MB allowed", candidate.info->name,
                              1e-6 * candidate.cost.bytes, 1e-6 * memory)};
}

/// What stops a candidate, whatever its number of samples; none if nothing does.
std::optional<Obstacle> obstacle_of_method(const MethodDemand& demand, const Candidate& candidate,
                                           std::string_view left_out) {
  const EstimatorInfo& info = *candidate.info;
  if (!left_out.empty()) return Obstacle{kOutOfReach, fmt::format("{}: {}", info.name, left_out)};
  if (info.ignores_occlusion && demand.is_occluded) {
    return Obstacle{kOutOfReach, fmt::format("{} ignores what is in the way of light", info.name)};
  }
  return std::nullopt;
}

/// The fewest samples that may turn out to do; 0 if none may.
std::uint64_t fewest_possible(const Candidate& candidate, const MethodDemand& demand) {
  if (!demand.will_be_tried || !is_uncertain(candidate, demand)) return candidate.samples;
  if (!candidate.error || demand.is_occluded) return candidate.info->samples_per_estimate;
  if (candidate.error->model == ErrorModel::constant) {
    return candidate.error->bias <= demand.error ? 1 : 0;
  }
  return hoped_samples(candidate, demand);
}

/// Why it is no candidate; nothing if it is one.
std::optional<Obstacle> obstacle_to_trying(const MethodDemand& demand, const Candidate& candidate,
                                           const EstimatorPrediction& row,
                                           std::string_view left_out) {
  if (auto obstacle = obstacle_of_method(demand, candidate, left_out)) return obstacle;
  if (!candidate.error && !demand.will_be_tried) {
    return Obstacle{kOutOfReach, fmt::format("{} is not predicted: {}", row.estimator, row.reason)};
  }
  return obstacle_to(demand, candidate, fewest_possible(candidate, demand));
}

}  // namespace

void FamilyObstacles::add(EstimatorFamily family, Obstacle obstacle) {
  Obstacle& nearest = nearest_[family];
  if (nearest.reason.empty() || obstacle.distance < nearest.distance) {
    nearest = std::move(obstacle);
  }
}

std::vector<UnreachedFamily> FamilyObstacles::list(
    const std::vector<EstimatorFamily>& reached) const {
  std::vector<UnreachedFamily> list;
  for (const auto& [family, obstacle] : nearest_) {
    if (std::ranges::find(reached, family) != reached.end()) continue;
    list.push_back({family, obstacle.reason});
  }
  return list;
}

bool is_uncertain(const Candidate& candidate, const MethodDemand& demand) {
  if (!candidate.error || demand.is_occluded) return true;
  const PredictedError& error = *candidate.error;
  return error.model == ErrorModel::at_most ||
         (error.model == ErrorModel::constant && error.variance > 0.0);
}

std::uint64_t in_steps(const EstimatorInfo& info, double samples) {
  const auto step = static_cast<double>(info.samples_per_estimate);
  return static_cast<std::uint64_t>(step * std::max(1.0, std::ceil(samples / step - 1e-9)));
}

std::uint64_t hoped_samples(const Candidate& candidate, const MethodDemand& demand) {
  const EstimatorInfo& info = *candidate.info;
  if (!demand.will_be_tried || !is_uncertain(candidate, demand)) return candidate.samples;
  if (candidate.samples == 0) return info.samples_per_estimate;
  auto samples = static_cast<double>(candidate.samples);
  if (candidate.error->model == ErrorModel::at_most) samples = std::pow(samples, 0.5 / kBestSlope);
  if (demand.is_occluded) samples /= kOcclusionGain;
  return in_steps(info, samples);
}

double hoped_seconds(const Candidate& candidate, const MethodDemand& demand) {
  return candidate.seconds(demand, hoped_samples(candidate, demand));
}

std::uint64_t most_samples(const Candidate& candidate, const MethodDemand& demand) {
  const std::uint64_t step = candidate.info->samples_per_estimate;
  std::uint64_t low = 0;  // in estimates
  std::uint64_t high = kMostDirections / candidate.info->candidates / step;
  while (low < high) {
    const std::uint64_t middle = high - (high - low) / 2;
    if (candidate.seconds(demand, middle * step) <= demand.budget_seconds) {
      low = middle;
    } else {
      high = middle - 1;
    }
  }
  return low * step;
}

std::optional<Obstacle> obstacle_to(const MethodDemand& demand, const Candidate& candidate,
                                    std::uint64_t samples) {
  const EstimatorInfo& info = *candidate.info;
  if (samples == 0) {
    const double floor = floor_of(candidate.error.value());
    return Obstacle{floor / demand.error,
                    fmt::format("the floor of {} is {}, above {}", info.name, plain_percent(floor),
                                plain_percent(demand.error))};
  }
  if (auto obstacle = too_many_samples(info, samples)) return obstacle;
  if (auto obstacle = too_much_time(demand, candidate, samples)) return obstacle;
  return too_much_memory(demand, candidate);
}

std::optional<std::uint64_t> samples_for(const EstimatorInfo& info, const PredictedError& predicted,
                                         double error) {
  if (predicted.model == ErrorModel::constant) {
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
  for (const EstimatorPrediction& row : prediction.estimators) {
    const EstimatorInfo& info = estimator_by_name(row.estimator);
    auto cost = costs.of(row.estimator, map);
    if (!cost) continue;
    Candidate candidate{&info, row.error, *std::move(cost), 0};
    if (row.error) candidate.samples = samples_for(info, *row.error, demand.error).value_or(0);
    if (!row.error) all.unpredicted.push_back({std::string(row.estimator), row.reason});
    if (auto obstacle =
            obstacle_to_trying(demand, candidate, row, reason_to_leave_out(info, map))) {
      all.obstacles.add(info.family, *std::move(obstacle));
    } else {
      all.possible.push_back(std::move(candidate));
    }
  }
  std::ranges::stable_sort(all.possible, {}, [&](const Candidate& candidate) {
    return hoped_seconds(candidate, demand);
  });
  return all;
}

}  // namespace lightproof
