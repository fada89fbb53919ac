#include "lightproof/points/integration_error.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <string>

#include "lightproof/core/moments.h"
#include "lightproof/core/parallel.h"
#include "lightproof/core/random.h"

namespace lightproof {
namespace {

double mean_over(const AnyPointSet& set, const Integrand& integrand, std::uint64_t count) {
  constexpr std::uint64_t kBlock = 256;
  std::array<SquarePoint, kBlock> points;
  double sum = 0.0;
  for (std::uint64_t first = 0; first < count; first += kBlock) {
    const std::span<SquarePoint> block =
        std::span(points).first(static_cast<std::size_t>(std::min(kBlock, count - first)));
    fill_points(set, first, block);
    double of_block = 0.0;
    for (const SquarePoint point : block) of_block += integrand.at(point);
    sum += of_block;
  }
  return sum / static_cast<double>(count);
}

IntegrationError error_at(const PointSetInfo& set, const Integrand& integrand, std::uint64_t count,
                          const IntegrationOptions& options) {
  // Every count has seeds of its own: the points of a convergence line are independent.
  const RandomStream seeds("integration error/" + std::string(set.name), options.seed, count);
  std::vector<double> squares(static_cast<std::size_t>(options.seeds));
  parallel_for(squares.size(), [&](std::size_t i) {
    const double mean = mean_over(set.prepare(count, seed_from(seeds, i)), integrand, count);
    const double error = mean / integrand.mean - 1.0;
    squares[i] = error * error;
  });
  Moments moments;
  for (const double square : squares) moments.add(square);
  const double rmse = std::sqrt(moments.mean());
  return {set.name,
          integrand.name,
          count,
          options.seeds,
          rmse,
          rmse > 0.0 ? 0.5 * moments.standard_error() / rmse : 0.0,
          std::sqrt(integrand.variance / static_cast<double>(count)) / integrand.mean};
}

}  // namespace

std::vector<IntegrationError> integration_errors(const PointSetInfo& set,
                                                 const Integrand& integrand,
                                                 const IntegrationOptions& options) {
  assert(options.seeds >= 2);
  std::vector<IntegrationError> errors;
  for (const std::uint64_t count : options.counts) {
    errors.push_back(error_at(set, integrand, count, options));
  }
  return errors;
}

}  // namespace lightproof
