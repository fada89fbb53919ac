#include "lightproof/prefilter/folded_row.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "lightproof/core/measure.h"
#include "lightproof/prefilter/cosine_band.h"

namespace lightproof {

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

FoldedRow::FoldedRow(const FoldedLattice& lattice, int teeth)
    : lattice_(lattice),
      stride_(lattice.columns / teeth),
      comb_(3 * static_cast<std::size_t>(teeth)),
      light_(2 * comb_ * static_cast<std::size_t>(stride_)),
      cosine_(light_.size()),
      sine_(light_.size()),
      height_(light_.size()) {
  assert(lattice.columns % teeth == 0);
}

void FoldedRow::fold(const EnvironmentMap& map, int k) {
  const auto [width, height] = map.radiance.extent();
  const std::span<const Rgb> upper = map.radiance.row(height - 1 - k);
  const std::span<const Rgb> lower = map.radiance.row(k);
  const int halves = lattice_.columns / width;  // parts of a texel of the map
  const double inner = lattice_.parallels[static_cast<std::size_t>(k)];
  const double outer = lattice_.parallels[static_cast<std::size_t>(k) + 1];
  const double level = integral_of_sine_squared(outer) - integral_of_sine_squared(inner);
  const double upright = (integral_of_sine_cosine(outer) - integral_of_sine_cosine(inner)) * 2.0 *
                         kPi / lattice_.columns;
  folded_sum_ = {};
  lower_sum_ = {};
  for (int x = 0; x < lattice_.columns; ++x) {
    const int opposite = (x + lattice_.columns / 2) % lattice_.columns;
    const glm::dvec3 below(lower[static_cast<std::size_t>(opposite / halves)]);
    const glm::dvec3 light = glm::dvec3(upper[static_cast<std::size_t>(x / halves)]) + below;
    put(light_, x, light);
    put(cosine_, x, folded_sum_.cosine);
    put(sine_, x, folded_sum_.sine);
    put(height_, x, folded_sum_.height);
    const double cosine = level * lattice_.cosine[static_cast<std::size_t>(x)];
    const double sine = level * lattice_.sine[static_cast<std::size_t>(x)];
    folded_sum_ += {cosine * light, sine * light, upright * light};
    lower_sum_ += {-cosine * below, -sine * below, -upright * below};
  }
  append_second_turn();
}

void FoldedRow::put(std::vector<double>& values, int column, glm::dvec3 rgb) const {
  double* at = values.data() + place(column);
  at[0] = rgb.r;
  at[1] = rgb.g;
  at[2] = rgb.b;
}

void FoldedRow::append_second_turn() {
  const auto append = [this](std::vector<double>& values, glm::dvec3 whole) {
    for (std::size_t at = 0; at < values.size(); at += 2 * comb_) {
      for (std::size_t i = at; i < at + comb_; i += 3) {
        for (std::size_t channel = 0; channel < 3; ++channel) {
          values[i + comb_ + channel] = values[i + channel] + whole[static_cast<int>(channel)];
        }
      }
    }
  };
  append(light_, glm::dvec3(0.0));
  append(cosine_, folded_sum_.cosine);
  append(sine_, folded_sum_.sine);
  append(height_, folded_sum_.height);
}

}  // namespace lightproof
