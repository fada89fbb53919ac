// The integrator where something is in the way, and pictures by it.
#include "lightproof/render/direct_lighting.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "lightproof/core/parallel.h"
#include "lightproof/image/synthetic.h"
#include "lightproof/render/picture.h"

namespace lightproof {
namespace {

/// The mean luminance of so many estimates.
double mean_luminance(const Lighting& lighting, const ShadingPoint& point,
                      const RandomStream& stream, std::uint64_t samples) {
  LightBatch batch;
  double sum = 0.0;
  for (std::uint64_t first = 0; first < samples; first += LightBatch::kCapacity) {
    const auto count = std::min<std::uint64_t>(LightBatch::kCapacity, samples - first);
    for (const Rgb rgb : batch.estimate(lighting, point, {stream, first}, count)) {
      sum += luminance_of(rgb);
    }
  }
  return sum / static_cast<double>(samples);
}

TEST(Occlusion, TheSphereDarkensThePlaneBelowIt) {
  const EnvironmentMap map = make_synthetic_map("constant", {64, 32});
  const EnvironmentLight light(map, MaterialLobes{});
  const Material material = Lambert{0.8};
  const ShadingPoint near = {{1.2, 0.0, -1.0 + kSurfaceOffset}, frame_around({0, 0, 1}), {0, 0, 1}};
  const Scene open({false, true});
  const Scene shaded({true, true});
  const RandomStream stream("darkens", 1);
  const auto mean = [&](const Scene& scene) {
    return mean_luminance({&scene, &light, material}, near, stream, 65536);
  };
  // Cosine sampling of a constant map: albedo without a sphere, less than it with one.
  EXPECT_NEAR(mean(open), 0.8, 1e-6);
  EXPECT_LT(mean(shaded), 0.7);
}

TEST(Picture, TheSameBitsForAnyNumberOfThreads) {
  const EnvironmentMap map = make_synthetic_map("sun-sky", {64, 32});
  const EnvironmentLight light(map, MapDensity{DensitySpace::solid_angle});
  const ReceiverInfo& receiver = receiver_by_name("sphere-on-plane");
  const Scene scene(receiver.content);
  const Lighting lighting{&scene, &light, ModifiedPhong{0.3, 0.6, 50.0}};
  const auto render = [&](int threads) {
    const ThreadLimit limit(threads);
    return render_picture(
        map, scene, receiver, {32, 24}, RandomStream("threads", 1),
        [&](const ShadingPoint& at, const RandomStream& of_pixel) {
          return Rgb(static_cast<float>(mean_luminance(lighting, at, of_pixel, 16)));
        });
  };
  const Grid<Rgb> one = render(1);
  for (const int threads : {2, 7}) {
    const Grid<Rgb> many = render(threads);
    EXPECT_TRUE(std::equal(one.values().begin(), one.values().end(), many.values().begin()));
  }
}

}  // namespace
}  // namespace lightproof
