#include "lightproof/check/texel_locator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "lightproof/check/compared_samples.h"
#include "lightproof/samplers/texel_positions.h"

namespace lightproof {
namespace {

/// Closer to a pole than this, in radians, positions have fewer digits.
constexpr double kAtPole = 1e-3;

/// A coordinate as samplers place it: away from the edges of its cell.
double away_from_edges(double coordinate, int cell, int count) {
  return position_in_cell(cell, coordinate * count - cell, count);
}

bool is_near_edge(double coordinate, double reach, int count) {
  const double at = coordinate * count;
  return !(std::abs(at - std::round(at)) > reach * count);
}

}  // namespace

TexelLocator::TexelLocator(Mapping mapping, Extent extent, double rounding,
                           DeclaredDensity declared)
    : mapping_(mapping), extent_(extent), rounding_(rounding), declared_(std::move(declared)) {}

TexelSample TexelLocator::operator()(const DumpedSample& sample) const {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  if (!std::isfinite(sample.direction.x)) return {{kNaN, kNaN}, -1, -1, {kNaN}};
  TexelSample best = placed(sample.direction, sample.pdf);
  if (!is_near_edges(best.at)) return best;
  double least = misfit(best);
  visit_around(sample.direction, rounding_, [&](Direction turned) {
    const TexelSample candidate = placed(turned, sample.pdf);
    if (candidate.x == best.x && candidate.y == best.y) return;
    const double its = misfit(candidate);
    if (its < least) {
      least = its;
      best = candidate;
    }
  });
  return best;
}

void TexelLocator::operator()(std::span<const DumpedSample> samples,
                              std::span<TexelSample> placed_samples,
                              LatLongPositions& positions) const {
  if (mapping_.kind != MappingKind::lat_long) {
    std::ranges::transform(samples, placed_samples.begin(),
                           [this](const DumpedSample& sample) { return (*this)(sample); });
    return;
  }
  positions.find(samples);
  const double shift = mapping_.shift;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    double s = positions.s(i) - shift;
    s -= std::floor(s);
    const double t = positions.t(i);
    const double sine = positions.sine(i);
    const bool is_plain_case = sine > kAtPole &&
                               !is_near_edge(s, rounding_ * 0.5 / (kPi * sine), extent_.width) &&
                               !is_near_edge(t, rounding_ / kPi, extent_.height);  // false for NaN
    if (!is_plain_case) {
      placed_samples[i] = (*this)(samples[i]);
      continue;
    }
    const int x = cell_of(s, extent_.width);
    const int y = cell_of(t, extent_.height);
    placed_samples[i] = {
        {away_from_edges(s, x, extent_.width), away_from_edges(t, y, extent_.height)},
        x,
        y,
        {samples[i].pdf.value * 2.0 * kPi * kPi * sine}};
  }
}

TexelSample TexelLocator::placed(Direction d, PerSteradian pdf) const {
  const SquarePoint of_direction = square_point_of(mapping_, d);
  const int x = cell_of(of_direction.s, extent_.width);
  const int y = cell_of(of_direction.t, extent_.height);
  const SquarePoint at = {away_from_edges(of_direction.s, x, extent_.width),
                          away_from_edges(of_direction.t, y, extent_.height)};
  return {at, x, y, {pdf.value * solid_angle_per_square(mapping_, at)}};
}

bool TexelLocator::is_near_edges(SquarePoint at) const {
  const TurnEffect turn = effect_of_turn(mapping_, at);
  return is_near_edge(at.s, rounding_ * turn.s, extent_.width) ||
         is_near_edge(at.t, rounding_ * turn.t, extent_.height);
}

double TexelLocator::misfit(const TexelSample& sample) const {
  const double declared = declared_(sample.at, sample.x, sample.y);
  if (!(declared > 0.0)) return std::numeric_limits<double>::infinity();
  return std::isnan(sample.pdf.value) ? 1.0 / declared
                                      : std::abs(std::log(sample.pdf.value / declared));
}

}  // namespace lightproof
