#include "lightproof/prefilter/zonal_convolution.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <complex>

#include "lightproof/core/huge_pages.h"
#include "lightproof/core/measure.h"
#include "lightproof/core/parallel.h"
#include "lightproof/prefilter/fourier_transform.h"
#include "lightproof/prefilter/legendre_transform.h"

namespace lightproof {
namespace {

using Complex = std::complex<double>;
constexpr int kChannels = 3;

/// Folded rows of all orders: [m][even, odd][part][padded row].
class FoldedOrders {
 public:
  FoldedOrders(int degree, std::size_t padded_rows)
      : padded_rows_(padded_rows),
        values_((static_cast<std::size_t>(degree) + 1) * 2 * kParts * padded_rows) {}

  std::span<double> even(int order) { return part_of(order, 0); }
  std::span<double> odd(int order) { return part_of(order, 1); }
  std::span<const double> even(int order) const { return part_of(order, 0); }
  std::span<const double> odd(int order) const { return part_of(order, 1); }

 private:
  std::size_t begin(int order, std::size_t parity) const {
    return (2 * static_cast<std::size_t>(order) + parity) * kParts * padded_rows_;
  }
  std::span<double> part_of(int order, std::size_t parity) {
    return std::span(values_).subspan(begin(order, parity), kParts * padded_rows_);
  }
  std::span<const double> part_of(int order, std::size_t parity) const {
    return std::span(values_).subspan(begin(order, parity), kParts * padded_rows_);
  }

  std::size_t padded_rows_;
  TableVector<double> values_;
};

double value_of(Rgb rgb, int channel) { return static_cast<double>(rgb[channel]); }

/// For each order the integral of e^(-im phi) over a texel of column 0.
std::vector<Complex> column_integrals(int width, int degree) {
  std::vector<Complex> integrals;
  for (int m = 0; m <= degree; ++m) {
    const double half = kPi * m / width;
    const double size = m == 0 ? 2.0 * kPi / width : 2.0 * std::sin(half) / m;
    integrals.push_back(std::polar(size, -half));
  }
  return integrals;
}

/// Padded rows that a task does together: a line of the cache of each part.
constexpr std::size_t kRowsAtOnce = 8;

/// The Fourier integrals over longitude of the rows of a map, folded at the equator. Two real rows
/// go through one complex transform.
class RowAnalysis {
 public:
  RowAnalysis(const Grid<Rgb>& map, const BandTransform& bands)
      : map_(map),
        bands_(bands),
        transform_(static_cast<std::size_t>(map.extent().width), false),
        columns_(column_integrals(map.extent().width, bands.degree())) {}

  /// Sets what the padded rows from `first` on hold of all orders.
  void operator()(std::size_t first, FoldedOrders& orders) const {
    const auto width = static_cast<std::size_t>(map_.extent().width);
    const std::size_t count = std::min(kRowsAtOnce, bands_.padded_rows() - first);
    std::vector<Complex> spectra(count * width);
    for (int channel = 0; channel < kChannels; ++channel) {
      for (std::size_t i = 0; i < count; ++i) {
        transform_pair(bands_.row_of(first + i), channel,
                       std::span(spectra).subspan(i * width, width));
      }
      const std::size_t at = 2 * static_cast<std::size_t>(channel) * bands_.padded_rows() + first;
      for (std::size_t m = 0; m < columns_.size(); ++m) {
        const auto even = orders.even(static_cast<int>(m)).subspan(at);
        const auto odd = orders.odd(static_cast<int>(m)).subspan(at);
        fold(spectra, m, even, odd);
      }
    }
  }

 private:
  /// The transform of row `row` plus i times that of the row opposite the equator; 0 of the
  /// padding.
  void transform_pair(int row, int channel, std::span<Complex> spectrum) const {
    const auto width = static_cast<std::size_t>(map_.extent().width);
    if (row >= bands_.rows()) {
      std::fill(spectrum.begin(), spectrum.end(), Complex());
      return;
    }
    const auto lower = map_.row(row);
    const auto upper = map_.row(map_.extent().height - 1 - row);
    std::vector<Complex> rows(width);
    for (std::size_t x = 0; x < width; ++x) {
      rows[x] = {value_of(lower[x], channel), value_of(upper[x], channel)};
    }
    transform_(rows, spectrum);
  }

  void fold(std::span<const Complex> spectra, std::size_t m, std::span<double> even,
            std::span<double> odd) const {
    const auto width = static_cast<std::size_t>(map_.extent().width);
    const std::size_t at = m % width;
    const std::size_t opposite = (width - at) % width;
    for (std::size_t i = 0; i * width < spectra.size(); ++i) {
      const Complex z = spectra[i * width + at];
      const Complex mirrored = std::conj(spectra[i * width + opposite]);
      // The spectra of the two rows are (z + mirrored)/2 and (z - mirrored)/2i.
      const Complex sum = 0.5 * (z + mirrored);
      const Complex difference = {0.5 * (z - mirrored).imag(), -0.5 * (z - mirrored).real()};
      const Complex of_even = finite_product(sum + difference, columns_[m]);
      const Complex of_odd = finite_product(sum - difference, columns_[m]);
      even[i] = of_even.real();
      even[i + bands_.padded_rows()] = of_even.imag();
      odd[i] = of_odd.real();
      odd[i + bands_.padded_rows()] = of_odd.imag();
    }
  }

  const Grid<Rgb>& map_;
  const BandTransform& bands_;
  FourierTransform transform_;
  std::vector<Complex> columns_;
};

/// The rows of one output from their Fourier series.
class RowSynthesis {
 public:
  RowSynthesis(Grid<Rgb>& output, const LatitudeTransform& latitudes)
      : output_(output),
        latitudes_(latitudes),
        transform_(static_cast<std::size_t>(output.extent().width), true) {
    for (int m = 0; m <= latitudes.degree(); ++m) {
      phases_.push_back(std::polar(1.0, kPi * m / output.extent().width));
    }
  }

