// A sampler of environment maps as a plug-in of Lightproof: texels in proportion to luminance times
// solid angle, found by std::upper_bound in sums of rows and of columns; positions uniform in the
// picture inside a texel (density C). Put your own in its place.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <vector>

#include "lightproof_plugin.h"

namespace {

constexpr double kPi = 3.14159265358979323846;
/// How close to the edge of a texel a sample may come, in texels: at a pole there is no density.
constexpr double kEdge = 1e-9;

/// Sums of probabilities, from 0 to 1.
class Sums {
 public:
  explicit Sums(const std::vector<double>& weights) : sums_(1, 0.0) {
    for (const double weight : weights) sums_.push_back(total_ += weight);
    if (total_ <= 0.0) return;
    for (double& sum : sums_) sum /= total_;
  }

  double total() const { return total_; }
  double mass(std::size_t i) const { return sums_[i + 1] - sums_[i]; }
  /// The i at which sums go beyond u: never one without probability.
  std::size_t find(double u) const {
    const auto above = std::upper_bound(sums_.begin() + 1, sums_.end() - 1, u);
    return static_cast<std::size_t>(above - sums_.begin()) - 1;
  }
  /// How far u lies on its way through step i, from 0 to 1, but for the edges.
  double fraction(std::size_t i, double u) const {
    return std::clamp((u - sums_[i]) / mass(i), kEdge, 1.0 - kEdge);
  }

 private:
  double total_ = 0.0;
  std::vector<double> sums_;
};

class Sampler {
 public:
  explicit Sampler(const lightproof_map& map)
      : width_(map.width), height_(map.height), rows_(make_columns(map)) {
    if (rows_.total() <= 0.0) throw std::runtime_error("the map is black");
  }

  void sample(const double* u, double* row_of_numbers) const {
    const std::size_t row = rows_.find(u[1]);
    const Sums& columns = columns_[row];
    const std::size_t column = columns.find(u[0]);
    const double theta = kPi * (static_cast<double>(row) + rows_.fraction(row, u[1])) / height_;
    const double phi =
        kPi - 2.0 * kPi * (static_cast<double>(column) + columns.fraction(column, u[0])) / width_;
    const double sine = std::sin(theta);
    row_of_numbers[0] = sine * std::cos(phi);
    row_of_numbers[1] = sine * std::sin(phi);
    row_of_numbers[2] = std::cos(theta);
    row_of_numbers[3] = density(column, row, sine);
  }

  /// Per steradian.
  double pdf(double x, double y, double z) const {
    const double sine = std::hypot(x, y);
    return density(cell(0.5 - std::atan2(y, x) / (2.0 * kPi), width_),
                   cell(std::atan2(sine, z) / kPi, height_), sine);
  }

 private:
  /// Makes the sums of every row, and returns those of the rows.
  Sums make_columns(const lightproof_map& map) {
    std::vector<double> row_weights;
    for (std::size_t row = 0; row < map.height; ++row) {
      const double solid_angle = 2.0 * kPi / map.width *
                                 (std::cos(kPi * static_cast<double>(row) / map.height) -
                                  std::cos(kPi * static_cast<double>(row + 1) / map.height));
      std::vector<double> weights;
      for (std::size_t column = 0; column < map.width; ++column) {
        const float* rgb = map.texels + 3 * (row * map.width + column);
        double luminance = 0.0;
        for (int i = 0; i < 3; ++i) luminance += map.luminance[i] * static_cast<double>(rgb[i]);
        weights.push_back(luminance * solid_angle);
      }
      columns_.emplace_back(weights);
      row_weights.push_back(columns_.back().total());
    }
    return Sums(row_weights);
  }

  double density(std::size_t column, std::size_t row, double sine) const {
    const double mass = rows_.mass(row) * columns_[row].mass(column);
    return sine > 0.0 ? mass * width_ * height_ / (2.0 * kPi * kPi * sine) : 0.0;
  }

  static std::size_t cell(double coordinate, double count) {
    return static_cast<std::size_t>(std::clamp(std::floor(coordinate * count), 0.0, count - 1.0));
  }

  double width_;
  double height_;
  std::vector<Sums> columns_;
  Sums rows_;
};

/// No exception may leave a function of the interface.
void* create(const lightproof_map* map, char* error, std::size_t error_bytes) {
  try {
    return new Sampler(*map);
  } catch (const std::exception& failure) {
    std::snprintf(error, error_bytes, "%s", failure.what());
    return nullptr;
  }
}

void sample(void* sampler, std::size_t count, const double* u, double* rows) {
  for (std::size_t i = 0; i < count; ++i) {
    static_cast<const Sampler*>(sampler)->sample(u + 2 * i, rows + 4 * i);
  }
}

void pdf(void* sampler, std::size_t count, const double* positions, double* densities) {
  for (std::size_t i = 0; i < count; ++i) {
    const double* at = positions + 3 * i;
    densities[i] = static_cast<const Sampler*>(sampler)->pdf(at[0], at[1], at[2]);
  }
}

void destroy(void* sampler) { delete static_cast<Sampler*>(sampler); }

}  // namespace

extern "C" LIGHTPROOF_PLUGIN_EXPORT const lightproof_plugin* lightproof_plugin_describe() {
  static const lightproof_plugin plugin = [] {
    lightproof_plugin description = {};  // what is not named has its default
    description.abi = LIGHTPROOF_PLUGIN_ABI;
    description.size = sizeof description;
    description.name = "@NAME@";
    description.preset = "z-up";
    description.measure = "solid-angle";
    description.density = "C";
    description.create = create;
    description.sample = sample;
    description.pdf = pdf;
    description.destroy = destroy;
    return description;
  }();
  return &plugin;
}
