#include "reference/texel_integrals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "lightproof/core/measure.h"
#include "lightproof/core/parallel.h"
#include "lightproof/warp/lat_long.h"

namespace lightproof::reference {
namespace {

/// Gauss-Legendre nodes in [0,1] (Abramowitz & Stegun 25.4.29).
struct GaussNode {
  double place;
  double weight;
};
constexpr std::array<GaussNode, 2> kTwoNodes = {
    {{0.21132486540518712, 0.5}, {0.78867513459481288, 0.5}}};
constexpr std::array<GaussNode, 3> kThreeNodes = {
    {{0.11270166537925831, 5.0 / 18.0}, {0.5, 8.0 / 18.0}, {0.88729833462074169, 5.0 / 18.0}}};

struct Cell {
  double s;  ///< of its centre
  double t;
  double width;
  double height;
};

double angle_between(Direction a, Direction b) {
  return 2.0 * std::asin(std::min(1.0, 0.5 * glm::length(a - b)));
}

double by_nodes(const PeakedDensity& density, const Cell& cell, std::span<const GaussNode> nodes) {
  double sum = 0.0;
  for (const GaussNode& along : nodes) {
    const double t = cell.t + (along.place - 0.5) * cell.height;
    double line = 0.0;
    for (const GaussNode& across : nodes) {
      const double s = cell.s + (across.place - 0.5) * cell.width;
      line += across.weight * density.value(direction_from_square({s, t}));
    }
    sum += along.weight * solid_angle_per_square(t) * line;
  }
  return sum * cell.width * cell.height;
}

double integral(const PeakedDensity& density, const Cell& cell) {
  const double least_on_horizon = density.jumps ? 1e-3 : 2e-2;
  const Direction centre = direction_from_square({cell.s, cell.t});
  const double widest = std::max({sin_theta(cell.t - 0.5 * cell.height), sin_theta(cell.t),
                                  sin_theta(cell.t + 0.5 * cell.height)});
  const double size = std::hypot(kPi * cell.height, 2.0 * kPi * cell.width * widest);
  const double distance = std::max(0.0, angle_between(centre, density.peak) - 0.5 * size);
  const double above = glm::dot(centre, density.normal);
  if (above < -0.5 * size) return 0.0;
  const bool on_horizon = above < 0.5 * size && size > least_on_horizon;
  const double smooth = std::hypot(distance, density.width);
  if (!on_horizon && size < 0.05 * smooth) return by_nodes(density, cell, kTwoNodes);
  if (!on_horizon && size < 0.33 * smooth) return by_nodes(density, cell, kThreeNodes);
  double sum = 0.0;
  for (const double along : {-0.25, 0.25}) {
    for (const double across : {-0.25, 0.25}) {
      sum += integral(density, {cell.s + across * cell.width, cell.t + along * cell.height,
                                0.5 * cell.width, 0.5 * cell.height});
    }
  }
  return sum;
}

PeakedDensity around(const Lobe& lobe, Direction axis) {
  return {[&lobe, axis](Direction light) { return lobe.value(light, axis); }, axis, lobe.width,
          axis, lobe.jumps};
}

/// D of Trowbridge and Reitz.
double ggx_distribution(double alpha, double cosine) {
  const double tilt = (alpha * alpha - 1.0) * cosine * cosine + 1.0;
  return alpha * alpha / (kPi * tilt * tilt);
}

/// A map as three planes of doubles, each row twice in a row: turned by any number of columns it is
/// a contiguous part.
class TurnedMap {
 public:
  explicit TurnedMap(const Grid<Rgb>& map) : width_(map.extent().width) {
    for (auto& plane : planes_) plane = Grid<double>({2 * width_, map.extent().height});
    for (int y = 0; y < map.extent().height; ++y) {
      for (int x = 0; x < 2 * width_; ++x) {
        for (int channel = 0; channel < 3; ++channel) {
          planes_[static_cast<std::size_t>(channel)](x, y) =
              static_cast<double>(map(x % width_, y)[channel]);
        }
      }
    }
  }

  /// The sum over all texels of weights(x, y) times the texel (x + columns, y).
  glm::dvec3 sum(const Grid<double>& weights, int columns) const {
    glm::dvec3 sum(0.0);
    for (int y = 0; y < weights.extent().height; ++y) {
      for (int channel = 0; channel < 3; ++channel) {
        const auto row = planes_[static_cast<std::size_t>(channel)].row(y);
        sum[channel] += product(weights.row(y), row.subspan(static_cast<std::size_t>(columns)));
      }
    }
    return sum;
  }

