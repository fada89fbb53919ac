#include "lightproof/prefilter/fourier_transform.h"

#include <bit>
#include <cstdint>
#include <kissfft/kissfft.hh>
#include <optional>
#include <vector>

#include "lightproof/core/measure.h"

namespace lightproof {
namespace {

using Complex = std::complex<double>;

bool has_small_factors(std::size_t size) {
  for (const std::size_t factor : {2U, 3U, 5U}) {
    while (size % factor == 0) size /= factor;
  }
  return size == 1;
}

/// A transform of any length as a convolution with the chirp e^(pi i n^2/size), by transforms of a
/// power of two.
class ChirpTransform {
 public:
  ChirpTransform(std::size_t size, bool inverse)
      : padded_(std::bit_ceil(2 * size - 1)),
        forwards_(padded_, false),
        backwards_(padded_, true),
        spectrum_(padded_) {
    for (std::uint64_t n = 0; n < size; ++n) {
      // n^2 modulo 2 size, in whole numbers: the phase loses nothing.
      const double phase =
          kPi * static_cast<double>(n * n % (2 * size)) / static_cast<double>(size);
      chirp_.push_back(std::polar(1.0, inverse ? phase : -phase));
    }
    std::vector<Complex> mirrored(padded_);
    for (std::size_t n = 0; n < size; ++n) {
      mirrored[n] = mirrored[(padded_ - n) % padded_] =
          std::conj(chirp_[n]) / static_cast<double>(padded_);
    }
    forwards_.transform(mirrored.data(), spectrum_.data());
  }

  void operator()(std::span<const Complex> in, std::span<Complex> out) const {
    std::vector<Complex> values(padded_);
    std::vector<Complex> transformed(padded_);
    for (std::size_t n = 0; n < in.size(); ++n) values[n] = finite_product(in[n], chirp_[n]);
    forwards_.transform(values.data(), transformed.data());
    for (std::size_t k = 0; k < padded_; ++k) {
      transformed[k] = finite_product(transformed[k], spectrum_[k]);
    }
    backwards_.transform(transformed.data(), values.data());
    for (std::size_t k = 0; k < out.size(); ++k) out[k] = finite_product(values[k], chirp_[k]);
  }

 private:
  std::size_t padded_;
  kissfft<double> forwards_;
  kissfft<double> backwards_;
  std::vector<Complex> spectrum_;  ///< of the chirp
  std::vector<Complex> chirp_;
};

}  // namespace

struct FourierTransform::Plan {
  std::optional<kissfft<double>> direct;
  std::optional<ChirpTransform> chirp;
};

FourierTransform::FourierTransform(std::size_t size, bool inverse)
    : plan_(std::make_unique<Plan>()) {
  if (has_small_factors(size)) {
    plan_->direct.emplace(size, inverse);
  } else {
    plan_->chirp.emplace(size, inverse);
  }
}

FourierTransform::~FourierTransform() = default;

void FourierTransform::operator()(std::span<const Complex> in, std::span<Complex> out) const {
  if (plan_->direct) {
    plan_->direct->transform(in.data(), out.data());
  } else {
    (*plan_->chirp)(in, out);
  }
}

}  // namespace lightproof
