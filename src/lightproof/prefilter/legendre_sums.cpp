#include "lightproof/prefilter/legendre_sums.h"

#include <algorithm>
#include <cstddef>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lightproof/prefilter/legendre_sums.cpp"
#include <hwy/foreach_target.h>
// Highway asks for this order.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace lightproof::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// Vectors of nodes that go through the degrees together: enough to hide that each degree waits for
/// the one before.
constexpr std::size_t kTogether = 4;

/// Adds the terms of kTogether vectors of nodes to sums[0 … degree].
HWY_INLINE void add_nodes(const double* cosines, const double* weights, std::span<double> sums) {
  const hn::ScalableTag<double> d;
  using Number = hn::Vec<decltype(d)>;
  Number x[kTogether];
  Number before[kTogether];  // P_(l-1), each with its weight
  Number now[kTogether];     // P_l
  for (std::size_t v = 0; v < kTogether; ++v) {
    x[v] = hn::LoadU(d, cosines + v * hn::Lanes(d));
    before[v] = hn::Zero(d);
    now[v] = hn::LoadU(d, weights + v * hn::Lanes(d));
  }
  for (std::size_t l = 0; l < sums.size(); ++l) {
    sums[l] +=
        hn::GetLane(hn::SumOfLanes(d, hn::Add(hn::Add(now[0], now[1]), hn::Add(now[2], now[3]))));
    // (l+1) P_(l+1) = (2l+1) x P_l - l P_(l-1)
    const auto degree = static_cast<double>(l);
    const auto forward = hn::Set(d, (2.0 * degree + 1.0) / (degree + 1.0));
    const auto back = hn::Set(d, degree / (degree + 1.0));
    for (std::size_t v = 0; v < kTogether; ++v) {
      const Number next = hn::NegMulAdd(back, before[v], hn::Mul(hn::Mul(forward, x[v]), now[v]));
      before[v] = now[v];
      now[v] = next;
    }
  }
}

std::size_t nodes_together() { return kTogether * hn::Lanes(hn::ScalableTag<double>()); }

void add_all(std::span<const double> cosines, std::span<const double> weights,
             std::span<double> sums) {
  for (std::size_t i = 0; i < cosines.size(); i += nodes_together()) {
    add_nodes(cosines.data() + i, weights.data() + i, sums);
  }
}

}  // namespace
}  // namespace lightproof::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lightproof {
namespace {

HWY_EXPORT(nodes_together);
HWY_EXPORT(add_all);

/// The values, filled up with zeros to a multiple of `block`.
std::vector<double> padded(std::span<const double> values, std::size_t block) {
  std::vector<double> copy(values.begin(), values.end());
  copy.resize((values.size() + block - 1) / block * block);
  return copy;
}

}  // namespace

std::vector<double> legendre_sums(std::span<const double> cosines, std::span<const double> weights,
                                  int degree) {
  const std::size_t block = HWY_DYNAMIC_DISPATCH(nodes_together)();
  std::vector<double> sums(static_cast<std::size_t>(degree) + 1);
  HWY_DYNAMIC_DISPATCH(add_all)(padded(cosines, block), padded(weights, block), sums);
  return sums;
}

}  // namespace lightproof
#endif
