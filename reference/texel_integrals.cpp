#include "reference/texel_integrals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "lightproof/core/gauss_rule.h"
#include "lightproof/core/measure.h"
#include "lightproof/core/parallel.h"
#include "lightproof/warp/lat_long.h"

namespace lightproof::reference {
namespace {

const std::array<GaussNode, 2>& two_nodes() {
  static const GaussRule<2> rule;
  return rule.nodes();
}
const std::array<GaussNode, 3>& three_nodes() {
  static const GaussRule<3> rule;
  return rule.nodes();
}

double angle_between(Direction a, Direction b) {
  return 2.0 * std::asin(std::min(1.0, 0.5 * glm::length(a - b)));
}

/// What the sum over nodes needs to know of one side of a cell. All cells of a row, or of a column,
/// share it.
template <std::size_t kNodes>
struct NodesAlong {
  struct Node {
    double sine;         ///< of the polar angle
    double height;       ///< the cosine of the polar angle
    double solid_angle;  ///< per area of the square, times the node's weight
  };
  std::array<Node, kNodes> nodes;
};

template <std::size_t kNodes>
struct NodesAcross {
  struct Node {
    double cosine;  ///< of the longitude
    double sine;
    double weight;
  };
  std::array<Node, kNodes> nodes;
};

struct Latitude {
  double sine;
  double height;
};

/// The parts of direction_from_square() that hold for all points of one height, or of one place
/// along it.
Latitude latitude(double t) {
  const Direction at = direction_from_square({0.5, t});
  return {at.x, at.z};
}

Direction direction_at(Latitude latitude, double cosine, double sine) {
  return {latitude.sine * cosine, latitude.sine * sine, latitude.height};
}

template <std::size_t kNodes>
NodesAlong<kNodes> nodes_along(const std::array<GaussNode, kNodes>& rule, double t, double height) {
  NodesAlong<kNodes> along;
  for (std::size_t i = 0; i < kNodes; ++i) {
    const double at = t + (rule[i].at - 0.5) * height;
    const auto [sine, cosine] = latitude(at);
    along.nodes[i] = {sine, cosine, rule[i].weight * solid_angle_per_square(at)};
  }
  return along;
}

template <std::size_t kNodes>
NodesAcross<kNodes> nodes_across(const std::array<GaussNode, kNodes>& rule, double s,
                                 double width) {
  NodesAcross<kNodes> across;
  for (std::size_t i = 0; i < kNodes; ++i) {
    const double longitude = kPi - 2.0 * kPi * (s + (rule[i].at - 0.5) * width);
    across.nodes[i] = {std::cos(longitude), std::sin(longitude), rule[i].weight};
  }
  return across;
}

/// A cell's extent in t.
struct Band {
  double t;  ///< of its middle
  double height;
  Latitude middle;
  double widest;  ///< the largest sine of the polar angle at its edges and its middle

  Band(double at, double extent)
      : t(at),
        height(extent),
        middle(latitude(at)),
        widest(
            std::max({sin_theta(at - 0.5 * extent), sin_theta(at), sin_theta(at + 0.5 * extent)})) {
  }
};

/// A cell's extent in s.
struct Wedge {
  double s;  ///< of its middle
  double width;
  double cosine;  ///< of the longitude in its middle
  double sine;

  Wedge(double at, double extent)
      : s(at),
        width(extent),
        cosine(std::cos(kPi - 2.0 * kPi * at)),
        sine(std::sin(kPi - 2.0 * kPi * at)) {}
};

template <std::size_t kNodes>
NodesAlong<kNodes> nodes_of(const std::array<GaussNode, kNodes>& rule, const Band& band) {
  return nodes_along(rule, band.t, band.height);
}

template <std::size_t kNodes>
NodesAcross<kNodes> nodes_of(const std::array<GaussNode, kNodes>& rule, const Wedge& wedge) {
  return nodes_across(rule, wedge.s, wedge.width);
}

/// A band or a wedge of whole texels, whose nodes are there for all of them.
template <class Extended>
struct WithNodes : Extended {
  decltype(nodes_of(two_nodes(), std::declval<Extended>())) two;
  decltype(nodes_of(three_nodes(), std::declval<Extended>())) three;

