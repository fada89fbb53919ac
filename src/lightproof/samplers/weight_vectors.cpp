#include "lightproof/samplers/weight_vectors.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lightproof/samplers/weight_vectors.cpp"
#include <hwy/foreach_target.h>
// Highway asks for this order.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace lightproof::HWY_NAMESPACE {
namespace {

// Each does whole vectors from the front, and returns how many numbers that were.

#if HWY_TARGET == HWY_SCALAR

Weighed weigh_front(std::span<const Rgb> /*texels*/, LuminanceWeights /*luminance*/,
                    double /*area*/, std::span<double> /*weights*/) {
  return {0, true};
}
std::size_t sum_front(std::span<const double> /*weights*/, WeightSums::Lanes& /*lanes*/) {
  return 0;
}
std::size_t to_fixed_point_front(std::span<const double> /*weights*/, const FixedPoint& /*form*/,
                                 std::int64_t* /*fixed*/) {
  return 0;
}
std::size_t balance_front(std::span<const std::uint64_t> /*numbers*/, std::uint64_t /*full*/,
                          Balance& /*balance*/) {
  return 0;
}

#else

namespace hn = hwy::HWY_NAMESPACE;

using Numbers = hn::ScalableTag<double>;
using Int64Tag = hn::ScalableTag<std::int64_t>;
using WholeUnsigned = hn::ScalableTag<std::uint64_t>;
using Number = hn::Vec<Numbers>;
using Floats = hn::Vec<hn::Half<hn::ScalableTag<float> > >;

/// What turns a texel into its weight.
struct Weigher {
  Number red;
  Number green;
  Number blue;
  Number area;

