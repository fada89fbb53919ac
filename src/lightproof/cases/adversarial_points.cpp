#include "lightproof/cases/adversarial_points.h"

#include <cmath>
#include <cstddef>
#include <cstdint>

namespace lightproof {

std::vector<double> adversarial_numbers(CdfEntries entries) {
  std::vector<double> numbers = {0.0, 0x1p-60, 0x1p-31, 0.5, 1.0 - 0x1p-24, kLastBelowOne};
  for (const std::uint32_t entry : entries) {
    const double u = entry * 0x1p-31;
    for (const double v : {std::nextafter(u, 0.0), u, std::nextafter(u, 1.0)}) {
      if (v < 1.0) numbers.push_back(v);
    }
  }
  return numbers;
}

std::vector<SquarePoint> adversarial_points(const CdfTable& table) {
  std::vector<SquarePoint> points;
  const std::vector<double> numbers = adversarial_numbers(table.rows());
  for (const double s : numbers) {
    for (const double t : numbers) points.push_back({s, t});
  }
  return points;
}

std::vector<SquarePoint> adversarial_points_of_rows(const CdfTable& table) {
  std::vector<SquarePoint> points;
  for (int y = 0; y < table.extent().height; ++y) {
    const auto row = static_cast<std::size_t>(y);
    const double low = table.rows()[row] * 0x1p-31;
    const double high = table.rows()[row + 1] * 0x1p-31;
    if (low == high) continue;
    for (const double s : adversarial_numbers(table.columns(y))) {
      points.push_back({s, low});
      points.push_back({s, 0.5 * (low + high)});
    }
  }
  return points;
}

}  // namespace lightproof
