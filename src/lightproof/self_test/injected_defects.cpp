#include "lightproof/self_test/injected_defects.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lightproof::defects {
namespace {

/// Moves a sample to another texel, to the same position inside it.
void move_by(TexelSample& sample, Extent map, int columns, int rows) {
  sample.x += columns;
  sample.y += rows;
  sample.at.s += static_cast<double>(columns) / map.width;
  sample.at.t += static_cast<double>(rows) / map.height;
}

/// A random number without the lowest bits, which one of 16 bits does not have.
double coarse(double u) { return std::floor(u * 0x1p16) * 0x1p-16; }

/// The first cell whose upper edge is not below u, as std::lower_bound finds it.
int lower_bound_of(std::span<const double> sums, double u) {
  const auto found = std::lower_bound(sums.begin(), sums.end(), u);
  return static_cast<int>(std::min(found, sums.end() - 1) - sums.begin());
}

bool is_pole_row(const TexelSample& sample, const DiscreteSampler& distribution) {
  return sample.y == 0 || sample.y == distribution.extent().height - 1;
}

}  // namespace

SquarePoint t_for_both(std::span<const SquarePoint> batch, std::size_t i) {
  return {batch[i].t, batch[i].t};
}

SquarePoint sixteen_bits(std::span<const SquarePoint> batch, std::size_t i) {
  return {coarse(batch[i].s), coarse(batch[i].t)};
}

SquarePoint sixteen_bits_of_s(std::span<const SquarePoint> batch, std::size_t i) {
  return {coarse(batch[i].s), batch[i].t};
}

SquarePoint s_from_last_t(std::span<const SquarePoint> batch, std::size_t i) {
  return {i > 0 ? batch[i - 1].t : batch[i].s, batch[i].t};
}

SquarePoint antithetic_to_the_one_before(std::span<const SquarePoint> batch, std::size_t i) {
  if (i % 2 == 0) return batch[i];
  constexpr double kLast = 1.0 - 0x1p-53;
  return {kLast - batch[i - 1].s, kLast - batch[i - 1].t};
}

SquarePoint each_four_times(std::span<const SquarePoint> batch, std::size_t i) {
  return batch[i - i % 4];
}

SquarePoint jittered(std::span<const SquarePoint> batch, std::size_t i) {
  constexpr std::size_t kStrata = 32;
  return {(static_cast<double>(i % kStrata) + batch[i].s) / kStrata,
          (static_cast<double>(i / kStrata % kStrata) + batch[i].t) / kStrata};
}

TexelSample draw_by_lower_bound(const DiscreteSampler& distribution, SquarePoint u) {
  const int row = lower_bound_of(distribution.rows(), u.t);
  const int column = lower_bound_of(distribution.columns().row(row), u.s);
  const TexelSample upper = distribution.sample(u);
  if (upper.x == column && upper.y == row) return upper;
  const SquarePoint at = {position_in_cell(column, 1.0, distribution.extent().width),
                          position_in_cell(row, 1.0, distribution.extent().height)};
  return {at, column, row, distribution.pdf(at)};
}

TexelSample draw_from_sums_that_end_early(const DiscreteSampler& distribution, SquarePoint u) {
  constexpr double kEnd = 1.0 - 0x1p-20;
  TexelSample drawn = distribution.sample({std::min(u.s / kEnd, kEnd), u.t});
  if (u.s >= kEnd) drawn.x = distribution.extent().width;
  return drawn;
}

TexelSample draw_first_row_at_zero(const DiscreteSampler& distribution, SquarePoint u) {
  TexelSample drawn = distribution.sample(u);
  if (u.t > 0.0) return drawn;
  drawn.at.t = position_in_cell(0, 0.0, distribution.extent().height);
  drawn.y = 0;
  drawn.pdf = distribution.pdf(drawn.at);
  return drawn;
}

void flip_t(TexelSample& sample, const DiscreteSampler& distribution) {
  sample.at.t = 1.0 - sample.at.t;
  sample.y = distribution.extent().height - 1 - sample.y;
}

void mix_in_uniform_samples(TexelSample& sample, const DiscreteSampler& distribution) {
  // The digits of a position inside the texel choose where it goes.
  const auto [width, height] = distribution.extent();
  const double within = sample.at.s * width - sample.x;
  const double stretched = within * 100.0;
  if (stretched >= 1.0) return;
  const double across = stretched * width;
  const double down = (across - std::floor(across)) * height;
  sample.x = static_cast<int>(across);
  sample.y = static_cast<int>(down);
  sample.at = {position_in_cell(sample.x, 0.5, width), position_in_cell(sample.y, 0.5, height)};
}