  WithNodes(double at, double extent)
      : Extended(at, extent),
        two(nodes_of(two_nodes(), static_cast<const Extended&>(*this))),
        three(nodes_of(three_nodes(), static_cast<const Extended&>(*this))) {}
};

template <class Extended>
const auto& nodes_of(const std::array<GaussNode, 2>& /*rule*/, const WithNodes<Extended>& all) {
  return all.two;
}

template <class Extended>
const auto& nodes_of(const std::array<GaussNode, 3>& /*rule*/, const WithNodes<Extended>& all) {
  return all.three;
}

template <std::size_t kNodes>
double by_nodes(const PeakedDensity& density, const NodesAlong<kNodes>& along,
                const NodesAcross<kNodes>& across) {
  double sum = 0.0;
  for (const auto& row : along.nodes) {
    double line = 0.0;
    for (const auto& column : across.nodes) {
      line += column.weight *
              density.value(direction_at({row.sine, row.height}, column.cosine, column.sine));
    }
    sum += row.solid_angle * line;
  }
  return sum;
}

template <class AnyBand, class AnyWedge>
double integral(const PeakedDensity& density, const AnyBand& band, const AnyWedge& wedge) {
  const double least_on_horizon = density.jumps ? 1e-3 : 2e-2;
  const Direction centre = direction_at(band.middle, wedge.cosine, wedge.sine);
  const double size = std::hypot(kPi * band.height, 2.0 * kPi * wedge.width * band.widest);
  const double above = glm::dot(centre, density.normal);
  if (above < -0.5 * size) return 0.0;
  const double distance = std::max(0.0, angle_between(centre, density.peak) - 0.5 * size);
  const bool on_horizon = above < 0.5 * size && size > least_on_horizon;
  const double smooth = std::hypot(distance, density.width);
  const auto by = [&](const auto& rule) {
    return wedge.width * band.height *
           by_nodes(density, nodes_of(rule, band), nodes_of(rule, wedge));
  };
  if (!on_horizon && size < 0.05 * smooth) return by(two_nodes());
  if (!on_horizon && size < 0.33 * smooth) return by(three_nodes());
  const double width = 0.5 * wedge.width;
  const double height = 0.5 * band.height;
  const std::array<Wedge, 2> across = {Wedge(wedge.s - 0.5 * width, width),
                                       Wedge(wedge.s + 0.5 * width, width)};
  double sum = 0.0;
  for (const double along : {-0.5, 0.5}) {
    const Band half(band.t + along * height, height);
    for (const Wedge& part : across) sum += integral(density, half, part);
  }
  return sum;
}

PeakedDensity around(const Lobe& lobe, Direction axis) {
  return {[&lobe, axis](Direction light) { return lobe.value(light, axis); }, axis, lobe.width,
          axis, lobe.jumps};
}

/// The cosine between two directions' half-vector and either of them, from the cosine between them.
double half_cosine(double cosine) { return std::sqrt(0.5 * (1.0 + cosine)); }

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

glm::dvec3 weighted_sum(const Grid<Rgb>& map, const Grid<double>& weights) {
  glm::dvec3 sum(0.0);
  for (int y = 0; y < map.extent().height; ++y) {
    glm::dvec3 row(0.0);
    for (int x = 0; x < map.extent().width; ++x) row += weights(x, y) * glm::dvec3(map(x, y));
    sum += row;
  }
  return sum;
}

double total(const Grid<double>& weights) {
  double sum = 0.0;
  for (const double weight : weights.values()) sum += weight;
  return sum;
}

}  // namespace

Grid<double> texel_integrals(const PeakedDensity& density, Extent extent) {
  std::vector<WithNodes<Wedge>> columns;
  for (int x = 0; x < extent.width; ++x) {
    columns.emplace_back((x + 0.5) / extent.width, 1.0 / extent.width);
  }
  Grid<double> integrals(extent);
  const std::size_t rows_at_once =
      std::max<std::size_t>(1, kTaskCells / static_cast<std::size_t>(extent.width));
  parallel_chunks(static_cast<std::size_t>(extent.height), rows_at_once,
                  [&](std::size_t /*chunk*/, std::size_t first, std::size_t end) {
                    for (int y = static_cast<int>(first); y < static_cast<int>(end); ++y) {
                      const WithNodes<Band> row((y + 0.5) / extent.height, 1.0 / extent.height);
                      std::ranges::transform(
                          columns, integrals.row(y).begin(),
                          [&](const auto& column) { return integral(density, row, column); });
                    }
                  });
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
            return ggx_distribution(alpha, half_cosine(cosine)) * cosine;
          },
          2.0 * alpha};
}

Lobe ggx_masked_lobe(double alpha, double f0) {
  return {[alpha, f0](Direction light, Direction axis) {
            const double cosine = glm::dot(light, axis);
            if (!(cosine > 0.0)) return 0.0;
            const double half = half_cosine(cosine);
            const double tangent = std::sqrt(1.0 - cosine * cosine) / cosine;
            const double masking = 2.0 / (1.0 + std::sqrt(1.0 + alpha * alpha * tangent * tangent));
            const double fresnel = f0 + (1.0 - f0) * std::pow(1.0 - half, 5.0);
            return ggx_distribution(alpha, half) * masking * fresnel;
          },
          2.0 * alpha};
}

Lobe half_vector_lobe(double shininess) {
  return {[shininess](Direction light, Direction axis) {
            const double cosine = glm::dot(light, axis);
            if (!(cosine > 0.0)) return 0.0;
            return std::pow(half_cosine(cosine), shininess);
          },
          2.0 / std::sqrt(shininess + 1.0), true};
}

glm::dvec3 prefiltered(const Grid<Rgb>& map, const Lobe& lobe, Direction axis) {
  const Grid<double> weights = texel_integrals(around(lobe, axis), map.extent());
  return weighted_sum(map, weights) / total(weights);
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
  return weighted_sum(map, texel_integrals(reflected_cosine, map.extent()));
}

}  // namespace lightproof::reference
