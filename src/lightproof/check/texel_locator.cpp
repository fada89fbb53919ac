#include "lightproof/check/texel_locator.h"

#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "lightproof/samplers/texel_positions.h"

namespace lightproof {
namespace {

/// Directions around one, on a circle: an edge within the rounding of a direction lies between it
/// and one of as many on a circle that is so much larger.
constexpr int kAround = 8;
const double kBeyond = 1.0 / std::cos(kPi / kAround);

/// Two unit vectors that are perpendicular to a unit vector and to each other.
std::array<Direction, 2> across(Direction d) {
  const Direction other = std::abs(d.z) < 0.5 ? Direction(0.0, 0.0, 1.0) : Direction(1.0, 0.0, 0.0);
  const Direction first = glm::normalize(glm::cross(d, other));
  return {first, glm::cross(d, first)};
}

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
  const auto [first, second] = across(sample.direction);
  for (int k = 0; k < kAround; ++k) {
    const double angle = 2.0 * kPi * k / kAround;
    const Direction turned =
        glm::normalize(sample.direction +
                       rounding_ * kBeyond * (std::cos(angle) * first + std::sin(angle) * second));
    const TexelSample candidate = placed(turned, sample.pdf);
    if (candidate.x == best.x && candidate.y == best.y) continue;
    const double its = misfit(candidate);
    if (its < least) {
      least = its;
      best = candidate;
    }
  }
  return best;
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
