// The light that receivers reflect, by fewer nodes where lobes are wide beside texels.
#include "lightproof/accuracy/exact_light.h"

#include <gtest/gtest.h>

#include <string>
#include <tuple>

#include "lightproof/accuracy/lit_receiver.h"
#include "lightproof/image/environment_map.h"
#include "lightproof/image/synthetic.h"

namespace lightproof {
namespace {

using reference::SampledDensity;

class ExactLightOf : public testing::TestWithParam<std::tuple<const char*, const char*>> {};

// The middle of a cell is off by at most 6e-4 of the kernel, and of its square by four times as
// much. One bright texel is the worst map: nothing averages over its neighbours.
TEST_P(ExactLightOf, IsThatOfAllNodes) {
  const auto [map, material_name] = GetParam();
  const Material material = material_of(material_name);
  const ReceiverInfo& receiver = receiver_by_name("sphere-on-plane");
  const Scene scene(receiver.content);
  const Grid<double> luminance = luminance_of(make_synthetic_map(map, {1024, 512}));
  const auto pixels = receiver_points(receiver, scene, 8);
  const auto light = exact_light({&luminance, 1}, receiver, scene, material, pixels)[0];
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const auto kernel = kernel_at(receiver, scene, material, pixels[i].point);
    const auto all_nodes = reference::light_moments(kernel, {&luminance, 1})[0];
    for (const SampledDensity density : {SampledDensity::uniform, SampledDensity::solid_angle}) {
      const double mean = all_nodes[density].raw[0];
      const double square = all_nodes[density].raw[1];
      EXPECT_NEAR(light[i][density].raw[0], mean, 6e-4 * mean) << "pixel " << i;
      EXPECT_NEAR(light[i][density].raw[1], square, 2.4e-3 * square) << "pixel " << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Maps, ExactLightOf,
                         testing::Combine(testing::Values("one-texel", "sun-sky"),
                                          testing::Values("lambert", "phong:100", "ggx:0.3",
                                                          "ggx:0.15")),
                         [](const auto& of) {
                           std::string name =
                               std::string(std::get<0>(of.param)) + "_" + std::get<1>(of.param);
                           for (char& c : name) {
                             if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
                           }
                           return name;
                         });

}  // namespace
}  // namespace lightproof
