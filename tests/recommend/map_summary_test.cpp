#include "lightproof/recommend/map_summary.h"
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <ctime>
#include "lightproof/image/synthetic.h"
namespace lightproof {
namespace {
TEST(MapSummary, Time) {
  for (const char* name : {"sun-sky", "checker", "gradient"}) {
    const EnvironmentMap map = make_synthetic_map(name, {1024, 512});
    for (int i = 0; i < 3; ++i) {
      auto t = std::clock();
      const MapSummary s = summarise(map);
      fmt::print("{} {} ms, {} blocks {} cells\n", name,
                 static_cast<double>(std::clock() - t) / CLOCKS_PER_SEC * 1e3, s.blocks.size(),
                 s.cells.size());
    }
  }
}
}  // namespace
}  // namespace lightproof