  /// Writes the padded rows from `first` on, and those opposite the equator.
  void operator()(std::size_t first, const FoldedOrders& orders) const {
    const auto width = static_cast<std::size_t>(output_.extent().width);
    const std::size_t count =
        std::min(kRowsAtOnce, static_cast<std::size_t>(latitudes_.rows()) - first);
    std::vector<Complex> spectra(count * width);
    for (int channel = 0; channel < kChannels; ++channel) {
      std::fill(spectra.begin(), spectra.end(), Complex());
      const std::size_t at =
          2 * static_cast<std::size_t>(channel) * latitudes_.padded_rows() + first;
      for (std::size_t m = 0; m < phases_.size(); ++m) {
        unfold(orders.even(static_cast<int>(m)).subspan(at),
               orders.odd(static_cast<int>(m)).subspan(at), m, spectra);
      }
      for (std::size_t i = 0; i < count; ++i) {
        write_pair(static_cast<int>(first + i), channel,
                   std::span(spectra).subspan(i * width, width));
      }
    }
  }

 private:
  /// Adds order m, and -m, to the spectra of row plus i times the row opposite the equator.
  void unfold(std::span<const double> even, std::span<const double> odd, std::size_t m,
              std::span<Complex> spectra) const {
    const auto width = static_cast<std::size_t>(output_.extent().width);
    const std::size_t at = m % width;
    const std::size_t opposite = (width - at) % width;
    const std::size_t imaginary = latitudes_.padded_rows();
    for (std::size_t i = 0; i * width < spectra.size(); ++i) {
      const Complex of_even = {even[i], even[i + imaginary]};
      const Complex of_odd = {odd[i], odd[i + imaginary]};
      const Complex low = finite_product(of_even + of_odd, phases_[m]);
      const Complex high = finite_product(of_even - of_odd, phases_[m]);
      spectra[i * width + at] += Complex(low.real() - high.imag(), low.imag() + high.real());
      if (m == 0) continue;
      spectra[i * width + opposite] += Complex(low.real() + high.imag(), high.real() - low.imag());
    }
  }

  void write_pair(int row, int channel, std::span<const Complex> spectrum) const {
    const auto lower = output_.row(row);
    const auto upper = output_.row(output_.extent().height - 1 - row);
    std::vector<Complex> rows(lower.size());
    transform_(spectrum, rows);
    for (std::size_t x = 0; x < rows.size(); ++x) {
      lower[x][channel] = static_cast<float>(rows[x].real());
      upper[x][channel] = static_cast<float>(rows[x].imag());
    }
  }

  Grid<Rgb>& output_;
  const LatitudeTransform& latitudes_;
  FourierTransform transform_;
  std::vector<Complex> phases_;
};

/// One filter's own transform and what it has of all orders.
struct Output {
  const ZonalFilter* filter;
  LatitudeTransform transform;
  FoldedOrders orders;

  explicit Output(const ZonalFilter& of)
      : filter(&of),
        transform(of.extent.height, static_cast<int>(of.factors.size()) - 1),
        orders(transform.degree(), transform.padded_rows()) {}

  void synthesise(const LegendreRecursion& recursion, int order,
                  std::span<const double> coefficients) {
    if (order > transform.degree()) return;
    const auto degrees = static_cast<std::size_t>(transform.degree() - order) + 1;
    const auto kept = coefficients.first(degrees * kParts);
    std::vector<double> filtered(kept.begin(), kept.end());
    for (std::size_t i = 0; i < filtered.size(); ++i) {
      filtered[i] *= filter->factors[static_cast<std::size_t>(order) + i / kParts];
    }
    transform.synthesise(recursion, order, filtered, orders.even(order), orders.odd(order));
  }

  Grid<Rgb> grid() const {
    auto output = Grid<Rgb>::without_values(filter->extent);
    const RowSynthesis synthesis(output, transform);
    parallel_for(chunks_of(static_cast<std::size_t>(transform.rows()), kRowsAtOnce),
                 [&](std::size_t chunk) { synthesis(chunk * kRowsAtOnce, orders); });
    return output;
  }
};

}  // namespace

std::vector<Grid<Rgb>> convolve(const Grid<Rgb>& map, std::span<const ZonalFilter> filters) {
  std::size_t factors = 1;
  for (const ZonalFilter& filter : filters) factors = std::max(factors, filter.factors.size());
  const int degree = static_cast<int>(factors) - 1;
  assert(degree <= kLargestDegree);
  const BandTransform bands(map.extent().height, degree);
  FoldedOrders rows(degree, bands.padded_rows());
  const RowAnalysis analysis(map, bands);
  parallel_for(chunks_of(bands.padded_rows(), kRowsAtOnce),
               [&](std::size_t chunk) { analysis(chunk * kRowsAtOnce, rows); });
  std::vector<Output> outputs;
  for (const ZonalFilter& filter : filters) outputs.emplace_back(filter);
  parallel_for(factors, [&](std::size_t m) {
    const int order = static_cast<int>(m);
    const LegendreRecursion recursion(order, degree);
    std::vector<double> coefficients((factors - m) * kParts);
    bands.analyse(recursion, order, rows.even(order), rows.odd(order), coefficients);
    for (Output& output : outputs) output.synthesise(recursion, order, coefficients);
  });
  std::vector<Grid<Rgb>> grids;
  for (const Output& output : outputs) grids.push_back(output.grid());
  return grids;
}

}  // namespace lightproof
