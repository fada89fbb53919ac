#include "lightproof/accuracy/method_costs.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "lightproof/accuracy/lit_receiver.h"
#include "lightproof/accuracy/timing.h"
#include "lightproof/core/parallel.h"
#include "lightproof/core/random.h"
#include "lightproof/estimators/registry.h"
#include "lightproof/estimators/specular_tables.h"
#include "lightproof/image/synthetic.h"

namespace lightproof {
namespace {

constexpr Extent kSmall = {256, 128};
constexpr Extent kLarge = {1024, 512};
constexpr std::array<std::uint64_t, 7> kSamples = {1, 4, 16, 64, 256, 1024, 4096};
constexpr int kPoints = 24;
/// Each time is the least of so many rounds; a set-up is repeated while it takes less than this.
constexpr int kRounds = 3;
constexpr double kShortSetUp = 0.05;
/// A round goes on until it has taken so long, for a time that is several ticks of the clock.
constexpr double kRoundSeconds = 2e-4;

struct Runner {
  MethodCost cost;
  PreparedEstimator prepared;
  BoundEstimator bound;
};

Runner set_up(const EstimatorInfo& info, const EnvironmentMap& map, const Scene& scene,
              const Material& material) {
  Runner runner;
  runner.cost.estimator = info.name;
  runner.cost.set_up_seconds = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kRounds; ++i) {
    auto prepared = timed([&] { return info.prepare(map); });
    auto bound = timed([&] { return prepared.made.bind(scene, material); });
    runner.prepared = std::move(prepared.made);
    runner.bound = std::move(bound.made);
    const double seconds = prepared.processor_seconds + bound.processor_seconds;
    runner.cost.set_up_seconds = std::min(runner.cost.set_up_seconds, seconds);
    if (seconds > kShortSetUp) break;
  }
  runner.cost.bytes = static_cast<double>(runner.prepared.bytes + runner.bound.bytes);
  return runner;
}

double seconds_of(const BoundEstimator& estimator, const std::vector<Pixel>& points,
                  std::uint64_t samples) {
  const RandomStream stream("method-costs", samples);
  double least = std::numeric_limits<double>::infinity();
  for (int round = 0; round < kRounds; ++round) {
    const double begin = thread_seconds();
    double spent = 0.0;
    std::uint64_t estimates = 0;
    do {
      for (const Pixel& pixel : points) {
        const std::uint64_t first = estimates++ * samples;
        estimator.integrate(pixel.point, stream, {first, samples}, {});
      }
      spent = thread_seconds() - begin;
    } while (spent < kRoundSeconds);
    least = std::min(least, spent / static_cast<double>(estimates));
  }
  return least;
}

void run(Runner& runner, const EstimatorInfo& info, const std::vector<Pixel>& points) {
  for (const std::uint64_t samples : kSamples) {
    // A table for each point takes the time, whatever the number of samples.
    const bool is_needed =
        samples == kSamples.front() ||
        (!info.ignores_budget && (!info.tabulates_each_point || samples == kSamples.back()));
    if (!is_needed || samples < info.samples_per_estimate ||
        samples * info.candidates > kSamples.back()) {
      continue;
    }
    runner.cost.samples.push_back(samples);
    runner.cost.seconds.push_back(seconds_of(runner.bound, points, samples));
  }
}

std::vector<MethodCost> costs_on(Extent extent, const Material& material,
                                 const ReceiverInfo& receiver, const Progress& progress) {
  const EnvironmentMap map = make_synthetic_map("sun-sky", extent);
  const Scene scene(receiver.content);
  const std::vector<Pixel> points = receiver_points(receiver, scene, kPoints);
  std::vector<const EstimatorInfo*> rows;
  std::vector<Runner> runners;
  for (const EstimatorInfo& info : estimators()) {
    if (!info.serves(material)) continue;
    rows.push_back(&info);
    runners.push_back(set_up(info, map, scene, material));
  }
  if (progress) progress("costs of estimators", 0.5);
  parallel_for(runners.size(), [&](std::size_t i) { run(runners[i], *rows[i], points); });
  std::vector<MethodCost> costs;
  for (Runner& runner : runners) costs.push_back(std::move(runner.cost));
  return costs;
}

/// The value at x of the power law through two points.
double power_law_at(double x, double x0, double y0, double x1, double y1) {
  if (!(y0 > 0.0 && y1 > 0.0)) return std::max(y0, y1);
  return y0 * std::pow(y1 / y0, std::log(x / x0) / std::log(x1 / x0));
}

}  // namespace

double MethodCost::seconds_of(std::uint64_t wanted) const {
  const auto n = static_cast<double>(wanted);
  if (samples.size() == 1) return seconds.front();
  if (wanted >= samples.back()) return seconds.back() * n / static_cast<double>(samples.back());
  const auto above = std::upper_bound(samples.begin() + 1, samples.end() - 1, wanted);
  const auto i = static_cast<std::size_t>(above - samples.begin());
  return power_law_at(n, static_cast<double>(samples[i - 1]), seconds[i - 1],
                      static_cast<double>(samples[i]), seconds[i]);
}

std::optional<MethodCost> MethodCosts::of(std::string_view estimator, Extent extent) const {
  const auto find = [&](const std::vector<MethodCost>& costs) {
    return std::find_if(costs.begin(), costs.end(),
                        [&](const MethodCost& cost) { return cost.estimator == estimator; });
  };
  const auto at_small = find(small);
  const auto at_large = find(large);
  if (at_small == small.end() || at_large == large.end()) return std::nullopt;
  const auto at = [&](double y0, double y1) {
    return power_law_at(static_cast<double>(extent.count()), static_cast<double>(kSmall.count()),
                        y0, static_cast<double>(kLarge.count()), y1);
  };
  MethodCost cost = *at_large;
  cost.set_up_seconds = at(at_small->set_up_seconds, at_large->set_up_seconds);
  cost.bytes = at(at_small->bytes, at_large->bytes);
  for (std::size_t i = 0; i < cost.seconds.size(); ++i) {
    cost.seconds[i] = at(at_small->seconds[i], at_large->seconds[i]);
  }
  return cost;
}

std::string material_of_costs(const Material& material) {
  constexpr std::array<std::string_view, std::variant_size_v<Material>> kKinds = {
      "lambert", "phong", "ggx", "blinn"};
  const std::string kind(kKinds[material.index()]);
  const auto* phong = std::get_if<ModifiedPhong>(&material);
  if (phong == nullptr) return kind;
  return fmt::format("{}, prefiltered to {} rows, exponents from 1e{:.0f}", kind,
                     prefilter_extent(prefilter_lobe(*phong)).height,
                     std::floor(std::log10(phong->exponent)));
}

MethodCosts measure_method_costs(const Material& material, const ReceiverInfo& receiver,
                                 const Progress& progress) {
  return {costs_on(kSmall, material, receiver, part_of(progress, 0.0, 0.4)),
          costs_on(kLarge, material, receiver, part_of(progress, 0.4, 1.0))};
}

KeptMeasurement<MethodCosts> kept_method_costs(const Material& material,
                                               const ReceiverInfo& receiver,
                                               const MeasurementCache& cache,
                                               const Progress& progress) {
  const std::string dependence = fmt::format("{}/{}", material_of_costs(material), receiver.name);
  return MeasurementKeeper(cache).get<MethodCosts>("method-costs", dependence, [&] {
    return measure_method_costs(material, receiver, progress);
  });
}

}  // namespace lightproof
