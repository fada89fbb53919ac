#include "lightproof/study/point_study.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "lightproof/core/random.h"
#include "lightproof/points/discrepancy.h"
#include "lightproof/points/float_decay.h"
#include "lightproof/points/registry.h"
#include "lightproof/stats/power_law.h"

namespace lightproof {
namespace {

std::string_view name_of(Roughness roughness) {
  switch (roughness) {
    case Roughness::smooth:
      return "smooth";
    case Roughness::kink:
      return "kink";
    case Roughness::edge:
      return "edge";
  }
  return "";
}

/// The power law through the errors.
void fit(PointRate& rate) {
  rate.exponent = rate.exponent_error = std::numeric_limits<double>::quiet_NaN();
  std::vector<PowerLawPoint> points;
  for (const PointError& error : rate.errors) {
    if (!(error.rmse > 0.0 && error.rmse_error > 0.0)) continue;
    points.push_back(
        {static_cast<double>(error.points), error.rmse, error.rmse_error / error.rmse});
  }
  if (points.size() < 3) return;
  const PowerLaw fitted = fit_power_law(points);
  rate.exponent = fitted.exponent;
  rate.exponent_error = exponent_error_with_scatter(fitted, points);
}

PointRate rate_of(const PointSetInfo& set, const Integrand& integrand,
                  const IntegrationOptions& options) {
  PointRate rate{std::string(set.name),
                 std::string(to_string(set.kind)),
                 std::string(integrand.name),
                 std::string(name_of(integrand.roughness)),
                 options.seeds,
                 {}};
  for (const IntegrationError& error : integration_errors(set, integrand, options)) {
    rate.errors.push_back({error.points, error.rmse, error.rmse_error, error.independent});
  }
  fit(rate);
  return rate;
}

PointDiscrepancy discrepancy_of(const PointSetInfo& set, std::uint64_t count) {
  std::vector<SquarePoint> points(static_cast<std::size_t>(count));
  fill_points(set.prepare(count), 0, points);
  return {std::string(set.name),
          std::string(to_string(set.kind)),
          count,
          star_discrepancy(points),
          l2_star_discrepancy(points),
          std::sqrt(5.0 / (36.0 * static_cast<double>(count)))};
}

PointDecay decay_of(const PointSetInfo& set, std::uint64_t first, std::uint64_t window) {
  const FloatDecay found = float_decay_at(set, first, window);
  return {std::string(set.name), found.first,      found.window,  found.distinct,
          found.distinct_s,      found.distinct_t, found.error_s, found.error_t};
}

std::vector<std::uint64_t> decay_firsts(const PointStudyOptions& options) {
  std::vector<std::uint64_t> firsts = {0};
  for (std::uint64_t first = std::uint64_t{1} << static_cast<unsigned>(options.first_decay_power);
       first + options.decay_window <= kMostPoints; first *= 2) {
    firsts.push_back(first);
  }
  return firsts;
}

/// Cells of one kind of work, and their results in the order in which they were added.
template <class Result>
class Work {
 public:
  void add(std::string key, std::function<Result()> compute) {
    cells_.push_back({std::move(key), std::move(compute)});
  }

  std::vector<Result> results(const Progress& progress, const Communicator& communicator) const {
    CellResults<Result> all = gather(
        compute_cells<Result>(cells_, communicator.share, progress, "point sets"), communicator);
    std::vector<Result> ordered;
    for (const WorkCell<Result>& cell : cells_) ordered.push_back(std::move(all.at(cell.key)));
    return ordered;
  }

 private:
  std::vector<WorkCell<Result>> cells_;
};

}  // namespace

PointStudy study_points(const PointStudyOptions& options, const Progress& progress,
                        const Communicator& communicator) {
  Work<PointRate> rates;
  Work<PointDiscrepancy> discrepancies;
  Work<PointDecay> decay;
  for (const PointSetInfo& set : point_sets()) {
    for (const Integrand& integrand : integrands()) {
      rates.add(fmt::format("points/rate/{}/{}", set.name, integrand.name),
                [&] { return rate_of(set, integrand, options.errors); });
    }
    for (const std::uint64_t count : options.discrepancy_counts) {
      discrepancies.add(fmt::format("points/discrepancy/{}/{}", set.name, count),
                        [&set, count] { return discrepancy_of(set, count); });
    }
    if (!set.is_float) continue;
    for (const std::uint64_t first : decay_firsts(options)) {
      decay.add(fmt::format("points/decay/{}/{}", set.name, first),
                [&, first] { return decay_of(set, first, options.decay_window); });
    }
  }
  return {rates.results(part_of(progress, 0.0, 0.5), communicator),
          discrepancies.results(part_of(progress, 0.5, 0.6), communicator),
          decay.results(part_of(progress, 0.6, 1.0), communicator)};
}

PointStudy kept_points(std::uint64_t seed, const MeasurementCache& cache,
                       const Progress& progress) {
  PointStudyOptions options;
  options.errors.seed = seed;
  return MeasurementKeeper(cache)
      .get<PointStudy>("points", std::to_string(seed),
                       [&] { return study_points(options, progress); })
      .value;
}

}  // namespace lightproof
