#include "lightproof/cases/adversarial_maps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "lightproof/core/direction.h"

namespace lightproof {
namespace {

using Random = std::mt19937_64;
using Picture = Grid<Rgb>;
using Paint = void (*)(Picture&, Random&);

int integer(Random& random, int from, int to) {
  return from + static_cast<int>(random() % static_cast<std::uint64_t>(to - from + 1));
}

float unit(Random& random) { return static_cast<float>(random()) * 0x1p-64F; }

void paint_lamps(Picture& picture, Random& random, bool mirrored) {
  const auto [width, height] = picture.extent();
  for (int i = integer(random, 1, 3); i > 0; --i) {
    const int x = integer(random, 0, width - 1);
    const int y = integer(random, 0, height - 1);
    const Rgb light(std::exp(6.0F * unit(random)));
    picture(x, y) = light;
    if (mirrored) picture(x, height - 1 - y) = light;
  }
}

void paint_noise(Picture& picture, Random& random) {
  for (Rgb& rgb : picture.values()) rgb = Rgb(std::exp(8.0F * unit(random)));
}

void paint_black_rows(Picture& picture, Random& random) {
  const int period = integer(random, 2, 5);
  for (int y = 1; y < picture.extent().height; ++y) {
    if (y % period == 0) continue;
    for (int x = 0; x < picture.extent().width; ++x) {
      picture(x, y) = Rgb(1.0F + static_cast<float>(x));
    }
  }
  picture(0, 0) = Rgb(1.0F);
}

void paint_bright_pole(Picture& picture, Random& random) {
  const float sky = integer(random, 0, 1) == 0 ? 0.0F : 1.0F;
  std::ranges::fill(picture.values(), Rgb(sky));
  const int row = integer(random, 0, 1) * (picture.extent().height - 1);
  const float light = std::pow(10.0F, static_cast<float>(integer(random, 0, 6)));
  std::ranges::fill(picture.row(row), Rgb(light));
}

struct Row {
  AdversarialMap kind;
  Paint paint;
};

constexpr auto kRows = std::to_array<Row>({
    {{"lamps", "one to three lit texels in the dark"},
     [](Picture& picture, Random& random) { paint_lamps(picture, random, false); }},
    {{"mirrored-lamps", "the same, with an equal one mirrored at the horizon"},
     [](Picture& picture, Random& random) { paint_lamps(picture, random, true); }},
    {{"noise", "texels that differ by up to e^8"}, paint_noise},
    {{"black-rows", "every second to fifth row black, a ramp along the others"}, paint_black_rows},
    {{"bright-pole", "the row of a pole up to 1e6 times as bright as the sky"}, paint_bright_pole},
    {{"one-colour", "pure red everywhere"},
     [](Picture& picture, Random& /*random*/) {
       std::ranges::fill(picture.values(), Rgb(1.0F, 0.0F, 0.0F));
     }},
});

constexpr auto kKinds = [] {
  std::array<AdversarialMap, kRows.size()> kinds;
  for (std::size_t i = 0; i < kinds.size(); ++i) kinds[i] = kRows[i].kind;
  return kinds;
}();

}  // namespace

std::span<const AdversarialMap> adversarial_maps() { return kKinds; }

EnvironmentMap make_adversarial_map(const AdversarialMap& kind, Extent extent, std::uint64_t seed) {
  EnvironmentMap map = {std::string(kind.name), Grid<Rgb>(extent), {}};
  Random random(seed);
  for (const Row& row : kRows) {
    if (row.kind.name == kind.name) row.paint(map.radiance, random);
  }
  return map;
}

EnvironmentMap mutant_map() {
  constexpr Extent kExtent = {128, 64};
  EnvironmentMap map = {"mutant-map", Grid<Rgb>(kExtent), {}};
  for (int y = 1; y < kExtent.height; ++y) {
    for (int x = 0; x < kExtent.width; ++x) {
      const double around = 1.0 + 0.5 * std::sin(2.0 * kPi * x / kExtent.width + 1.0);
      const auto luminance = static_cast<float>(3e-4 * (0.1 + 1.0 * y / kExtent.height) * around);
      const float warm = x < kExtent.width / 3 ? 1.6F : 1.0F;
      const bool sun = std::abs(x - 90) <= 1 && std::abs(y - 45) <= 1;
      map.radiance(x, y) = luminance * (sun ? 40.0F : 1.0F) * Rgb(warm, 1.0F, 1.0F / warm);
    }
  }
  return map;
}

}  // namespace lightproof
