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

  void round(std::uint32_t key0, std::uint32_t key1) {
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

/// Whole vectors from the front; returns how many points that were.
std::size_t fill(std::uint64_t key, std::uint64_t substream, std::uint64_t first,
                 std::span<double> s, std::span<double> t) {
  const Wide wide;
  const hn::ScalableTag<double> numbers;
  const std::size_t lanes = hn::Lanes(wide);
  std::size_t done = 0;
  for (; done + lanes <= s.size(); done += lanes) {
    const Words index = hn::Add(hn::Set(wide, first + done), hn::Iota(wide, 0));
    Philox philox{{index, hn::ShiftRight<32>(index), hn::Set(wide, substream),
                   hn::Set(wide, substream >> 32U)}};
    auto key0 = static_cast<std::uint32_t>(key);
    auto key1 = static_cast<std::uint32_t>(key >> 32U);
    for (int round = 0; round < 10; ++round) {
      philox.round(key0, key1);
      key0 += PHILOX_W32_0;
      key1 += PHILOX_W32_1;
    }
    hn::StoreU(unit_interval(philox.words[0], philox.words[1]), numbers, s.data() + done);
    hn::StoreU(unit_interval(philox.words[2], philox.words[3]), numbers, t.data() + done);
  }
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

void fill_points(const RandomStream& stream, std::uint64_t first, std::span<double> s,
                 std::span<double> t) {
  std::size_t done = HWY_DYNAMIC_DISPATCH(fill)(stream.key(), stream.number(), first, s, t);
  for (; done < s.size(); ++done) {
    const SquarePoint point = stream.point(first + done);
    s[done] = point.s;
    t[done] = point.t;
  }
}

void fill_points(const RandomStream& stream, std::uint64_t first, std::span<SquarePoint> points) {
  constexpr std::size_t kBlock = 256;
  std::array<double, kBlock> s;
  std::array<double, kBlock> t;
  for (std::size_t done = 0; done < points.size(); done += kBlock) {
    const std::size_t count = std::min(kBlock, points.size() - done);
    fill_points(stream, first + done, std::span(s).first(count), std::span(t).first(count));
    for (std::size_t i = 0; i < count; ++i) points[done + i] = {s[i], t[i]};
  }
}

}  // namespace lightproof
#endif
