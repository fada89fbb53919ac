#include "lightproof/prefilter/legendre_transform.h"

#include <algorithm>
#include <cmath>

#include "lightproof/core/measure.h"

namespace lightproof {
namespace {

/// Vectors of rows that go through the degrees together: their values stay in the first cache.
constexpr std::size_t kMostVectors = 16;
/// Sectoral values below this are taken for 0. What grows from them stays below 1e-100 up to
/// kLargestDegree.
constexpr double kLeastSectoral = 1e-290;

std::size_t whole_blocks(std::size_t items, std::size_t block) {
  return (items + block - 1) / block;
}

/// P_0^0, and P_m^m / (sin P_(m-1)^(m-1)).
double sectoral_step(int order) {
  return order == 0 ? 1.0 / std::sqrt(4.0 * kPi) : std::sqrt((2.0 * order + 1.0) / (2.0 * order));
}

/// P_m^m at points, from P_(m-1)^(m-1).
void next_sectoral(int order, std::span<const double> sines, const double* before, double* now) {
  const double step = sectoral_step(order);
  for (std::size_t i = 0; i < sines.size(); ++i) {
    const double value = step * (order == 0 ? 1.0 : sines[i] * before[i]);
    now[i] = value < kLeastSectoral ? 0.0 : value;
  }
}

/// The sectoral values for all orders up to the degree, one after the other.
TableVector<double> sectoral_values(std::span<const double> sines, int degree) {
  TableVector<double> values(sines.size() * (static_cast<std::size_t>(degree) + 1));
  for (int m = 0; m <= degree; ++m) {
    double* now = values.data() + static_cast<std::size_t>(m) * sines.size();
    next_sectoral(m, sines, now - (m > 0 ? sines.size() : 0), now);
  }
  return values;
}

}  // namespace

LegendreRecursion::LegendreRecursion(int order, int degree) {
  // One more than asked for: the transforms go two degrees at a time.
  const auto count = static_cast<std::size_t>(degree - order) + 2;
  forward.resize(count);
  back.resize(count);
  const double square = static_cast<double>(order) * order;
  double a = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const double next = order + static_cast<double>(i) + 1.0;
    const double after = std::sqrt((4.0 * next * next - 1.0) / (next * next - square));
    forward[i] = after;
    back[i] = i == 0 ? 0.0 : after / a;
    a = after;
  }
}

BandTransform::BandTransform(int height, int degree)
    : height_(height), degree_(degree), lanes_(row_lanes()) {
  const std::size_t vectors = whole_blocks(static_cast<std::size_t>(rows()), lanes_);
  blocks_ = whole_blocks(vectors, kMostVectors);
  vectors_ = whole_blocks(vectors, blocks_);
  set_edges();
  set_seeds();
}

int BandTransform::row_of(std::size_t index) const {
  const std::size_t lane = index % lanes_;
  const std::size_t vector = index / lanes_ % vectors_;
  const std::size_t block = index / lanes_ / vectors_;
  return static_cast<int>((block * lanes_ + lane) * vectors_ + vector);
}

void BandTransform::set_edges() {
  for (std::size_t block = 0; block < blocks_; ++block) {
    for (std::size_t vector = 0; vector <= vectors_; ++vector) {
      for (std::size_t lane = 0; lane < lanes_; ++lane) {
        const auto edge = static_cast<double>((block * lanes_ + lane) * vectors_ + vector);
        // Both edges of the padding are the equator.
        const double t = std::min(edge / height_, 0.5);
        cosines_.push_back(std::sin(kPi * (0.5 - t)));
        squares_.push_back(sin_theta(t) * sin_theta(t));
      }
    }
  }
}

