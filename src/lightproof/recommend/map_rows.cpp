#include "lightproof/recommend/map_rows.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "lightproof/core/measure.h"

namespace lightproof {
namespace {

constexpr int kMostRows = 2048;
/// Degrees that are looked at: what a lobe leaves beyond is taken for all that it has at the last.
constexpr int kDegrees = kMostRows / 2;

/// The bound of prefiltered_error(), for any number of rows.
class RowError {
 public:
  RowError(const MapSummary& summary, const Lobe& lobe)
      : summary_(&summary), factors_(zonal_factors(lobe, kDegrees)) {
    for (int l = 0; l <= MapSummary::kDegree; ++l) low_ += summary.power(l);
  }

  double of(int rows) const {
    const int last = rows / 2 - 1;
    const double height = kPi / rows;
    const double left_out = power([&](int l) { return l > last ? 1.0 : 0.0; });
    const double laplacian = power([](int l) { return (l + 1.0) * l; });
    return (std::sqrt(left_out) + height * height / 8.0 * std::sqrt(laplacian)) *
           std::sqrt(kSphere) / summary_->light;
  }

 private:
  double factor(int l) const { return factors_[static_cast<std::size_t>(l)]; }

  /// The most that the sum of (weight(l) lambda_l)^2 times the power of degree l can be.
  template <class Weight>
  double power(const Weight& weight) const {
    const auto response = [&](int l) {
      const double value = weight(l) * factor(l);
      return value * value;
    };
    double sum = 0.0;
    for (int l = 0; l <= MapSummary::kDegree; ++l) sum += response(l) * summary_->power(l);
    std::vector<int> degrees(kDegrees - MapSummary::kDegree);
    std::iota(degrees.begin(), degrees.end(), MapSummary::kDegree + 1);
    std::ranges::stable_sort(degrees, [&](int a, int b) { return response(a) > response(b); });
    double rest = std::max(0.0, summary_->square - low_);
    for (const int l : degrees) {
      const double most = (2.0 * l + 1.0) / kSphere * summary_->light * summary_->light;
      const double here = std::min(rest, most);
      sum += here * response(l);
      rest -= here;
    }
    return sum + rest * response(kDegrees);
  }

  const MapSummary* summary_;
  std::vector<double> factors_;
  double low_ = 0.0;  ///< power of the degrees that are known
};

}  // namespace

double prefiltered_error(const MapSummary& summary, const Lobe& lobe, int rows) {
  return summary.has_light() ? RowError(summary, lobe).of(rows) : 0.0;
}

std::optional<int> rows_needed(const MapSummary& summary, const Lobe& lobe, double error) {
  if (!summary.has_light()) return 2;
  const RowError bound(summary, lobe);
  int low = 1;  // in pairs of rows
  int high = kMostRows / 2;
  if (bound.of(2 * high) > error) return std::nullopt;
  while (low < high) {
    const int middle = low + (high - low) / 2;
    if (bound.of(2 * middle) <= error) {
      high = middle;
    } else {
      low = middle + 1;
    }
  }
  return 2 * low;
}

}  // namespace lightproof
