#include "bench/bare_gather.h"

#include <array>
#include <cmath>
#include <span>

#include "lightproof/core/random_batch.h"
#include "lightproof/warp/sin_cos.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bench/bare_gather.cpp"
#include <hwy/foreach_target.h>
// Highway asks for this order.
#include "lightproof/samplers/simd-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lightproof::bench::HWY_NAMESPACE {
namespace {

#if HWY_TARGET == HWY_SCALAR

std::uint64_t read(std::span<const std::uint16_t> numbers, std::size_t texels,
                   const BatchPoints& points, std::size_t count) {
  std::array<double, kBatchBlock> s;
  std::array<double, kBatchBlock> t;
  std::uint64_t sum = 0;
  for (std::size_t done = 0; done < count; done += kBatchBlock) {
    points.fill(done, s, t);
    for (const double u : s)
      sum += numbers[static_cast<std::size_t>(u * static_cast<double>(texels))];
  }
  return sum;
}

double read_directions(std::span<const std::uint16_t> numbers, std::size_t texels,
                       const BatchPoints& points, std::size_t count) {
  std::array<double, kBatchBlock> s;
  std::array<double, kBatchBlock> t;
  double sum = 0.0;
  for (std::size_t done = 0; done < count; done += kBatchBlock) {
    points.fill(done, s, t);
    for (std::size_t i = 0; i < kBatchBlock; ++i) {
      const SinCosOfTurns azimuth = sin_cos_of_turns(t[i]);
      sum += azimuth.sin + azimuth.cos +
             numbers[static_cast<std::size_t>(s[i] * static_cast<double>(texels))] /
                 std::sqrt(1.0 + t[i]);
    }
  }
  return sum;
}

#else

using namespace lightproof::HWY_NAMESPACE;

class BareGatherKernel {
 public:
  static constexpr int kStages = 2;
  struct Block : BlockPoints {
    alignas(64) std::int64_t offset[kBatchBlock];
  };

  BareGatherKernel(std::span<const std::uint16_t> numbers, std::size_t texels)
      : numbers_(numbers), texels_(static_cast<double>(texels)) {}

  template <int kStage>
  HWY_INLINE void stage(Block& block, std::size_t count, std::size_t /*first*/) {
    if constexpr (kStage == 0) {
      for_vectors(count, [&](std::size_t i) HWY_ATTR {
        const Int texel = to_whole(hn::Trunc(hn::Mul(load(block.s + i), number(texels_))));
        store(hn::Add(texel, texel), block.offset + i);
      });
      fetch(numbers_.data(), block.offset, count);
    } else {
      for (std::size_t i = 0; i < count; ++i) {
        sum_ += numbers_[static_cast<std::size_t>(block.offset[i]) / sizeof(std::uint16_t)];
      }
    }
  }

  std::uint64_t sum() const { return sum_; }

 protected:
  std::span<const std::uint16_t> numbers_;
  double texels_;
  std::uint64_t sum_ = 0;
};

class BareDirectionsKernel : private BareGatherKernel {
 public:
  using BareGatherKernel::BareGatherKernel;
  using BareGatherKernel::Block;
  using BareGatherKernel::kStages;

  template <int kStage>
  HWY_INLINE void stage(Block& block, std::size_t count, std::size_t first) {
    BareGatherKernel::stage<kStage>(block, count, first);
    if constexpr (kStage == 1) {
      for_vectors(count, [&](std::size_t i) HWY_ATTR {
        const Number t = load(block.t + i);
        const auto azimuth = sin_cos_of_turns(Numbers(), t);
        const Number root = hn::Div(number(1.0), hn::Sqrt(hn::Add(number(1.0), t)));
        store(hn::Add(load(directions_), hn::Add(hn::Add(azimuth.sin, azimuth.cos), root)),
              directions_);
      });
    }
  }

  double sum() const {
    double all = static_cast<double>(BareGatherKernel::sum());
    for (std::size_t i = 0; i < hn::Lanes(Numbers()); ++i) all += directions_[i];
    return all;
  }

 private:
  alignas(64) double directions_[hn::MaxLanes(Numbers())] = {};
};

std::uint64_t read(std::span<const std::uint16_t> numbers, std::size_t texels,
                   const BatchPoints& points, std::size_t count) {
  BareGatherKernel kernel(numbers, texels);
  draw_vectors(kernel, points, count, std::size_t{0});
  return kernel.sum();
}

double read_directions(std::span<const std::uint16_t> numbers, std::size_t texels,
                       const BatchPoints& points, std::size_t count) {
  BareDirectionsKernel kernel(numbers, texels);
  draw_vectors(kernel, points, count, std::size_t{0});
  return kernel.sum();
}

#endif

}  // namespace
}  // namespace lightproof::bench::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lightproof::bench {
namespace {

HWY_EXPORT(read);
HWY_EXPORT(read_directions);

}  // namespace

BareGather::BareGather(Extent extent) : texels_(extent.count()), numbers_(texels_) {
  for (std::size_t i = 0; i < texels_; ++i) numbers_[i] = static_cast<std::uint16_t>(i * 40503U);
}

std::uint64_t BareGather::read(const RandomStream& stream, std::uint64_t first,
                               std::size_t count) const {
  return HWY_DYNAMIC_DISPATCH(read)(numbers_, texels_, BatchPoints(stream, first), count);
}

double BareGather::read_directions(const RandomStream& stream, std::uint64_t first,
                                   std::size_t count) const {
  return HWY_DYNAMIC_DISPATCH(read_directions)(numbers_, texels_, BatchPoints(stream, first),
                                               count);
}

}  // namespace lightproof::bench
#endif