  HWY_INLINE Number operator()(Floats r, Floats g, Floats b) const {
    const Numbers d;
    const Number reds = hn::Mul(red, hn::PromoteTo(d, r));
    const Number greens = hn::Mul(green, hn::PromoteTo(d, g));
    const Number blues = hn::Mul(blue, hn::PromoteTo(d, b));
    return hn::Mul(area, hn::Add(hn::Add(reds, greens), blues));
  }
};

/// Texels that are asked for before they are read: the processor itself reads ahead to the end of a
/// page only.
constexpr std::size_t kAhead = 2048;

/// Asks for the lines of two vectors of texels.
HWY_INLINE void fetch(const Rgb* texels) {
  constexpr std::size_t kLine = 64;
  const char* bytes = reinterpret_cast<const char*>(texels);
  for (std::size_t at = 0; at < 2 * hn::MaxLanes(Numbers()) * sizeof(Rgb); at += kLine) {
    __builtin_prefetch(bytes + at);
  }
}

Weighed weigh_front(std::span<const Rgb> texels, LuminanceWeights luminance, double area,
                    std::span<double> weights) {
  const Numbers d;
  const hn::ScalableTag<float> floats;
  const hn::Half<decltype(floats)> half;
  const std::size_t lanes = hn::Lanes(d);
  const Weigher weigh = {hn::Set(d, luminance.red), hn::Set(d, luminance.green),
                         hn::Set(d, luminance.blue), hn::Set(d, area)};
  const auto zero = hn::Zero(d);
  const auto infinite = hn::Set(d, std::numeric_limits<double>::infinity());
  // Neither holds for what is not a number.
  const auto is_possible = [&](Number weight) {
    return hn::And(hn::Ge(weight, zero), hn::Lt(weight, infinite));
  };
  auto possible = hn::Eq(zero, zero);
  std::size_t done = 0;
  for (; done + 2 * lanes <= weights.size(); done += 2 * lanes) {
    if (done + kAhead + 2 * hn::MaxLanes(d) <= texels.size()) fetch(&texels[done + kAhead]);
    hn::Vec<decltype(floats)> r;
    hn::Vec<decltype(floats)> g;
    hn::Vec<decltype(floats)> b;
    static_assert(sizeof(Rgb) == 3 * sizeof(float));
    hn::LoadInterleaved3(floats, &texels[done].r, r, g, b);
    const Number low =
        weigh(hn::LowerHalf(half, r), hn::LowerHalf(half, g), hn::LowerHalf(half, b));
    const Number high =
        weigh(hn::UpperHalf(half, r), hn::UpperHalf(half, g), hn::UpperHalf(half, b));
    possible = hn::And(possible, hn::And(is_possible(low), is_possible(high)));
    hn::StoreU(low, d, &weights[done]);
    hn::StoreU(high, d, &weights[done + lanes]);
  }
  return {done, hn::AllTrue(d, possible)};
}

std::size_t sum_front(std::span<const double> weights, WeightSums::Lanes& lanes) {
  const Numbers numbers;
  const Int64Tag whole;
  constexpr std::size_t kVectors = WeightSums::kLanes / hn::MaxLanes(Numbers());
  const auto zero = hn::Zero(numbers);
  const auto none = hn::Set(numbers, std::numeric_limits<double>::infinity());
  hn::Vec<Numbers> sum[kVectors];
  hn::Vec<Numbers> least[kVectors];
  hn::Vec<Int64Tag> positive[kVectors];
  for (std::size_t k = 0; k < kVectors; ++k) {
    sum[k] = hn::LoadU(numbers, lanes.sum.data() + k * hn::Lanes(numbers));
    least[k] = hn::LoadU(numbers, lanes.least_positive.data() + k * hn::Lanes(numbers));
    positive[k] = hn::LoadU(whole, lanes.positive.data() + k * hn::Lanes(numbers));
  }
  std::size_t done = 0;
  for (; done + WeightSums::kLanes <= weights.size(); done += WeightSums::kLanes) {
    for (std::size_t k = 0; k < kVectors; ++k) {
      const auto weight = hn::LoadU(numbers, weights.data() + done + k * hn::Lanes(numbers));
      const auto any = hn::Gt(weight, zero);
      sum[k] = hn::Add(sum[k], weight);
      least[k] = hn::Min(least[k], hn::IfThenElse(any, weight, none));
      positive[k] = hn::Sub(positive[k], hn::VecFromMask(whole, hn::RebindMask(whole, any)));
    }
  }
  for (std::size_t k = 0; k < kVectors; ++k) {
    hn::StoreU(sum[k], numbers, lanes.sum.data() + k * hn::Lanes(numbers));
    hn::StoreU(least[k], numbers, lanes.least_positive.data() + k * hn::Lanes(numbers));
    hn::StoreU(positive[k], whole, lanes.positive.data() + k * hn::Lanes(numbers));
  }
  return done;
}

std::size_t to_fixed_point_front(std::span<const double> weights, const FixedPoint& form,
                                 std::int64_t* fixed) {
  const Numbers numbers;
  const Int64Tag whole;
  const auto factor = hn::Set(numbers, form.scale);
  const auto half = hn::Set(numbers, 0.5);
  const auto least = hn::Set(whole, form.least);
  const auto more = hn::Set(whole, form.more);
  std::size_t done = 0;
  for (; done + hn::Lanes(numbers) <= weights.size(); done += hn::Lanes(numbers)) {
    const auto weight = hn::LoadU(numbers, weights.data() + done);
    const auto any = hn::RebindMask(whole, hn::Gt(weight, hn::Zero(numbers)));
    const auto rounded = hn::ConvertTo(whole, hn::Add(hn::Mul(factor, weight), half));
    const auto raised = hn::Add(hn::Max(rounded, least), more);
    hn::StoreU(hn::IfThenElseZero(any, raised), whole, fixed + done);
  }
  return done;
}

std::size_t balance_front(std::span<const std::uint64_t> numbers, std::uint64_t full,
                          Balance& balance) {
  const Int64Tag whole;
  const auto one = hn::Set(whole, static_cast<std::int64_t>(full));
  auto lack = hn::Zero(whole);
  auto excess = hn::Zero(whole);
  std::size_t done = 0;
  for (; done + hn::Lanes(whole) <= numbers.size(); done += hn::Lanes(whole)) {
    const auto number = hn::BitCast(whole, hn::LoadU(WholeUnsigned(), numbers.data() + done));
    const auto least = hn::Min(number, one);
    lack = hn::Add(lack, hn::Sub(one, least));
    excess = hn::Add(excess, hn::Sub(number, least));
  }
  balance.lack += static_cast<std::uint64_t>(hn::GetLane(hn::SumOfLanes(whole, lack)));
  balance.excess += static_cast<std::uint64_t>(hn::GetLane(hn::SumOfLanes(whole, excess)));
  return done;
}

#endif

}  // namespace
}  // namespace lightproof::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lightproof {
namespace {

HWY_EXPORT(weigh_front);
HWY_EXPORT(sum_front);
HWY_EXPORT(to_fixed_point_front);
HWY_EXPORT(balance_front);

/// The combination in the order of a vector of eight.
template <class T, class Combine>
T combined(const std::array<T, WeightSums::kLanes>& lanes, const Combine& combine) {
  return combine(combine(combine(lanes[0], lanes[1]), combine(lanes[2], lanes[3])),
                 combine(combine(lanes[4], lanes[5]), combine(lanes[6], lanes[7])));
}

}  // namespace

