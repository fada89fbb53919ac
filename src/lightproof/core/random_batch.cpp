#include "lightproof/core/random_batch.h"

#include <algorithm>
#include <array>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lightproof/core/random_batch.cpp"
#include <hwy/foreach_target.h>
// Highway asks for this order.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace lightproof::HWY_NAMESPACE {
namespace {

#if HWY_TARGET == HWY_SCALAR

std::size_t fill(std::uint64_t /*key*/, std::uint64_t /*substream*/, std::uint64_t /*first*/,
                 std::span<double> /*s*/, std::span<double> /*t*/) {
  return 0;
}

#else

namespace hn = hwy::HWY_NAMESPACE;

using Wide = hn::ScalableTag<std::uint64_t>;
using Words = hn::Vec<Wide>;

/// Philox4x32-10, a counter in each lane. Only the low half of every lane counts; what the products
/// leave in the upper halves is never read.
struct Philox {
  Words words[4];

  static Words product(Words a, std::uint32_t b) {
    const hn::Repartition<std::uint32_t, Wide> narrow;
    return hn::MulEven(hn::BitCast(narrow, a),
                       hn::BitCast(narrow, hn::Set(Wide(), std::uint64_t{b})));
  }

  HWY_INLINE void round(std::uint32_t key0, std::uint32_t key1) {
    const Words p0 = product(words[0], PHILOX_M4x32_0);
    const Words p1 = product(words[2], PHILOX_M4x32_1);
    words[0] = hn::Xor3(hn::ShiftRight<32>(p1), words[1], hn::Set(Wide(), std::uint64_t{key0}));
    words[2] = hn::Xor3(hn::ShiftRight<32>(p0), words[3], hn::Set(Wide(), std::uint64_t{key1}));
    words[1] = p1;
    words[3] = p0;
  }
};

/// 53 bits of the two words as a number in [0,1).
hn::Vec<hn::ScalableTag<double> > unit_interval(Words low, Words high) {
  const hn::ScalableTag<double> numbers;
  const hn::Repartition<std::int64_t, Wide> whole;
  const Words low_half = hn::And(low, hn::Set(Wide(), std::uint64_t{0xffffffff}));
  const Words bits = hn::ShiftRight<11>(hn::Or(hn::ShiftLeft<32>(high), low_half));
  return hn::Mul(hn::ConvertTo(numbers, hn::BitCast(whole, bits)), hn::Set(numbers, 0x1p-53));
}

/// Points of a stream, and where they go.
struct Points {
  std::uint64_t key;
  std::uint64_t substream;
  std::uint64_t first;
  std::span<double> s;
  std::span<double> t;
};

/// Computes as many points as fill this number of vectors, from the at-th on. A round of Philox
/// waits for the one before: several vectors at once keep the multipliers busy.
template <std::size_t kVectors>
HWY_INLINE void fill_vectors(const Points& points, std::size_t at) {
  const Wide wide;
  const hn::ScalableTag<double> numbers;
  const std::size_t lanes = hn::Lanes(wide);
  Philox philox[kVectors];
  for (std::size_t v = 0; v < kVectors; ++v) {
    const Words index = hn::Add(hn::Set(wide, points.first + at + v * lanes), hn::Iota(wide, 0));
    philox[v] = {{index, hn::ShiftRight<32>(index), hn::Set(wide, points.substream),
                  hn::Set(wide, points.substream >> 32U)}};
  }
  auto key0 = static_cast<std::uint32_t>(points.key);
  auto key1 = static_cast<std::uint32_t>(points.key >> 32U);
#pragma GCC unroll 10
  for (int round = 0; round < 10; ++round) {
#pragma GCC unroll 4
    for (Philox& one : philox) one.round(key0, key1);
    key0 += PHILOX_W32_0;
    key1 += PHILOX_W32_1;
  }
  for (std::size_t v = 0; v < kVectors; ++v) {
    const Words* words = philox[v].words;
    hn::StoreU(unit_interval(words[0], words[1]), numbers, points.s.data() + at + v * lanes);
    hn::StoreU(unit_interval(words[2], words[3]), numbers, points.t.data() + at + v * lanes);
  }
}

/// Computes whole vectors from the front; returns how many points that were.
std::size_t fill(std::uint64_t key, std::uint64_t substream, std::uint64_t first,
                 std::span<double> s, std::span<double> t) {
  constexpr std::size_t kTogether = 4;
  const Points points = {key, substream, first, s, t};
  const std::size_t lanes = hn::Lanes(Wide());
  std::size_t done = 0;
  for (; done + kTogether * lanes <= s.size(); done += kTogether * lanes) {
    fill_vectors<kTogether>(points, done);
  }
  for (; done + lanes <= s.size(); done += lanes) fill_vectors<1>(points, done);
  return done;
}

#endif

}  // namespace
}  // namespace lightproof::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lightproof {
namespace {

HWY_EXPORT(fill);

}  // namespace

std::size_t fill_points(const RandomStream& stream, std::uint64_t first, std::span<double> s,
                        std::span<double> t) {
  const std::size_t by_vectors =
      HWY_DYNAMIC_DISPATCH(fill)(stream.key(), stream.number(), first, s, t);
  for (std::size_t i = by_vectors; i < s.size(); ++i) {
    const SquarePoint point = stream.point(first + i);
    s[i] = point.s;
    t[i] = point.t;
  }
  return by_vectors;
}

std::size_t fill_points(const RandomStream& stream, std::uint64_t first,
                        std::span<SquarePoint> points) {
  constexpr std::size_t kBlock = 256;
  std::array<double, kBlock> s;
  std::array<double, kBlock> t;
  std::size_t by_vectors = 0;
  for (std::size_t done = 0; done < points.size(); done += kBlock) {
    const std::size_t count = std::min(kBlock, points.size() - done);
    by_vectors +=
        fill_points(stream, first + done, std::span(s).first(count), std::span(t).first(count));
    for (std::size_t i = 0; i < count; ++i) points[done + i] = {s[i], t[i]};
  }
  return by_vectors;
}

}  // namespace lightproof
#endif
