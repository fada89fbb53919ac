// Where the render time goes: render/<estimator>/<material>/<W>x<H>/sphere-on-plane.
//
// The four phases of a batch are timed apart; beside them, bare Embree occlusion calls on the very
// same rays. Counters: shares of the time in percent, rays per second. Drawing from the material
// includes f_r cos and pdf of the direction drawn; every other source evaluates the material in
// the rest.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <array>
#include <chrono>
#include <memory>
#include <vector>

#include "bench/registration.h"
#include "bench/timing.h"
#include "lightproof/core/random.h"
#include "lightproof/image/synthetic.h"
#include "lightproof/render/direct_lighting.h"
#include "lightproof/render/receiver.h"

namespace lightproof::bench {
namespace {

constexpr Extent kMapExtent = {2048, 1024};
constexpr Extent kPicture = {64, 48};

struct Stage {
  EnvironmentMap map = make_synthetic_map("sun-sky", kMapExtent);
  const ReceiverInfo& receiver = receiver_by_name("sphere-on-plane");
  Scene scene{receiver.content};
  std::vector<Pixel> pixels = visible_pixels(receiver, scene, kPicture);
};

const Stage& stage() {
  static const auto the_stage = std::make_unique<Stage>();
  return *the_stage;
}

/// Seconds spent in each phase.
struct Phases {
  double draw = 0.0;
  double shade = 0.0;
  double trace = 0.0;
  double resolve = 0.0;
  double bare = 0.0;  ///< the same rays again, nothing else
  double rays = 0.0;

  double total() const { return draw + shade + trace + resolve; }
};

double seconds_since(Clock::time_point& last) {
  const Clock::time_point now = Clock::now();
  const double seconds = std::chrono::duration<double>(now - last).count();
  last = now;
  return seconds;
}

/// One batch at one pixel; returns the sum so that nothing is optimised away.
glm::dvec3 run_batch(LightBatch& batch, std::vector<ShadowRay>& copy, const Lighting& lighting,
                     const Pixel& pixel, const RandomStream& stream, Phases& phases) {
  Clock::time_point last = Clock::now();
  batch.draw(lighting, pixel.point, {stream, 0}, LightBatch::kCapacity);
  phases.draw += seconds_since(last);
  batch.shade(lighting, pixel.point);
  phases.shade += seconds_since(last);
  copy.assign(batch.rays().begin(), batch.rays().end());
  last = Clock::now();
  batch.trace(*lighting.scene);
  phases.trace += seconds_since(last);
  glm::dvec3 sum(0.0);
  for (const Rgb estimate : batch.resolve()) sum += glm::dvec3(estimate);
  phases.resolve += seconds_since(last);
  lighting.scene->trace(copy);
  phases.bare += seconds_since(last);
  phases.rays += static_cast<double>(copy.size());
  return sum;
}

/// A source, by the name of the estimator that draws from it.
struct NamedSource {
  std::string_view name;
  DirectionSource source;
};
const std::array<NamedSource, 5> kSources = {
    {{"uniform", UniformSphere{}},
     {"brdf", MaterialLobes{}},
     {"environment_A", MapDensity{DensitySpace::texture}},
     {"environment_B", MapDensity{DensitySpace::solid_angle}},
     {"environment_C", MapDensity{DensitySpace::sine_weighted}}}};

void render_benchmark(benchmark::State& state, const NamedSource& named,
                      const MaterialInfo& material) {
  const Stage& set = stage();
  const EnvironmentLight light(set.map, named.source);
  const Lighting lighting{&set.scene, &light, material.material};
  const RandomStream stream("bench/render", 1);
  auto batch = std::make_unique<LightBatch>();
  std::vector<ShadowRay> copy;
  Phases phases;
  std::size_t next = 0;
  for (auto _ : state) {
    const Pixel& pixel = set.pixels[next % set.pixels.size()];
    benchmark::DoNotOptimize(
        run_batch(*batch, copy, lighting, pixel, stream.substream(next), phases));
    ++next;
  }
  const double total = phases.total();
  state.counters["draw_percent"] = 100.0 * phases.draw / total;
  state.counters["embree_percent"] = 100.0 * phases.trace / total;
  state.counters["rest_percent"] = 100.0 * (phases.shade + phases.resolve) / total;
  state.counters["rays_per_second"] = phases.rays / total;
  state.counters["bare_rays_per_second"] = phases.rays / phases.bare;
  state.counters["ns_per_sample"] =
      1e9 * total / (static_cast<double>(state.iterations()) * LightBatch::kCapacity);
}

}  // namespace

void register_render_benchmarks() {
  for (const MaterialInfo& material : materials()) {
    for (const NamedSource& named : kSources) {
      const std::string name = fmt::format("render/{}/{}/{}x{}/sphere-on-plane", named.name,
                                           material.name, kMapExtent.width, kMapExtent.height);
      benchmark::RegisterBenchmark(name.c_str(), [&named, &material](benchmark::State& state) {
        render_benchmark(state, named, material);
      });
    }
  }
}

}  // namespace lightproof::bench
