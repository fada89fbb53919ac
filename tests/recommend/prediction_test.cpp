#include "lightproof/recommend/prediction.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

#include "lightproof/estimators/registry.h"
#include "lightproof/image/synthetic.h"
#include "lightproof/render/receiver.h"

namespace lightproof {
namespace {
std::vector<ShadingPoint> points_of(std::string_view receiver_name, Extent picture) {
  const ReceiverInfo& receiver = receiver_by_name(receiver_name);
  const Scene scene(receiver.content);
  std::vector<ShadingPoint> points;
  for (const Pixel& pixel : visible_pixels(receiver, scene, picture)) points.push_back(pixel.point);
  return points;
}
TEST(Prediction, Time) {
  const auto points = points_of("sphere", {8, 6});
  fmt::print("{} points\n", points.size());
  for (const char* name : {"sun-sky", "checker"}) {
    const MapSummary s = summarise(make_synthetic_map(name, {1024, 512}));
    for (const char* m : {"lambert", "phong:50", "phong:1000", "ggx:0.1", "ggx:0.3", "ggx:0.8"}) {
      const Material material = material_of(m);
      double best = 1e9;
      Prediction p;
      for (int i = 0; i < 5; ++i) {
        auto t = std::chrono::steady_clock::now();
        p = predict(s, material, points);
        best = std::min(
            best,
            std::chrono::duration<double>(std::chrono::steady_clock::now() - t).count() * 1e3);
      }
      fmt::print("{} {} {:.1f} ms\n", name, m, best);
    }
  }
}
}  // namespace
}  // namespace lightproof