void add_half_a_texel(TexelSample& sample, const DiscreteSampler& distribution) {
  sample.at.s = std::fmod(sample.at.s + 0.5 / distribution.extent().width, 1.0);
  sample.x = cell_of(sample.at.s, distribution.extent().width);
}

void lose_pdf_in_pole_rows(TexelSample& sample, const DiscreteSampler& distribution) {
  if (is_pole_row(sample, distribution)) sample.pdf = {std::numeric_limits<double>::quiet_NaN()};
}

void square_position_in_texel(TexelSample& sample, const DiscreteSampler& distribution) {
  const double within = sample.at.s * distribution.extent().width - sample.x;
  sample.at.s = position_in_cell(sample.x, within * within, distribution.extent().width);
}

void change_measure_in_pole_rows(TexelSample& sample, const DiscreteSampler& distribution) {
  if (!is_pole_row(sample, distribution)) return;
  const int height = distribution.extent().height;
  const bool lower = 2 * sample.y < height;
  const double within = sample.at.t * height - sample.y;
  // A row of the poles counted from the pole: its solid angle grows with the square of the angle
  // there.
  const double from_pole = lower ? within : 1.0 - within;
  const double moved = distribution.position_measure() == MapMeasure::square
                           ? std::sqrt(from_pole)
                           : from_pole * from_pole;
  sample.at.t = position_in_cell(sample.y, lower ? moved : 1.0 - moved, height);
  sample.pdf = distribution.pdf(sample.at);
}

void change_measure(TexelSample& sample, const DiscreteSampler& distribution) {
  const int height = distribution.extent().height;
  const double low = cos_theta(static_cast<double>(sample.y) / height);
  const double high = cos_theta((sample.y + 1.0) / height);
  double within = sample.at.t * height - sample.y;
  // The share of the row by its own measure is taken for that by the other one.
  if (distribution.position_measure() == MapMeasure::square) {
    const double cosine = low + within * (high - low);
    within = std::acos(std::clamp(-cosine, -1.0, 1.0)) / kPi * height - sample.y;
  } else {
    within = (cos_theta(sample.at.t) - low) / (high - low);
  }
  sample.at.t = position_in_cell(sample.y, within, height);
  sample.pdf = distribution.pdf(sample.at);
}

void move_to_centre(TexelSample& sample, const DiscreteSampler& distribution) {
  sample.at = {position_in_cell(sample.x, 0.5, distribution.extent().width),
               position_in_cell(sample.y, 0.5, distribution.extent().height)};
  sample.pdf = distribution.pdf(sample.at);
}

void return_pdf_of_next_column(TexelSample& sample, const DiscreteSampler& distribution) {
  const double s_next = std::fmod(sample.at.s + 1.0 / distribution.extent().width, 1.0);
  const PerSquare next = distribution.pdf({s_next, sample.at.t});
  if (next.value > 0.0) sample.pdf = next;
}

void return_pdf_per_steradian(TexelSample& sample, const DiscreteSampler& distribution) {
  sample.pdf = {to_solid_angle(distribution.mapping(), sample.pdf, sample.at).value};
}

void make_pdf_noisy(TexelSample& sample, const DiscreteSampler& /*distribution*/) {
  sample.pdf.value *= sample.x % 2 == 0 ? 1.0 / 1.1 : 1.0 / 0.9;
}

void move_one_texel(TexelSample& sample, const DiscreteSampler& distribution) {
  const Extent map = distribution.extent();
  const TexelSample& one = distribution.median();
  if (sample.x != one.x || sample.y != one.y) return;
  move_by(sample, map, sample.x + 1 < map.width ? 1 : -1, 0);
}

PerSquare pdf_per_steradian(const DiscreteSampler& distribution, SquarePoint at) {
  return {to_solid_angle(distribution.mapping(), distribution.pdf(at), at).value};
}

PerSquare pdf_upside_down(const DiscreteSampler& distribution, SquarePoint at) {
  return distribution.pdf({at.s, 1.0 - at.t});
}

}  // namespace lightproof::defects
