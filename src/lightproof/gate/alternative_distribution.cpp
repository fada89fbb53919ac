#include "lightproof/gate/alternative_distribution.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "lightproof/core/measure.h"
#include "lightproof/warp/lat_long.h"
#include "lightproof/warp/mapping.h"
#include "reference/texel_masses.h"

namespace lightproof {
namespace {

void normalise(Grid<double>& masses) {
  const auto values = masses.values();
  const double total = std::accumulate(values.begin(), values.end(), 0.0);
  for (double& mass : values) mass /= total;
}

/// Texels of weight value(x, y).
template <class Value>
Grid<double> weighted(Extent extent, const Value& value) {
  Grid<double> masses(extent);
  for (int y = 0; y < extent.height; ++y) {
    for (int x = 0; x < extent.width; ++x) masses(x, y) = value(x, y);
  }
  normalise(masses);
  return masses;
}

/// Texels of weight value(x, y), times the weight of their row.
template <class Value, class RowWeight>
Grid<double> weighted(Extent extent, const Value& value, const RowWeight& row_weight) {
  Grid<double> masses(extent);
  for (int y = 0; y < extent.height; ++y) {
    const double row = row_weight(y);
    for (int x = 0; x < extent.width; ++x) masses(x, y) = row * value(x, y);
  }
  normalise(masses);
  return masses;
}

double declared_weight(const DeclaredDistribution& declared, int x, int y) {
  const Mapping& mapping = declared.map->mapping;
  return texel_measure(declared.target.density_space, mapping) == MapMeasure::square
             ? 1.0
             : texel_solid_angle(mapping, declared.map->radiance.extent(), x, y);
}

/// The declared distribution with another luminance.
template <class Luminance>
Grid<double> with_luminance(const DeclaredDistribution& declared, const Luminance& luminance) {
  const Extent extent = declared.map->radiance.extent();
  if (declared.target.lookup == Lookup::bilinear) {
    EnvironmentMap other = {declared.map->name, declared.map->radiance};
    for (Rgb& rgb : other.radiance.values()) rgb = Rgb(static_cast<float>(luminance(rgb)));
    return reference::texel_masses(other, declared.target);
  }
  return weighted(extent, [&](int x, int y) {
    return declared_weight(declared, x, y) * luminance(declared.map->radiance(x, y));
  });
}

/// The declared distribution with another weight of the rows.
template <class RowWeight>
Grid<double> with_rows(const DeclaredDistribution& declared, const RowWeight& weight) {
  if (declared.target.lookup == Lookup::bilinear) {
    TargetDensity target = declared.target;
    target.density_space = DensitySpace::texture;
    if (weighs_texels(declared.target.density_space)) {
      // The weights of rows are interpolated, too.
      EnvironmentMap other = {declared.map->name, declared.map->radiance};
      for (int y = 0; y < other.radiance.extent().height; ++y) {
        for (Rgb& rgb : other.radiance.row(y)) rgb *= static_cast<float>(weight(y));
      }
      return reference::texel_masses(other, target);
    }
    const Grid<double> masses = reference::texel_masses(*declared.map, target);
    return weighted(
        masses.extent(), [&](int x, int y) { return masses(x, y); }, weight);
  }
  return weighted(
      declared.map->radiance.extent(),
      [&](int x, int y) {
        return luminance_of(declared.map->radiance(x, y), declared.target.weights);
      },
      weight);
}

/// The declared masses, moved: texel (x, y) gets those of from(x, y).
template <class From>
Grid<double> moved(const DeclaredDistribution& declared, const From& from) {
  const Grid<double>& masses = *declared.masses;
  Grid<double> result(masses.extent());
  for (int y = 0; y < masses.extent().height; ++y) {
    for (int x = 0; x < masses.extent().width; ++x) result(x, y) = from(masses, x, y);
  }
  normalise(result);
  return result;
}

Grid<double> other_density(const DeclaredDistribution& declared) {
  TargetDensity target = declared.target;
  target.density_space = texel_measure(target.density_space) == MapMeasure::square
                             ? DensitySpace::solid_angle
                             : DensitySpace::texture;
  return reference::texel_masses(*declared.map, target);
}

Grid<double> other_lookup(const DeclaredDistribution& declared) {
  TargetDensity target = declared.target;
  target.lookup = target.lookup == Lookup::nearest ? Lookup::bilinear : Lookup::nearest;
  return reference::texel_masses(*declared.map, target);
}

Grid<double> sine_at_edge(const DeclaredDistribution& declared) {
  const double height = declared.map->radiance.extent().height;
  return with_rows(declared, [&](int y) { return std::sin(kPi * y / height); });
}

Grid<double> sine_to_last_row(const DeclaredDistribution& declared) {
  const double last = std::max(1, declared.map->radiance.extent().height - 1);
  return with_rows(declared, [&](int y) { return std::abs(std::sin(kPi * y / last)); });
}

Grid<double> sine_twice(const DeclaredDistribution& declared) {
  const Extent extent = declared.map->radiance.extent();
  return with_rows(declared, [&](int y) {
    const double sine = sin_theta((y + 0.5) / extent.height);
    return texel_measure(declared.target.density_space) == MapMeasure::square
               ? sine * sine
               : texel_solid_angle(extent, y) * sine;
  });
}

Grid<double> column_late(const DeclaredDistribution& declared) {
  return moved(declared, [](const Grid<double>& m, int x, int y) {
    return m(x == 0 ? m.extent().width - 1 : x - 1, y);
  });
}

Grid<double> column_early(const DeclaredDistribution& declared) {
  return moved(declared, [](const Grid<double>& m, int x, int y) {
    return m(x + 1 == m.extent().width ? 0 : x + 1, y);
  });
}

Grid<double> row_late(const DeclaredDistribution& declared) {
  return moved(declared,
               [](const Grid<double>& m, int x, int y) { return y == 0 ? 0.0 : m(x, y - 1); });
}

Grid<double> upside_down(const DeclaredDistribution& declared) {
  return moved(declared,
               [](const Grid<double>& m, int x, int y) { return m(x, m.extent().height - 1 - y); });
}

Grid<double> mirrored(const DeclaredDistribution& declared) {
  return moved(declared,
               [](const Grid<double>& m, int x, int y) { return m(m.extent().width - 1 - x, y); });
}

Grid<double> half_turn(const DeclaredDistribution& declared) {
  return moved(declared, [](const Grid<double>& m, int x, int y) {
    return m((x + m.extent().width / 2) % m.extent().width, y);
  });
}

/// The distribution without the second half of the columns, and the first half twice as likely.
Grid<double> half_circle(const DeclaredDistribution& declared) {
  return moved(declared, [](const Grid<double>& m, int x, int y) {
    return 2 * x < m.extent().width ? m(x, y) : 0.0;
  });
}

Grid<double> without_last_column(const DeclaredDistribution& declared) {
  return moved(declared, [](const Grid<double>& m, int x, int y) {
    return x + 1 == m.extent().width ? 0.0 : m(x, y);
  });
}

Grid<double> without_last_row(const DeclaredDistribution& declared) {
  return moved(declared, [](const Grid<double>& m, int x, int y) {
    return y + 1 == m.extent().height ? 0.0 : m(x, y);
  });
}

/// The first row that has light.
Grid<double> without_first_row(const DeclaredDistribution& declared) {
  const std::vector<double> rows = reference::row_marginal(*declared.masses);
  const auto lit = std::find_if(rows.begin(), rows.end(), [](double mass) { return mass > 0.0; });
  const auto first = static_cast<int>(lit - rows.begin());
  if (rows[static_cast<std::size_t>(first)] == 1.0) return *declared.masses;
  return moved(declared,
               [&](const Grid<double>& m, int x, int y) { return y == first ? 0.0 : m(x, y); });
}

Grid<double> rows_alike(const DeclaredDistribution& declared) {
  const Grid<double>& masses = *declared.masses;
  const std::vector<double> rows = reference::row_marginal(masses);
  return weighted(
      masses.extent(), [&](int x, int y) { return masses(x, y); },
      [&](int y) {
        const double mass = rows[static_cast<std::size_t>(y)];
        return mass > 0.0 ? 1.0 / mass : 0.0;
      });
}

Grid<double> columns_of_next_row(const DeclaredDistribution& declared) {
  const Grid<double>& masses = *declared.masses;
  const std::vector<double> rows = reference::row_marginal(masses);
  const auto height = static_cast<std::size_t>(masses.extent().height);
  return moved(declared, [&](const Grid<double>& m, int x, int y) {
    const std::size_t row = static_cast<std::size_t>(y);
    const std::size_t next = rows[(row + 1) % height] > 0.0 ? (row + 1) % height : row;
    return rows[next] > 0.0 ? m(x, static_cast<int>(next)) * rows[row] / rows[next] : 0.0;
  });
}

Grid<double> lecture_luminance(const DeclaredDistribution& declared) {
  TargetDensity target = declared.target;
  // Where the lecture's luminance is declared, the mistake is the standard's.
  target.weights = target.weights.red == kPublishedLuminance.red ? kRec709 : kPublishedLuminance;
  return reference::texel_masses(*declared.map, target);
}

Grid<double> average_luminance(const DeclaredDistribution& declared) {
  TargetDensity target = declared.target;
  target.weights = {1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0};
  return reference::texel_masses(*declared.map, target);
}

Grid<double> swapped_channels(const DeclaredDistribution& declared) {
  TargetDensity target = declared.target;
  std::swap(target.weights.red, target.weights.blue);
  return reference::texel_masses(*declared.map, target);
}

Grid<double> gamma_left_in(const DeclaredDistribution& declared) {
  return with_luminance(declared, [&](Rgb rgb) {
    return std::pow(luminance_of(rgb, declared.target.weights), 1.0 / 2.2);
  });
}

Grid<double> squared(const DeclaredDistribution& declared) {
  return with_luminance(declared, [&](Rgb rgb) {
    const double luminance = luminance_of(rgb, declared.target.weights);
    return luminance * luminance;
  });
}

/// Clamped where a picture format would clamp: at sixteen times the mean.
Grid<double> clamped(const DeclaredDistribution& declared) {
  const Grid<double> luminance = luminance_of(*declared.map, declared.target.weights);
  const auto values = luminance.values();
  const double mean =
      std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  return with_luminance(declared, [&](Rgb rgb) {
    return std::min(luminance_of(rgb, declared.target.weights), 16.0 * mean);
  });
}

Grid<double> uniform_mixed_in(const DeclaredDistribution& declared) {
  constexpr double kShare = 0.01;
  return moved(declared, [&](const Grid<double>& m, int x, int y) {
    return (1.0 - kShare) * m(x, y) + kShare / static_cast<double>(m.extent().count());
  });
}

/// A hundredth of the mean for texels without light: what abs() makes of the values slightly below
/// zero that filters leave beside bright lamps.
Grid<double> zero_density_texels_drawn(const DeclaredDistribution& declared) {
  return moved(declared, [](const Grid<double>& m, int x, int y) {
    return m(x, y) > 0.0 ? m(x, y) : 0.01 / static_cast<double>(m.extent().count());
  });
}

Grid<double> uniform(const DeclaredDistribution& declared) {
  return with_luminance(declared, [](Rgb) { return 1.0; });
}

Grid<double> quarter_turn(const DeclaredDistribution& declared) {
  return moved(declared, [](const Grid<double>& m, int x, int y) {
    return m((x + m.extent().width / 4) % m.extent().width, y);
  });
}

/// Rows whose average lies below 1e-4, whatever the exposure; the declared distribution if all do.
Grid<double> without_dim_rows(const DeclaredDistribution& declared) {
  const Grid<double> luminance = luminance_of(*declared.map, declared.target.weights);
  const Extent extent = luminance.extent();
  std::vector<bool> dim;
  for (int y = 0; y < extent.height; ++y) {
    const auto row = luminance.row(y);
    dim.push_back(std::accumulate(row.begin(), row.end(), 0.0) / extent.width < 1e-4);
  }
  if (std::all_of(dim.begin(), dim.end(), [](bool d) { return d; })) dim.assign(dim.size(), false);
  return moved(declared, [&](const Grid<double>& m, int x, int y) {
    return dim[static_cast<std::size_t>(y)] ? 0.0 : m(x, y);
  });
}

/// The distribution without the texel that is nearest to six times as likely as the median of the
/// lit ones.
Grid<double> without_one_texel(const DeclaredDistribution& declared) {
  const Grid<double>& masses = *declared.masses;
  std::vector<double> lit;
  for (const double mass : masses.values()) {
    if (mass > 0.0) lit.push_back(mass);
  }
  if (lit.size() < 2) return masses;
  const auto middle = lit.begin() + static_cast<std::ptrdiff_t>(lit.size() / 2);
  std::nth_element(lit.begin(), middle, lit.end());
  const double six = std::log(6.0 * *middle);
  const auto distance = [&](double mass) {
    return mass > 0.0 ? std::abs(std::log(mass) - six) : HUGE_VAL;
  };
  const auto values = masses.values();
  const auto one = std::min_element(values.begin(), values.end(),
                                    [&](double a, double b) { return distance(a) < distance(b); });
  Grid<double> rest = masses;
  rest.values()[static_cast<std::size_t>(one - values.begin())] = 0.0;
  normalise(rest);
  return rest;
}

/// The distribution after half of every texel's mass went to the next column.
Grid<double> half_column(const DeclaredDistribution& declared) {
  return moved(declared, [](const Grid<double>& m, int x, int y) {
    return 0.5 * (m(x, y) + m(x == 0 ? m.extent().width - 1 : x - 1, y));
  });
}

constexpr auto kAlternatives = std::to_array<AlternativeDistribution>({
    {"other-density", "a missing sin(theta) (or one too many): the other target density",
     other_density, true, false, MappingNeed::unequal_areas,
     "the solid angle of texels forgotten (or counted twice): the other target density"},
    {"other-lookup", "the other look-up: whole texels for interpolated ones, or the reverse",
     other_lookup, true, false, MappingNeed::rows},
    {"sine-at-edge", "sin(theta) taken at the row's edge, y/H instead of (y+1/2)/H", sine_at_edge,
     true, false, MappingNeed::rows},
    {"sine-to-last-row", "sin(theta) taken at y/(H-1) instead of (y+1/2)/H", sine_to_last_row, true,
     false, MappingNeed::rows},
    {"sine-twice", "sin(theta) applied twice", sine_twice, true, false, MappingNeed::rows},
    {"column-late", "columns off by one: each is drawn for the one before it", column_late, false},
    {"column-early", "columns off by one: each is drawn for the one after it", column_early, false},
    {"one-texel-missing", "one texel of some brightness is never drawn", without_one_texel, false,
     true},
    {"half-texel", "half a texel added in s", half_column, false},
    {"row-late", "rows off by one: each is drawn for the one below it", row_late, false},
    {"upside-down", "t flipped", upside_down, false},
    {"mirrored", "s mirrored", mirrored, false},
    {"half-turn", "the seam of phi on the other side: s shifted by one half", half_turn, false,
     false, MappingNeed::none, "columns shifted by half of the width"},
    {"half-circle", "only half of the azimuths: pi where 2 pi belongs", half_circle, false, false,
     MappingNeed::none, "only the left half of the columns is drawn"},
    {"no-last-column", "the last column is never drawn", without_last_column, false},
    {"no-last-row", "the last row is never drawn", without_last_row, false},
    {"no-first-row", "the first row with light is never drawn", without_first_row, false},
    {"rows-alike", "rows drawn equally often, not weighted by their sum: theta is uniform",
     rows_alike, false, false, MappingNeed::none,
     "rows drawn equally often, not weighted by their sum"},
    {"columns-of-next-row", "columns drawn from the next row's distribution", columns_of_next_row,
     false},
    {"other-luminance",
     "other luminance weights than declared (Rec. 709 and the lecture's mixed up)",
     lecture_luminance},
    {"average-luminance", "the average of R, G, B instead of the declared luminance",
     average_luminance},
    {"swapped-channels", "R and B swapped", swapped_channels},
    {"gamma", "gamma left in: values not linear", gamma_left_in},
    {"squared", "luminance squared", squared},
    {"clamped", "bright values clamped", clamped},
    {"uniform-mixed-in", "some samples drawn uniformly", uniform_mixed_in, false},
    {"zero-density-texels-drawn", "texels without light are drawn: abs() of values below zero",
     zero_density_texels_drawn, false},
    {"quarter-turn", "the map turned by 90 degrees", quarter_turn, false, false, MappingNeed::none,
     "columns shifted by a quarter of the width"},
    {"dim-rows-skipped", "rows darker than an absolute threshold are never drawn",
     without_dim_rows},
    {"uniform", "the map is not looked at: uniform samples", uniform},
});

}  // namespace

std::span<const AlternativeDistribution> alternative_distributions() { return kAlternatives; }

std::string_view why_meaningless(MappingNeed need, const Mapping& mapping) {
  switch (need) {
    case MappingNeed::rows:
      return mapping.kind == MappingKind::lat_long
                 ? ""
                 : "it is a mistake of rows of latitude, which the mapping does not have";
    case MappingNeed::unequal_areas:
      return is_equal_area(mapping) ? "all texels have one solid angle: nothing could be forgotten"
                                    : "";
    case MappingNeed::none:
      break;
  }
  return "";
}

std::string_view AlternativeDistribution::diagnosis_on(const Mapping& mapping) const {
  const bool has_azimuths =
      mapping.kind == MappingKind::lat_long || mapping.kind == MappingKind::node_rows;
  return has_azimuths || diagnosis_of_picture.empty() ? diagnosis : diagnosis_of_picture;
}

const AlternativeDistribution& alternative_distribution(std::string_view name) {
  const auto* found = std::find_if(
      kAlternatives.begin(), kAlternatives.end(),
      [&](const AlternativeDistribution& distribution) { return distribution.name == name; });
  if (found == kAlternatives.end()) {
    throw std::invalid_argument(fmt::format("no distribution is called '{}'", name));
  }
  return *found;
}

}  // namespace lightproof
