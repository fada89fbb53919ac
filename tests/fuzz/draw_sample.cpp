// Every correct sampler of the registry, on maps of any radiance, at any random numbers and at
// those where tables change: a position inside the drawn texel, a finite density above 0, which is
// the one that is returned for this position, and a unit vector.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "lightproof/core/error.h"
#include "lightproof/samplers/batch.h"
#include "lightproof/samplers/cdf_table.h"
#include "lightproof/samplers/registry.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/small_map.h"

namespace lightproof::fuzz {
namespace {

/// What the design asks of the density that is asked for again (case 16).
constexpr double kSameDensity = 1e-4;
/// Positions of batches on maps of few rows may differ in their last bits.
constexpr double kSamePosition = 1e-12;
constexpr std::size_t kPoints = 24;

constexpr std::array kEnds = {0.0,           std::numeric_limits<double>::denorm_min(),
                              0x1p-60,       0x1p-32,
                              0x1p-31,       0x1p-24,
                              0.25,          0.5,
                              0.75,          1.0 - 0x1p-24,
                              1.0 - 0x1p-31, 1.0 - 0x1p-32,
                              1.0 - 0x1p-53, 1.0};

/// A number of [0,1]: an end, an entry of a CDF or its neighbour, a multiple of a column of an
/// alias table, or any other.
double random_number(Input& input, CdfEntries entries, double cells) {
  switch (input.below(6)) {
    case 0:
      return kEnds[input.below(kEnds.size())];
    case 1: {
      const double entry = 0x1p-31 * entries[input.take<std::uint16_t>() % entries.size()];
      const double towards = input.below(3) - 1.0;
      return std::clamp(std::nextafter(entry, entry + towards), 0.0, 1.0);
    }
    case 2: {
      const double edge = std::fmod(input.take<std::uint16_t>(), cells + 1.0) / cells;
      const double towards = input.below(3) - 1.0;
      return std::clamp(std::nextafter(edge, edge + towards), 0.0, 1.0);
    }
    case 3:  // what shaders have
      return static_cast<double>(input.take<std::uint32_t>() >> 8U) * 0x1p-24;
    case 4:
      return static_cast<double>(input.take<std::uint64_t>() >> 11U) * 0x1p-53;
    default: {
      const double any = std::abs(input.take<double>());
      return any <= 1.0 ? any : 0.5;
    }
  }
}

class Drawn {
 public:
  Drawn(const SamplerInfo& info, DensitySpace density_space, Extent extent)
      : info_(info), density_space_(density_space), extent_(extent) {}

  void require(bool holds, SquarePoint u, const TexelSample& sample, std::string_view what) const {
    if (holds) return;
    fail(
        fmt::format("{} under {} on {}x{} at u = ({:.17g}, {:.17g}): texel ({}, {}), position "
                    "({:.17g}, {:.17g}), density {:.17g}: {}",
                    info_.name, to_string(density_space_), extent_.width, extent_.height, u.s, u.t,
                    sample.x, sample.y, sample.at.s, sample.at.t, sample.pdf.value, what));
  }

  template <class Sampler>
  void check(const Sampler& sampler, SquarePoint u, const TexelSample& sample) const {
    const auto is = [&](bool holds, std::string_view what) { require(holds, u, sample, what); };
    is(sample.x >= 0 && sample.x < extent_.width && sample.y >= 0 && sample.y < extent_.height,
       "no texel of the map");
    is(sample.at.s >= 0.0 && sample.at.s < 1.0 && sample.at.t >= 0.0 && sample.at.t < 1.0,
       "outside of the square");
    is(cell_of(sample.at.s, extent_.width) == sample.x &&
           cell_of(sample.at.t, extent_.height) == sample.y,
       "outside of its texel");
    is(sample.pdf.value > 0.0 && std::isfinite(sample.pdf.value), "no density");
    const double asked = sampler.pdf(sample.at).value;
    is(std::abs(asked - sample.pdf.value) <= kSameDensity * sample.pdf.value,
       fmt::format("asked for it: {:.17g}", asked));
  }

  template <class Sampler>
  void check_direction(const Sampler& sampler, SquarePoint u) const {
    const LightSample light = sample_direction(sampler, u);
    const Direction d = light.direction;
    const bool is_unit = std::abs(glm::dot(d, d) - 1.0) <= 1e-9;
    const TexelSample shown = {{d.x, d.y}, light.x, light.y, {light.pdf.value}};
    require(is_unit, u, shown, "no unit vector");
    require(light.pdf.value > 0.0 && std::isfinite(light.pdf.value), u, shown,
            "no density over directions");
  }

  template <class Sampler>
  void check_batch(const Sampler& sampler, std::span<const SquarePoint> points) const {
    std::vector<TexelSample> samples(points.size());
    sample(sampler, points, samples);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const TexelSample one = sampler.sample(points[i]);
      check(sampler, points[i], samples[i]);
      require(one.x == samples[i].x && one.y == samples[i].y &&
                  std::abs(one.at.s - samples[i].at.s) <= kSamePosition &&
                  std::abs(one.at.t - samples[i].at.t) <= kSamePosition,
              points[i], samples[i],
              fmt::format("alone: texel ({}, {}) at ({:.17g}, {:.17g})", one.x, one.y, one.at.s,
                          one.at.t));
    }
  }

 private:
  const SamplerInfo& info_;
  DensitySpace density_space_;
  Extent extent_;
};

std::vector<SquarePoint> points_of(Input& input, const EnvironmentMap& map,
                                   DensitySpace density_space) {
  const CdfTable table(map, on_map({density_space}, map));
  const auto cells = static_cast<double>(map.radiance.extent().count());
  std::vector<SquarePoint> points;
  for (std::size_t i = 0; i < kPoints; ++i) {
    const int row =
        static_cast<int>(input.below(static_cast<std::size_t>(map.radiance.extent().height)));
    const double s = random_number(input, table.columns(row), cells);
    points.push_back({s, random_number(input, table.rows(), map.radiance.extent().height)});
  }
  return points;
}

void draw(Input& input) {
  const DensitySpace density_space = fuzz::density_space(input);
  const EnvironmentMap map = small_map(input, Values::radiance);
  if (!why_not_declared({density_space}, map.mapping).empty()) return;
  std::vector<SquarePoint> points;
  if (!accepts([&] { points = points_of(input, map, density_space); })) return;  // it is black
  for (const SamplerInfo& info : samplers()) {
    if (info.known_defects || !why_not_declared(info.target(density_space), map.mapping).empty()) {
      continue;
    }
    const Drawn drawn(info, density_space, map.radiance.extent());
    std::optional<AnySampler> any;
    if (!accepts([&] { any.emplace(info.make(map, density_space)); })) {
      // What is kept as floats may be too faint for them.
      if (info.lookup == Lookup::nearest) fail(fmt::format("{} refused the map", info.name));
      continue;
    }
    std::visit(
        [&](const auto& sampler) {
          for (const SquarePoint u : points) {
            drawn.check(sampler, u, sampler.sample(u));
            drawn.check_direction(sampler, u);
          }
          drawn.check_batch(sampler, points);
        },
        *any);
  }
}

}  // namespace
}  // namespace lightproof::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  lightproof::fuzz::Input input(data, size);
  lightproof::fuzz::draw(input);
  return 0;
}
