#include "lightproof/prefilter/legendre_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lightproof/prefilter/legendre_kernels.cpp"
#include <hwy/foreach_target.h>
// Highway asks for this order.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace lightproof::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::ScalableTag<double>;
using Number = hn::Vec<Tag>;

std::size_t row_lanes() { return hn::Lanes(Tag()); }

/// The factors that lead from l to l + 1.
struct Step {
  Number forward;
  Number back;
  Number integral_forward;
  Number integral_back;

  Step(const LegendreRecursion& recursion, int order, std::size_t from) {
    const Tag d;
    const double l = order + static_cast<double>(from);
    const double a = recursion.forward[from];
    const double b = recursion.back[from];
    forward = hn::Set(d, a);
    back = hn::Set(d, b);
    integral_forward = hn::Set(d, a / (l + 2.0));
    integral_back = hn::Set(d, b * (l - 1.0) / (l + 2.0));
  }

  HWY_INLINE Number edges(Number x, Number now, Number before) const {
    return hn::MulSub(hn::Mul(forward, x), now, hn::Mul(back, before));
  }
  /// d/dx of (1 - x^2) P_l is a sum of P_(l-1) and P_(l+1): so are the integrals.
  HWY_INLINE Number bands(Number upper, Number lower, Number before) const {
    return hn::MulAdd(integral_forward, hn::Sub(lower, upper), hn::Mul(integral_back, before));
  }
};

/// Adds two degrees, l and l + 1, and moves the states on by two.
HWY_INLINE void add_two_degrees(const LegendreBlock& block, const Step& first, const Step& second,
                                double* coefficients) {
  const Tag d;
  const std::size_t lanes = hn::Lanes(d);
  Number even[kParts];
  Number odd[kParts];
  for (std::size_t part = 0; part < kParts; ++part) even[part] = odd[part] = hn::Zero(d);
  Number upper_now = hn::Zero(d);
  Number upper_next = hn::Zero(d);
  for (std::size_t edge = 0; edge <= block.vectors; ++edge) {
    const std::size_t at = edge * lanes;
    const Number x = hn::Load(d, block.cosines + at);
    const Number now = hn::Load(d, block.at_edges + at);
    const Number next = first.edges(x, now, hn::Load(d, block.at_edges_before + at));
    hn::Store(next, d, block.at_edges_before + at);
    hn::Store(second.edges(x, next, now), d, block.at_edges + at);
    if (edge > 0) {
      const std::size_t row = at - lanes;
      const Number band = hn::Load(d, block.integrals + row);
      const Number before = hn::Load(d, block.integrals_before + row);
      const Number band_next = first.bands(upper_now, now, before);
      hn::Store(band_next, d, block.integrals_before + row);
      hn::Store(second.bands(upper_next, next, band), d, block.integrals + row);
      for (std::size_t part = 0; part < kParts; ++part) {
        const std::size_t value = part * block.padded_rows + row;
        even[part] = hn::MulAdd(band, hn::Load(d, block.even + value), even[part]);
        odd[part] = hn::MulAdd(band_next, hn::Load(d, block.odd + value), odd[part]);
      }
    }
    upper_now = now;
    upper_next = next;
  }
  for (std::size_t part = 0; part < kParts; ++part) {
    coefficients[part] += hn::GetLane(hn::SumOfLanes(d, even[part]));
    coefficients[kParts + part] += hn::GetLane(hn::SumOfLanes(d, odd[part]));
  }
}

/// `coefficients` has room for an even number of degrees.
void analyse_block(const LegendreRecursion& recursion, int order, const LegendreBlock& block,
                   std::span<double> coefficients) {
  for (std::size_t l = 0; l * kParts < coefficients.size(); l += 2) {
    add_two_degrees(block, Step(recursion, order, l), Step(recursion, order, l + 1),
                    coefficients.data() + l * kParts);
  }
}

/// The rows of one vector, all degrees. `coefficients` holds an even number of degrees.
void synthesise_rows(const LegendreRecursion& recursion, std::span<const double> coefficients,
                     const LatitudeRows& rows) {
  const Tag d;
  Number even[kParts];
  Number odd[kParts];
  for (std::size_t part = 0; part < kParts; ++part) even[part] = odd[part] = hn::Zero(d);
  const Number x = hn::Load(d, rows.cosines);
  Number now = hn::Load(d, rows.sectoral);
  Number before = hn::Zero(d);
  const double* c = coefficients.data();
  for (std::size_t l = 0; l * kParts < coefficients.size(); l += 2, c += 2 * kParts) {
    const Number next = hn::MulSub(hn::Mul(hn::Set(d, recursion.forward[l]), x), now,
                                   hn::Mul(hn::Set(d, recursion.back[l]), before));
    for (std::size_t part = 0; part < kParts; ++part) {
      even[part] = hn::MulAdd(now, hn::Set(d, c[part]), even[part]);
      odd[part] = hn::MulAdd(next, hn::Set(d, c[kParts + part]), odd[part]);
    }
    before = next;
    now = hn::MulSub(hn::Mul(hn::Set(d, recursion.forward[l + 1]), x), next,
                     hn::Mul(hn::Set(d, recursion.back[l + 1]), now));
  }
  for (std::size_t part = 0; part < kParts; ++part) {
    hn::Store(even[part], d, rows.even + part * rows.padded_rows);
    hn::Store(odd[part], d, rows.odd + part * rows.padded_rows);
  }
}

}  // namespace
}  // namespace lightproof::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lightproof {
namespace {

HWY_EXPORT(row_lanes);
HWY_EXPORT(analyse_block);
HWY_EXPORT(synthesise_rows);

}  // namespace

std::size_t row_lanes() { return HWY_DYNAMIC_DISPATCH(row_lanes)(); }

void analyse_block(const LegendreRecursion& recursion, int order, const LegendreBlock& block,
                   std::span<double> coefficients) {
  HWY_DYNAMIC_DISPATCH(analyse_block)(recursion, order, block, coefficients);
}

void synthesise_rows(const LegendreRecursion& recursion, std::span<const double> coefficients,
                     const LatitudeRows& rows) {
  HWY_DYNAMIC_DISPATCH(synthesise_rows)(recursion, coefficients, rows);
}

}  // namespace lightproof
#endif
