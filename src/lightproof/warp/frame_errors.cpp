#include "lightproof/warp/frame_errors.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "lightproof/core/measure.h"

namespace lightproof {
namespace {

constexpr std::array<FrameConstruction, 7> kConstructions = {{
    {"frisvad", "Frisvad 2012, listing 2", frisvad_frame<float>, frisvad_frame<double>,
     "loses digits near -z"},
    {"duff", "Duff et al. 2017, listing 3", duff_frame<float>, duff_frame<double>},
    {"householder", "Householder 1958", householder_frame<float>, householder_frame<double>},
    {"tangent frame", "z x n and n x (z x n)", bare_tangent_frame<float>,
     bare_tangent_frame<double>, "not a number at the poles"},
    {"quaternion", "q v q^-1, the axis normalised", bare_quaternion_frame<float>,
     bare_quaternion_frame<double>, "not a number at the poles"},
    {"quaternion, published", "the same as a matrix in n, the poles treated apart",
     published_quaternion_frame<float>, published_quaternion_frame<double>, "loses digits near -z"},
    {"quaternion, corrected", "the same, from -z below the horizon", quaternion_frame<float>,
     quaternion_frame<double>},
}};

constexpr int kAzimuths = 64;

template <class T>
UnitVector<T> normal_at(bool is_nadir, double distance, int azimuth) {
  // The azimuths lie half a step aside, so that none is on an axis, where products of components
  // vanish.
  const double phi = 2.0 * kPi * (azimuth + 0.5) / kAzimuths;
  const double sine = std::sin(distance);
  const double height = std::cos(distance);
  return {static_cast<T>(sine * std::cos(phi)), static_cast<T>(sine * std::sin(phi)),
          static_cast<T>(is_nadir ? -height : height)};
}

/// The larger one, or what of both is not a number.
template <class Number>
Number worse_of(Number a, Number b) {
  return std::isnan(a) || a >= b ? a : b;
}

template <class T>
double error_of(const FrameOf<T>& frame) {
  using Wide = glm::vec<3, long double>;
  const std::array<Wide, 3> columns = {Wide(frame.tangent), Wide(frame.bitangent),
                                       Wide(frame.normal)};
  long double largest = 0.0L;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    for (std::size_t j = i; j < columns.size(); ++j) {
      const long double product = glm::dot(columns[i], columns[j]);
      largest = worse_of(largest, std::abs(product - (i == j ? 1.0L : 0.0L)));
    }
  }
  return static_cast<double>(largest);
}

template <class T>
double largest_error(FrameOf<T> (*construct)(UnitVector<T>), bool is_nadir, double distance) {
  double largest = 0.0;
  for (int azimuth = 0; azimuth < kAzimuths; ++azimuth) {
    largest = worse_of(largest, error_of(construct(normal_at<T>(is_nadir, distance, azimuth))));
  }
  return largest;
}

}  // namespace

std::span<const FrameConstruction> frame_constructions() { return kConstructions; }

double orthonormality_error(const FrameOf<float>& frame) { return error_of(frame); }
double orthonormality_error(const FrameOf<double>& frame) { return error_of(frame); }

std::vector<FrameError> frame_errors(std::span<const double> distances) {
  std::vector<FrameError> rows;
  const auto add_line = [&](const FrameConstruction& each, bool is_float, bool is_nadir) {
    for (const double distance : distances) {
      const double error = is_float ? largest_error(each.in_float, is_nadir, distance)
                                    : largest_error(each.in_double, is_nadir, distance);
      rows.push_back({each.name, is_float, is_nadir, distance, error});
    }
  };
  for (const FrameConstruction& each : kConstructions) {
    for (const bool is_float : {true, false}) {
      for (const bool is_nadir : {true, false}) add_line(each, is_float, is_nadir);
    }
  }
  return rows;
}

}  // namespace lightproof
