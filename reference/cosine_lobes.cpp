#include "reference/cosine_lobes.h"

#include <algorithm>
#include <cmath>

#include "lightproof/core/measure.h"
#include "reference/quadrature.h"

namespace lightproof::reference {
namespace {

bool stands_on_z(const CosineLobe& lobe) { return lobe.axis == Direction(0.0, 0.0, 1.0); }

double density(const CosineLobe& lobe, Direction d) {
  const double cosine = glm::dot(lobe.axis, d);
  if (cosine <= 0.0) return 0.0;
  return lobe.share * (lobe.exponent + 1.0) / (2.0 * kPi) * std::pow(cosine, lobe.exponent);
}

/// P(cos(theta) <= cosine).
double cumulative(const CosineLobe& lobe, double cosine) {
  return lobe.share * std::pow(std::max(0.0, cosine), lobe.exponent + 1.0);
}

void add_closed_form(Grid<double>& masses, const CosineLobe& lobe) {
  const Extent cells = masses.extent();
  double below = 0.0;
  for (int y = 0; y < cells.height; ++y) {
    const double above = cumulative(lobe, cos_theta((y + 1.0) / cells.height));
    for (double& mass : masses.row(y)) mass += (above - below) / cells.width;
    below = above;
  }
}

/// The masses are scaled to the lobe's share, so that the rule's own error does not show in the
/// total.
void add_quadrature(Grid<double>& masses, const CosineLobe& lobe) {
  const SphereQuadrature quadrature(masses.extent());
  Grid<double> own(masses.extent());
  double total = 0.0;
  for (int y = 0; y < own.extent().height; ++y) {
    for (int x = 0; x < own.extent().width; ++x) {
      quadrature.visit({x, y, 0}, CellNodes::gauss, [&](const Node& node) {
        own(x, y) += density(lobe, node.direction) * node.solid_angle;
      });
      total += own(x, y);
    }
  }
  for (std::size_t i = 0; i < own.values().size(); ++i) {
    masses.values()[i] += own.values()[i] / total * lobe.share;
  }
}

}  // namespace

double density(std::span<const CosineLobe> lobes, Direction d) {
  double sum = 0.0;
  for (const CosineLobe& lobe : lobes) sum += density(lobe, d);
  return sum;
}

Extent cells_for(std::span<const CosineLobe> lobes) {
  // A quarter of the lobe's own width, 1/sqrt(n): two Gauss nodes a cell are then off by 1e-6.
  double narrowest = 1.0;
  for (const CosineLobe& lobe : lobes) {
    narrowest = std::min(narrowest, 1.0 / std::sqrt(std::max(1.0, lobe.exponent)));
  }
  int width = 256;
  while (2.0 * kPi / width > 0.25 * narrowest) width *= 2;
  return {width, width / 2};
}

Grid<double> cell_masses(std::span<const CosineLobe> lobes, Extent cells) {
  Grid<double> masses(cells);
  for (const CosineLobe& lobe : lobes) {
    stands_on_z(lobe) ? add_closed_form(masses, lobe) : add_quadrature(masses, lobe);
  }
  return masses;
}

bool is_around_z(std::span<const CosineLobe> lobes) {
  return std::all_of(lobes.begin(), lobes.end(), stands_on_z);
}

RosenblattPoint rosenblatt_point(std::span<const CosineLobe> lobes, SquarePoint at) {
  double along = 0.0;
  for (const CosineLobe& lobe : lobes) along += cumulative(lobe, cos_theta(at.t));
  return {std::min(along, 1.0), at.s, at.s};
}

}  // namespace lightproof::reference