 private:
  /// In lanes of their own, which become vectors.
  static double product(std::span<const double> a, std::span<const double> b) {
    std::array<double, 8> lanes = {};
    std::size_t i = 0;
    for (; i + lanes.size() <= a.size(); i += lanes.size()) {
      for (std::size_t lane = 0; lane < lanes.size(); ++lane) {
        lanes[lane] += a[i + lane] * b[i + lane];
      }
    }
    for (; i < a.size(); ++i) lanes[0] += a[i] * b[i];
    double sum = 0.0;
    for (const double lane : lanes) sum += lane;
    return sum;
  }

  int width_;
  std::array<Grid<double>, 3> planes_;
};

double total(const Grid<double>& weights) {
  double sum = 0.0;
  for (const double weight : weights.values()) sum += weight;
  return sum;
}

}  // namespace

Grid<double> texel_integrals(const PeakedDensity& density, Extent extent) {
  Grid<double> integrals(extent);
  for (int y = 0; y < extent.height; ++y) {
    for (int x = 0; x < extent.width; ++x) {
      integrals(x, y) = integral(density, {(x + 0.5) / extent.width, (y + 0.5) / extent.height,
                                           1.0 / extent.width, 1.0 / extent.height});
    }
  }
  return integrals;
}

Lobe phong_lobe(double exponent) {
  return {[exponent](Direction light, Direction axis) {
            const double cosine = glm::dot(light, axis);
            return cosine > 0.0 ? std::pow(cosine, exponent) : 0.0;
          },
          1.0 / std::sqrt(exponent + 1.0), exponent < 1.0};
}

Lobe ggx_lobe(double alpha) {
  return {[alpha](Direction light, Direction axis) {
            const double cosine = glm::dot(light, axis);
            if (!(cosine > 0.0)) return 0.0;
            return ggx_distribution(alpha, glm::dot(glm::normalize(light + axis), axis)) * cosine;
          },
          2.0 * alpha};
}

Lobe ggx_masked_lobe(double alpha, double f0) {
  return {[alpha, f0](Direction light, Direction axis) {
            const double cosine = glm::dot(light, axis);
            if (!(cosine > 0.0)) return 0.0;
            const double half = glm::dot(glm::normalize(light + axis), axis);
            const double tangent = std::sqrt(1.0 - cosine * cosine) / cosine;
            const double masking = 2.0 / (1.0 + std::sqrt(1.0 + alpha * alpha * tangent * tangent));
            const double fresnel = f0 + (1.0 - f0) * std::pow(1.0 - half, 5.0);
            return ggx_distribution(alpha, half) * masking * fresnel;
          },
          2.0 * alpha};
}

Lobe half_vector_lobe(double shininess) {
  return {[shininess](Direction light, Direction axis) {
            if (!(glm::dot(light, axis) > 0.0)) return 0.0;
            return std::pow(glm::dot(glm::normalize(light + axis), axis), shininess);
          },
          2.0 / std::sqrt(shininess + 1.0), true};
}

glm::dvec3 prefiltered(const Grid<Rgb>& map, const Lobe& lobe, Direction axis) {
  const Grid<double> weights = texel_integrals(around(lobe, axis), map.extent());
  return TurnedMap(map).sum(weights, 0) / total(weights);
}

Grid<glm::dvec3> prefiltered(const Grid<Rgb>& map, const Lobe& lobe, Extent extent) {
  const TurnedMap turned(map);
  Grid<glm::dvec3> level(extent);
  const int ratio = map.extent().width / extent.width;
  const bool shares = ratio * extent.width == map.extent().width;
  const int weighed = shares ? 1 : extent.width;  // columns with integrals of their own
  parallel_for(static_cast<std::size_t>(extent.height * weighed), [&](std::size_t task) {
    const int y = static_cast<int>(task) / weighed;
    const int first = static_cast<int>(task) % weighed;
    const Direction axis =
        direction_from_square({(first + 0.5) / extent.width, (y + 0.5) / extent.height});
    const Grid<double> weights = texel_integrals(around(lobe, axis), map.extent());
    const double whole = total(weights);
    for (int x = first; x < extent.width; x += weighed) {
      level(x, y) = turned.sum(weights, shares ? x * ratio : 0) / whole;
    }
  });
  return level;
}

glm::dvec3 reflected(const Grid<Rgb>& map, const PeakedDensity& reflected_cosine) {
  return TurnedMap(map).sum(texel_integrals(reflected_cosine, map.extent()), 0);
}

}  // namespace lightproof::reference
