#include "lightproof/prefilter/lobe_samples.h"

#include <algorithm>
#include <cmath>

#include "lightproof/points/hammersley.h"
#include "lightproof/warp/hemisphere.h"

namespace lightproof {
namespace {

/// Mirrors +z in the half-vector with this cosine: the light stands at twice the angle.
Direction mirrored(double half_cosine, double turn) {
  return direction_around_z(2.0 * half_cosine * half_cosine - 1.0, turn);
}

/// A direction and the density that it was drawn with.
struct Drawn {
  Direction local;
  double pdf;
};

Drawn draw_half_vector(const PhongLobe& lobe, SquarePoint u) {
  const Direction local = phong_lobe_from_square(u, lobe.exponent);
  return {local, phong_lobe_pdf(local.z, lobe.exponent).value};
}

/// The density of the light is D cos(theta) over the Jacobian 4 cos(theta): D/4.
Drawn draw_half_vector(const GgxLobe& lobe, SquarePoint u) {
  const double half = ggx_half_vector_cosine(lobe.alpha, u.t);
  const double square = lobe.alpha * lobe.alpha;
  const double tilt = (square - 1.0) * half * half + 1.0;
  return {mirrored(half, u.s), square / (4.0 * kPi * tilt * tilt)};
}

Drawn draw_half_vector(const HalfVectorLobe& lobe, SquarePoint u) {
  const double half = half_vector_cosine(lobe.shininess, 1.0 - u.t);
  const double pdf = (lobe.shininess + 1.0) / (2.0 * kPi) * std::pow(half, lobe.shininess);
  return {mirrored(half, u.s), pdf / (4.0 * half)};
}

Drawn draw_uniform(SquarePoint u) {
  const Direction local = uniform_hemisphere_from_square(u);
  return {local, uniform_hemisphere_pdf(local).value};
}

Drawn draw_half_vector(const Lobe& lobe, SquarePoint u) {
  return std::visit([&](const auto& one) { return draw_half_vector(one, u); }, lobe);
}

double ratio(const Lobe& lobe, const Drawn& drawn) {
  return relative_density(lobe, drawn.local.z) / drawn.pdf;
}

/// Draws half-vectors at numbers that are not uniform any more, but dense where the lobe is larger
/// than what half-vectors draw: in proportion to their ratio, constant in each of many cells.
class LobeDrawing {
 public:
  explicit LobeDrawing(const Lobe& lobe) : lobe_(lobe), below_{0.0} {
    for (int cell = 0; cell < kCells; ++cell) {
      below_.push_back(below_.back() +
                       ratio(lobe, draw_half_vector(lobe, {0.0, (cell + 0.5) / kCells})));
    }
  }

  Drawn operator()(SquarePoint u) const {
    const double mass = u.t * below_.back();
    const auto above = std::upper_bound(below_.begin() + 1, below_.end() - 1, mass);
    const auto cell = static_cast<std::size_t>(above - below_.begin()) - 1;
    const double cell_mass = below_[cell + 1] - below_[cell];
    const double inside = std::min((mass - below_[cell]) / cell_mass, 1.0);
    Drawn drawn = draw_half_vector(lobe_, {u.s, (static_cast<double>(cell) + inside) / kCells});
    drawn.pdf *= cell_mass / below_.back() * kCells;
    return drawn;
  }

 private:
  static constexpr int kCells = 4096;

  const Lobe& lobe_;
  std::vector<double> below_;
};

}  // namespace

double ggx_half_vector_cosine(double alpha, double u) {
  return std::sqrt((1.0 - u) / (1.0 + (alpha * alpha - 1.0) * u));
}

double half_vector_cosine(double shininess, double u) {
  return std::pow(u, 1.0 / (shininess + 1.0));
}

std::vector<LobeSample> lobe_samples(const Lobe& lobe, LobeSampling sampling, int count) {
  const LobeDrawing by_lobe(lobe);
  std::vector<LobeSample> samples;
  double sum = 0.0;
  const Hammersley points(static_cast<std::uint64_t>(count), 0, {});
  for (int n = 0; n < count; ++n) {
    const SquarePoint u = points.point(static_cast<std::uint32_t>(n));
    const Drawn drawn = sampling == LobeSampling::uniform       ? draw_uniform(u)
                        : sampling == LobeSampling::half_vector ? draw_half_vector(lobe, u)
                                                                : by_lobe(u);
    const double weight = ratio(lobe, drawn);
    if (!(weight > 0.0)) continue;
    samples.push_back({drawn.local, weight, {drawn.pdf}});
    sum += weight;
  }
  for (LobeSample& sample : samples) sample.weight /= sum;
  return samples;
}

}  // namespace lightproof
