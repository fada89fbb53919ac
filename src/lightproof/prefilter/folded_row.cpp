#include "lightproof/prefilter/folded_row.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "lightproof/core/measure.h"
#include "lightproof/prefilter/cosine_band.h"

namespace lightproof {
namespace {

// Plain loops of a few numbers each, which the compiler keeps in registers and makes vectors of.

/// texels[x >> halved] for column x.
void take(std::span<const Rgb> texels, int halved, std::span<PaddedRgb> columns) {
  for (std::size_t x = 0; x < columns.size(); ++x) {
    columns[x] = PaddedRgb(texels[x >> halved], 0.0);
  }
}
void add(std::span<const Rgb> texels, int halved, std::span<PaddedRgb> columns) {
  for (std::size_t x = 0; x < columns.size(); ++x) {
    columns[x] += PaddedRgb(texels[x >> halved], 0.0);
  }
}

/// Sums over the columns before each edge.
void sum_before(std::span<const PaddedRgb> light, const FoldedLattice& lattice,
                std::span<LightVector> before) {
  const double* const cosine = lattice.cosine.data();
  const double* const sine = lattice.sine.data();
  LightVector sum;
  before[0] = sum;
  for (std::size_t x = 0; x < light.size(); ++x) {
    sum.cosine += cosine[x] * light[x];
    sum.sine += sine[x] * light[x];
    sum.height += light[x];
    before[x + 1] = sum;
  }
}

}  // namespace

FoldedLattice::FoldedLattice(Extent map) : columns(map.width % 2 == 0 ? map.width : 2 * map.width) {
  for (int k = 0; k <= (map.height + 1) / 2; ++k) {
    parallels.push_back(std::min(kPi * k / map.height, 0.5 * kPi));
  }
  for (int x = 0; x < columns; ++x) {
    const double middle = 2.0 * kPi * (x + 0.5) / columns;
    const double chord = 2.0 * std::sin(kPi / columns);
    cosine.push_back(chord * std::cos(middle));
    sine.push_back(chord * std::sin(middle));
  }
}

FoldedRow::FoldedRow(const FoldedLattice& lattice)
    : lattice_(lattice),
      light_(2 * static_cast<std::size_t>(lattice.columns)),
      before_(static_cast<std::size_t>(lattice.columns) + 1) {}

void FoldedRow::fold(const EnvironmentMap& map, int k) {
  const auto [width, height] = map.radiance.extent();
  const double inner = lattice_.parallels[static_cast<std::size_t>(k)];
  const double outer = lattice_.parallels[static_cast<std::size_t>(k) + 1];
  level_ = integral_of_sine_squared(outer) - integral_of_sine_squared(inner);
  height_ = (integral_of_sine_cosine(outer) - integral_of_sine_cosine(inner)) * 2.0 * kPi /
            lattice_.columns;
  const std::size_t half = before_.size() / 2;
  const int halved = lattice_.columns == width ? 0 : 1;  // texels are two columns each
  const auto first_turn = std::span(light_).first(2 * half);

  take(map.radiance.row(k), halved, first_turn);
  sum_before(first_turn, lattice_, before_);
  lower_ = scaled(before_.back());
  lower_.height = -lower_.height;

  std::ranges::swap_ranges(first_turn.first(half), first_turn.last(half));
  add(map.radiance.row(height - 1 - k), halved, first_turn);
  sum_before(first_turn, lattice_, before_);
  std::ranges::copy(first_turn, light_.begin() + static_cast<std::ptrdiff_t>(2 * half));
}

}  // namespace lightproof