void BandTransform::set_seeds() {
  std::vector<double> sines;
  for (const double square : squares_) sines.push_back(std::sqrt(square));
  sectoral_ = sectoral_values(sines, degree_);
  integrals_.resize(padded_rows() * (static_cast<std::size_t>(degree_) + 1));
  for (int m = 0; m <= degree_; ++m) {
    const double* p = sectoral_.data() + static_cast<std::size_t>(m) * sines.size();
    double* now = integrals_.data() + static_cast<std::size_t>(m) * padded_rows();
    const double scale = m < 2 ? 0.0 : m / (m + 1.0) * sectoral_step(m) * sectoral_step(m - 1);
    for (std::size_t index = 0; index < padded_rows(); ++index) {
      const std::size_t upper = index + index / (vectors_ * lanes_) * lanes_;
      const std::size_t lower = upper + lanes_;
      // Integration by parts gives the integral of sin^(m+1) over the angle from the one of
      // sin^(m-1).
      now[index] = (cosines_[upper] * p[upper] - cosines_[lower] * p[lower]) / (m + 1.0);
      if (m == 1) {
        const double angle =
            std::atan2(sines[lower], cosines_[lower]) - std::atan2(sines[upper], cosines_[upper]);
        now[index] += 0.5 * angle * sectoral_step(0) * sectoral_step(1);
      }
      if (m >= 2) now[index] += scale * *(now + index - 2 * padded_rows());
    }
  }
}

void BandTransform::analyse(const LegendreRecursion& recursion, int order,
                            std::span<const double> even, std::span<const double> odd,
                            std::span<double> coefficients) const {
  const std::size_t row_values = vectors_ * lanes_;
  const std::size_t edge_values = row_values + lanes_;
  TableVector<double> states(2 * edge_values + 2 * row_values);
  std::vector<double> sums((coefficients.size() / kParts + 1) / 2 * 2 * kParts);
  LegendreBlock block = {vectors_,
                         padded_rows(),
                         nullptr,
                         nullptr,
                         nullptr,
                         states.data(),
                         states.data() + edge_values,
                         states.data() + 2 * edge_values,
                         states.data() + 2 * edge_values + row_values};
  const auto m = static_cast<std::size_t>(order);
  for (std::size_t b = 0; b < blocks_; ++b) {
    const double* sectoral = sectoral_.data() + (m * blocks_ + b) * edge_values;
    const double* squares = squares_.data() + b * edge_values;
    block.cosines = cosines_.data() + b * edge_values;
    block.even = even.data() + b * row_values;
    block.odd = odd.data() + b * row_values;
    for (std::size_t i = 0; i < edge_values; ++i) block.at_edges[i] = squares[i] * sectoral[i];
    std::fill_n(block.at_edges_before, edge_values, 0.0);
    std::copy_n(integrals_.data() + (m * blocks_ + b) * row_values, row_values, block.integrals);
    std::fill_n(block.integrals_before, row_values, 0.0);
    analyse_block(recursion, order, block, sums);
  }
  std::copy_n(sums.begin(), coefficients.size(), coefficients.begin());
}

LatitudeTransform::LatitudeTransform(int height, int degree) : height_(height), degree_(degree) {
  const std::size_t lanes = row_lanes();
  const std::size_t count = whole_blocks(static_cast<std::size_t>(rows()), lanes) * lanes;
  std::vector<double> sines;
  for (std::size_t row = 0; row < count; ++row) {
    const double t = std::min((static_cast<double>(row) + 0.5) / height, 0.5);
    cosines_.push_back(std::sin(kPi * (0.5 - t)));
    sines.push_back(sin_theta(t));
  }
  sectoral_ = sectoral_values(sines, degree);
}

void LatitudeTransform::synthesise(const LegendreRecursion& recursion, int order,
                                   std::span<const double> coefficients, std::span<double> even,
                                   std::span<double> odd) const {
  std::vector<double> whole(coefficients.begin(), coefficients.end());
  whole.resize((coefficients.size() / kParts + 1) / 2 * 2 * kParts);
  const std::size_t lanes = row_lanes();
  const double* sectoral = sectoral_.data() + static_cast<std::size_t>(order) * padded_rows();
  for (std::size_t row = 0; row < padded_rows(); row += lanes) {
    synthesise_rows(recursion, whole,
                    {padded_rows(), cosines_.data() + row, sectoral + row, even.data() + row,
                     odd.data() + row});
  }
}

}  // namespace lightproof
