#include "lightproof/image/synthetic.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "lightproof/core/error.h"
#include "lightproof/core/measure.h"
#include "lightproof/core/parallel.h"

namespace lightproof {
namespace {

constexpr Extent kLargest = {32768, 16384};

/// Axis of the cosine lobe and of the step; a unit vector.
constexpr Direction kAxis = {2.0 / 3.0, 1.0 / 3.0, 2.0 / 3.0};

/// Directions of the texel centres, in latitude and longitude from one table per column and one
/// per row.
class CentreDirections {
 public:
  CentreDirections(Extent extent, const Mapping& mapping) : extent_(extent), mapping_(mapping) {
    if (!is_plain(mapping)) return;
    for (int x = 0; x < extent.width; ++x) {
      const double phi = kPi - 2.0 * kPi * (x + 0.5) / extent.width;
      equator_.emplace_back(std::cos(phi), std::sin(phi), 0.0);
    }
    for (int y = 0; y < extent.height; ++y) {
      const double t = (y + 0.5) / extent.height;
      sine_.push_back(sin_theta(t));
      cosine_.push_back(cos_theta(t));
    }
  }

  Direction operator()(int x, int y) const {
    if (!is_plain(mapping_)) return direction_at(mapping_, texel_cell(extent_, x, y).centre());
    return {sine_[y] * equator_[x].x, sine_[y] * equator_[x].y, cosine_[y]};
  }

 private:
  Extent extent_;
  Mapping mapping_;
  std::vector<Direction> equator_;
  std::vector<double> sine_;
  std::vector<double> cosine_;
};

/// The map whose texel (x, y) is value(x, y).
template <class Value>
EnvironmentMap filled(std::string_view name, Extent extent, const Mapping& mapping,
                      const Value& value) {
  EnvironmentMap map{.name = std::string(name), .radiance = Grid<Rgb>(extent), .mapping = mapping};
  parallel_for(static_cast<std::size_t>(extent.height), [&](std::size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < extent.width; ++x) map.radiance(x, y) = value(x, y);
  });
  return map;
}

/// The map whose texels are value(direction of the texel centre).
template <class Value>
EnvironmentMap filled_by_direction(std::string_view name, Extent extent, const Mapping& mapping,
                                   const Value& value) {
  const CentreDirections direction(extent, mapping);
  return filled(name, extent, mapping, [&](int x, int y) { return value(direction(x, y)); });
}

Rgb grey(double value) { return Rgb(static_cast<float>(value)); }

/// L = 1: integral over the sphere 4 pi, irradiance pi for every normal.
EnvironmentMap make_constant(Extent extent, const Mapping& mapping) {
  return filled("constant", extent, mapping, [](int, int) { return Rgb(1.0F); });
}

/// L = 1 in the texel (W/3, 3H/4), whole numbers rounded down, else 0: above the horizon from two
/// rows on. Integral: the solid angle of that texel.
EnvironmentMap make_one_texel(Extent extent, const Mapping& mapping) {
  EnvironmentMap map{.name = "one-texel", .radiance = Grid<Rgb>(extent), .mapping = mapping};
  map.radiance(extent.width / 3, 3 * extent.height / 4) = Rgb(1.0F);
  return map;
}

/// L = c (1 + z/2), c = (1, 3/4, 1/2): integral 4 pi c, irradiance pi c (1 + n.z/3).
Rgb gradient(Direction d) { return static_cast<float>(1.0 + 0.5 * d.z) * Rgb(1.0F, 0.75F, 0.5F); }

EnvironmentMap make_gradient(Extent extent, const Mapping& mapping) {
  return filled_by_direction("gradient", extent, mapping, gradient);
}

/// L = max(w.d, 0): integral pi; irradiance (2/3) ((pi - a) cos a + sin a) at the angle a between
/// the normal and d.
EnvironmentMap make_cosine_lobe(Extent extent, const Mapping& mapping) {
  return filled_by_direction("cosine-lobe", extent, mapping,
                             [](Direction w) { return grey(std::max(0.0, glm::dot(w, kAxis))); });
}

/// L = 1 where w.d > 0, else 0: integral 2 pi, irradiance pi (1 + cos a)/2.
EnvironmentMap make_step(Extent extent, const Mapping& mapping) {
  return filled_by_direction("step", extent, mapping, [](Direction w) {
    return grey(glm::dot(w, kAxis) > 0.0 ? 1.0 : 0.0);
  });
}

/// A run of at most three cells around `centre`, shifted to stay inside [0, count).
struct Run {
  int begin;
  int end;