Weighed weigh(std::span<const Rgb> texels, LuminanceWeights luminance, double area,
              std::span<double> weights) {
  Weighed done = HWY_DYNAMIC_DISPATCH(weigh_front)(texels, luminance, area, weights);
  for (std::size_t i = done.by_vectors; i < weights.size(); ++i) {
    weights[i] = area * luminance_of(texels[i], luminance);
    done.are_possible = done.are_possible && weights[i] >= 0.0 && std::isfinite(weights[i]);
  }
  return done;
}

WeightSums::WeightSums() : lanes_{} {
  lanes_.least_positive.fill(std::numeric_limits<double>::infinity());
}

std::size_t WeightSums::add(std::span<const double> weights) {
  const std::size_t by_vectors = HWY_DYNAMIC_DISPATCH(sum_front)(weights, lanes_);
  for (std::size_t i = by_vectors; i < weights.size(); ++i) {
    const std::size_t lane = i % kLanes;
    lanes_.sum[lane] += weights[i];
    if (!(weights[i] > 0.0)) continue;
    lanes_.least_positive[lane] = std::min(lanes_.least_positive[lane], weights[i]);
    ++lanes_.positive[lane];
  }
  return by_vectors;
}

double WeightSums::sum() const { return combined(lanes_.sum, std::plus<>()); }

std::size_t WeightSums::positive() const {
  return static_cast<std::size_t>(combined(lanes_.positive, std::plus<>()));
}

double WeightSums::least_positive() const {
  return combined(lanes_.least_positive, [](double a, double b) { return std::min(a, b); });
}

std::size_t to_fixed_point(std::span<const double> weights, const FixedPoint& form,
                           std::span<std::int64_t> fixed) {
  const std::size_t by_vectors =
      HWY_DYNAMIC_DISPATCH(to_fixed_point_front)(weights, form, fixed.data());
  for (std::size_t i = by_vectors; i < weights.size(); ++i) {
    const auto rounded = static_cast<std::int64_t>(std::floor(form.scale * weights[i] + 0.5));
    fixed[i] = weights[i] > 0.0 ? std::max(rounded, form.least) + form.more : 0;
  }
  return by_vectors;
}

std::size_t Balance::add(std::span<const std::uint64_t> numbers, std::uint64_t full) {
  const std::size_t by_vectors = HWY_DYNAMIC_DISPATCH(balance_front)(numbers, full, *this);
  for (std::size_t i = by_vectors; i < numbers.size(); ++i) {
    const std::uint64_t least = std::min(numbers[i], full);
    lack += full - least;
    excess += numbers[i] - least;
  }
  return by_vectors;
}

Balance balance_of(std::span<const std::uint64_t> numbers, std::uint64_t full) {
  Balance balance{0, 0};
  balance.add(numbers, full);
  return balance;
}

}  // namespace lightproof
#endif
