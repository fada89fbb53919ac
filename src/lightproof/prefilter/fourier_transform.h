// The discrete Fourier transform of any length, over kissfft.
#pragma once

#include <complex>
#include <cstddef>
#include <memory>
#include <span>

namespace lightproof {

/// Sums over all n of in[n] e^(-2 pi i n k/size), or of e^(+…) if inverse; without a factor.
/// Lengths of other prime factors than 2, 3 and 5 go through a convolution of a power of two
/// (Bluestein 1970): kissfft's own way takes a time that grows with the square of a factor, and is
/// not for several threads at once.
class FourierTransform {
 public:
  FourierTransform(std::size_t size, bool inverse);
  ~FourierTransform();
  FourierTransform(const FourierTransform&) = delete;
  FourierTransform& operator=(const FourierTransform&) = delete;

  /// Both spans have the transform's size, and are not the same. For any number of threads.
  void operator()(std::span<const std::complex<double>> in,
                  std::span<std::complex<double>> out) const;

 private:
  struct Plan;
  std::unique_ptr<Plan> plan_;
};

/// A product without the cases of infinities that std::complex looks after.
inline std::complex<double> finite_product(std::complex<double> a, std::complex<double> b) {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

}  // namespace lightproof
