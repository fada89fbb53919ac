#include "lightproof/estimators/rounded_table.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "lightproof/core/parallel.h"
#include "lightproof/estimators/cell_cdf.h"
#include "lightproof/samplers/texel_weights.h"
#include "lightproof/warp/lat_long.h"

namespace lightproof {
namespace {

constexpr std::size_t kRun = 32;
/// A row has at least this share of the light, so that its cumulative sum grows.
constexpr double kLeastRow = 0x1p-48;

/// A number as so many bits after the leading one and an exponent below 0, all values of a form in
/// multiples of one unit: sums over a row are exact in double.
struct SmallFloat {
  int fraction_bits;
  int least_exponent;  ///< of numbers with the leading one; below, steps are those of this exponent

  double unit() const { return std::ldexp(1.0, least_exponent - fraction_bits); }
  /// The code of a number in (0,1], at least 1.
  std::uint16_t encode(double x) const {
    const int exponent = std::max(std::ilogb(x), least_exponent);
    const double steps = std::nearbyint(std::ldexp(x, fraction_bits - exponent));
    const int base = (exponent - least_exponent) << fraction_bits;
    return static_cast<std::uint16_t>(std::max(1.0, base + steps));
  }
  /// The number that encode() stands for.
  double rounded(double x) const {
    if (x < std::ldexp(1.0, least_exponent)) {
      return std::max(1.0, std::nearbyint(x / unit())) * unit();
    }
    const auto dropped = static_cast<unsigned>(52 - fraction_bits);
    auto bits = std::bit_cast<std::uint64_t>(x);
    bits += (std::uint64_t{1} << (dropped - 1)) - 1 + ((bits >> dropped) & 1U);
    return std::bit_cast<double>(bits >> dropped << dropped);
  }
  double decode(unsigned code) const {
    const unsigned one = 1U << static_cast<unsigned>(fraction_bits);
    if (code < 2 * one) return code * unit();
    const unsigned exponent = (code >> static_cast<unsigned>(fraction_bits)) - 1;
    return static_cast<double>(one + (code & (one - 1))) *
           static_cast<double>(std::uint64_t{1} << exponent) * unit();
  }
};

/// 1 is the largest number of either form.
constexpr SmallFloat float_of(MassForm form) {
  return form == MassForm::half ? SmallFloat{10, -14} : SmallFloat{3, -27};
}

}  // namespace

RoundedTable::RoundedTable(const EnvironmentMap& map, MassForm form)
    : form_(form),
      extent_(map.radiance.extent()),
      positions_(map.radiance.extent(), DensitySpace::solid_angle) {
  const auto width = static_cast<std::size_t>(extent_.width);
  const auto height = static_cast<std::size_t>(extent_.height);
  const std::size_t runs = chunks_of(width, kRun);
  if (form == MassForm::half) halves_.resize(extent_.count());
  if (form == MassForm::byte) bytes_.resize(extent_.count());
  rows_.resize(height);
  runs_.resize(height * runs);
  const SmallFloat small = float_of(form);
  parallel_for(height, [&](std::size_t y) {
    std::vector<double> luminance(width);
    double most = 0.0;
    for (std::size_t x = 0; x < width; ++x) {
      luminance[x] =
          luminance_of(map.radiance(static_cast<int>(x), static_cast<int>(y)), map.weights);
      most = std::max(most, luminance[x]);
      rows_[y] += luminance[x];
    }
    rows_[y] *= texel_solid_angle(extent_, static_cast<int>(y));
    double sum = 0.0;
    for (std::size_t x = 0; x < width; ++x) {
      const std::uint16_t code = luminance[x] > 0.0 ? small.encode(luminance[x] / most) : 0;
      if (form == MassForm::half) halves_[y * width + x] = code;
      if (form == MassForm::byte) bytes_[y * width + x] = static_cast<std::uint8_t>(code);
      sum += small.decode(code);
      runs_[y * runs + x / kRun] = sum;
    }
  });
  double whole = 0.0;
  for (const double row : rows_) whole += row;
  if (!(whole > 0.0)) refuse_black(map);
  double sum = 0.0;
  for (double& row : rows_) row = sum += row > 0.0 ? std::max(row, kLeastRow * whole) : 0.0;
}

double RoundedTable::value(std::size_t texel) const { return float_of(form_).decode(code(texel)); }

std::span<const double> RoundedTable::runs_of(int y) const {
  const std::size_t runs = chunks_of(static_cast<std::size_t>(extent_.width), kRun);
  return std::span(runs_).subspan(static_cast<std::size_t>(y) * runs, runs);
}

LightSample RoundedTable::sample(SquarePoint u) const {
  const FoundCell row = find_cell(rows_, 0.0, u.t);
  const auto y = static_cast<int>(row.index);
  const auto runs = runs_of(y);
  const FoundCell run = find_cell(runs, 0.0, u.s);
  const auto width = static_cast<std::size_t>(extent_.width);
  const std::size_t end = std::min(width, (run.index + 1) * kRun);
  double left = run.rest * run.width;
  std::size_t x = run.index * kRun;
  std::size_t last = x;  // the last one with light, should rounding run past it
  double found = 0.0;
  for (; x < end; ++x) {
    const double here = value(row.index * width + x);
    if (here > 0.0) {
      last = x;
      found = here;
      if (left < here) break;
    }
    left -= here;
  }
  const double column_fraction = std::clamp(x < end ? left / found : 1.0, 0.0, 1.0 - 0x1p-53);
  const double mass = row.width / rows_.back() * (found / runs.back());
  return positions_.direction({static_cast<int>(last), y, column_fraction, row.rest, mass});
}

double RoundedTable::mass(int x, int y) const {
  const auto row = static_cast<std::size_t>(y);
  const double of_row = rows_[row] - (row == 0 ? 0.0 : rows_[row - 1]);
  if (!(of_row > 0.0)) return 0.0;
  const std::size_t texel =
      row * static_cast<std::size_t>(extent_.width) + static_cast<std::size_t>(x);
  return of_row / rows_.back() * (value(texel) / runs_of(y).back());
}

std::size_t RoundedTable::bytes() const {
  return halves_.size() * sizeof(std::uint16_t) + bytes_.size() +
         (rows_.size() + runs_.size()) * sizeof(double) + positions_.bytes();
}

namespace {

void draw_from(const RoundedTable& table, const BatchPoints& points, LightSamples& samples) {
  draw_each(points, samples, [&](SquarePoint u) { return table.sample(u); });
}

}  // namespace

PreparedSource rounded_table_source(const EnvironmentMap& map, MassForm form) {
  const auto table = std::make_shared<const RoundedTable>(map, form);
  return {&map,
          [table](const Material& material) -> SamplesAt {
            return [table, material](const ShadingPoint& at) -> DrawSamples {
              return [&table = *table, &material, &at](const BatchPoints& points,
                                                       LightSamples& samples) {
                draw_from(table, points, samples);
                samples.reflect(material, at);
              };
            };
          },
          table->bytes()};
}

std::function<PerSteradian(SquarePoint)> rounded_table_pdf(const EnvironmentMap& map,
                                                           MassForm form) {
  const Extent extent = map.radiance.extent();
  const auto table = std::make_shared<const RoundedTable>(map, form);
  const auto solid_angles = std::make_shared<std::vector<double>>();
  for (int y = 0; y < extent.height; ++y) solid_angles->push_back(texel_solid_angle(extent, y));
  return [table, extent, solid_angles](SquarePoint at) {
    const int y = cell_of(at.t, extent.height);
    return PerSteradian{table->mass(cell_of(at.s, extent.width), y) /
                        (*solid_angles)[static_cast<std::size_t>(y)]};
  };
}

double rounded_table_variance(const EnvironmentMap& map, MassForm form) {
  const Extent extent = map.radiance.extent();
  const SmallFloat small = float_of(form);
  std::vector<double> light(static_cast<std::size_t>(extent.height));
  std::vector<double> added(light.size());  // of a row's light
  parallel_for(light.size(), [&](std::size_t row) {
    std::vector<double> luminance(static_cast<std::size_t>(extent.width));
    double most = 0.0;
    double sum = 0.0;
    for (std::size_t x = 0; x < luminance.size(); ++x) {
      luminance[x] =
          luminance_of(map.radiance(static_cast<int>(x), static_cast<int>(row)), map.weights);
      most = std::max(most, luminance[x]);
      sum += luminance[x];
    }
    if (!(most > 0.0)) return;
    // Of relative values v and rounded ones r, (sum of v^2/r) (sum of r) / (sum of v)^2 - 1, with
    // v = r + d: cancellation leaves sums of d and d^2/r alone.
    double rounded = 0.0;
    double off = 0.0;
    double squares = 0.0;
    for (const double each : luminance) {
      if (!(each > 0.0)) continue;
      const double r = small.rounded(each / most);
      const double d = each / most - r;
      rounded += r;
      off += d;
      squares += d * d / r;
    }
    const double all = rounded + off;
    added[row] = (squares * rounded - off * off) / (all * all);
    light[row] = sum * texel_solid_angle(extent, static_cast<int>(row));
  });
  double whole = 0.0;
  double variance = 0.0;
  for (std::size_t row = 0; row < light.size(); ++row) {
    whole += light[row];
    variance += added[row] * light[row];
  }
  return whole > 0.0 ? variance / whole : 0.0;
}

}  // namespace lightproof