  Run(int centre, int count)
      : begin(std::max(0, std::min(centre - 1, count - 3))), end(std::min(count, begin + 3)) {}
  bool contains(int index) const { return index >= begin && index < end; }
};

/// Sky c (1 + z/2), c = (0.3, 0.5, 1), and a sun of 3 x 3 texels (fewer if the map is smaller)
/// around column W/4, row 5H/6, of radiance 1e5 (1, 0.9, 0.7): 30 degrees from the zenith, and
/// above the horizon from six rows on.
EnvironmentMap make_sun_sky(Extent extent, const Mapping& mapping) {
  const Run columns(extent.width / 4, extent.width);
  const Run rows(5 * extent.height / 6, extent.height);
  const CentreDirections direction(extent, mapping);
  return filled("sun-sky", extent, mapping, [&](int x, int y) {
    if (columns.contains(x) && rows.contains(y)) return 1e5F * Rgb(1.0F, 0.9F, 0.7F);
    return static_cast<float>(1.0 + 0.5 * direction(x, y).z) * Rgb(0.3F, 0.5F, 1.0F);
  });
}

/// 16 x 8 fields (at most one per texel) of (1, 0.5, 0.25) and (0.1, 0.2, 0.4) in turn, the former
/// at the texel (0, 0).
EnvironmentMap make_checker(Extent extent, const Mapping& mapping) {
  const int columns = std::min(16, extent.width);
  const int rows = std::min(8, extent.height);
  return filled("checker", extent, mapping, [=](int x, int y) {
    const int field = x * columns / extent.width + y * rows / extent.height;
    return field % 2 == 0 ? Rgb(1.0F, 0.5F, 0.25F) : Rgb(0.1F, 0.2F, 0.4F);
  });
}

/// The texel row y = 0 is black, the others (1 + x/2, 1 + y/2, 1 + z/2) in the components of the
/// direction; a map of a single row keeps it lit.
EnvironmentMap make_black_first_row(Extent extent, const Mapping& mapping) {
  const CentreDirections direction(extent, mapping);
  return filled("black-first-row", extent, mapping, [&](int x, int y) {
    if (y == 0 && extent.height > 1) return Rgb(0.0F);
    return Rgb(1.0 + 0.5 * direction(x, y));
  });
}

using MakeOn = EnvironmentMap (*)(Extent, const Mapping&);

template <MakeOn kMake>
constexpr SyntheticMap row(std::string_view name, std::string_view description) {
  return {name, description, [](Extent extent) { return kMake(extent, {}); }, kMake};
}

constexpr std::array kMaps = {
    row<make_constant>("constant", "radiance 1 everywhere"),
    row<make_one_texel>("one-texel", "one lit texel above the horizon, the rest black"),
    row<make_gradient>("gradient", "coloured, linear in z, positive everywhere"),
    row<make_cosine_lobe>("cosine-lobe", "max(w.d, 0) around d = (2/3, 1/3, 2/3)"),
    row<make_step>("step", "1 where w.d > 0 for d = (2/3, 1/3, 2/3), else 0"),
    row<make_sun_sky>("sun-sky", "smooth sky with a sun of 3 x 3 texels, 1e5 times as bright"),
    row<make_checker>("checker", "16 x 8 fields in two colours"),
    row<make_black_first_row>("black-first-row",
                              "coloured and positive, but the lowest row is black"),
};

void check_extent(Extent extent) {
  if (extent.width >= 1 && extent.width <= kLargest.width && extent.height >= 1 &&
      extent.height <= kLargest.height) {
    return;
  }
  throw InputError(fmt::format("a map of {} x {} texels: 1 x 1 to {} x {} needed", extent.width,
                               extent.height, kLargest.width, kLargest.height));
}

}  // namespace

std::span<const SyntheticMap> synthetic_maps() { return kMaps; }

EnvironmentMap make_synthetic_map(std::string_view name, Extent extent, const Mapping& mapping) {
  check_extent(extent);
  if (const std::string fault = size_fault(mapping, extent); !fault.empty()) {
    throw InputError(
        fmt::format("{} of {} x {} texels: {}", name, extent.width, extent.height, fault));
  }
  std::string names;
  for (const SyntheticMap& map : kMaps) {
    if (map.name == name) return map.make_on(extent, mapping);
    names += fmt::format("{}{}", names.empty() ? "" : ", ", map.name);
  }
  throw InputError(fmt::format("no built-in map '{}': {} exist", name, names));
}

}  // namespace lightproof
