#include "lightproof/render/scene.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <vector>

#include "lightproof/core/error.h"
#include "lightproof/core/random.h"
#include "lightproof/render/receiver.h"
#include "lightproof/warp/hemisphere.h"

namespace lightproof {
namespace {

/// Whether the ray from the point meets the unit sphere ahead of it.
bool meets_sphere(glm::dvec3 origin, Direction direction) {
  const double b = glm::dot(origin, direction);
  const double c = glm::dot(origin, origin) - 1.0;
  return b < 0.0 && b * b - c > 0.0;
}

TEST(Scene, RaysFromThePlaneAreBlockedByTheSphereExactly) {
  const Scene scene({true, true});
  const RandomStream stream("plane", 1);
  int blocked = 0;
  for (std::uint64_t i = 0; i < 20000; ++i) {
    const SquarePoint place = stream.point(2 * i);
    const glm::dvec3 origin = {4.0 * place.s - 2.0, 4.0 * place.t - 2.0, -1.0 + kSurfaceOffset};
    const Direction direction = cosine_hemisphere_from_square(stream.point(2 * i + 1));
    const double b = glm::dot(origin, direction);
    const double margin = b * b - (glm::dot(origin, origin) - 1.0);
    if (std::abs(margin) < 1e-4) continue;  // grazing: float rays may decide either way
    const bool expected = meets_sphere(origin, direction);
    blocked += expected ? 1 : 0;
    ASSERT_EQ(scene.is_visible(origin, direction), !expected);
  }
  EXPECT_GT(blocked, 1000);
}

TEST(Scene, ConvexSurfacesNeverShadowThemselves) {
  for (const std::string_view name : {"sphere", "plane"}) {
    const ReceiverInfo& receiver = receiver_by_name(name);
    const Scene scene(receiver.content);
    const RandomStream stream("convex", 1);
    std::uint64_t next = 0;
    for (const Pixel& pixel : visible_pixels(receiver, scene, {32, 24})) {
      for (int i = 0; i < 200; ++i) {
        const Direction local = cosine_hemisphere_from_square(stream.point(next++));
        ASSERT_TRUE(scene.is_visible(pixel.point.position, pixel.point.frame.to_world(local)))
            << name << " at pixel " << pixel.x << ", " << pixel.y;
      }
    }
  }
}

TEST(Scene, LeavesTheNumberOfThreadsAlone) {
  const auto threads = [] {
    return tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  };
  const std::size_t before = threads();
  const Scene scene({true, true});
  EXPECT_EQ(threads(), before);
}

TEST(Scene, SphereSeesThePlaneBelowItsHorizon) {
  const Scene scene({true, true});
  const glm::dvec3 side = {1.0 + kSurfaceOffset, 0.0, 0.0};
  EXPECT_FALSE(scene.is_visible(side, glm::normalize(Direction(1.0, 0.0, -0.01))));
  EXPECT_TRUE(scene.is_visible(side, glm::normalize(Direction(1.0, 0.0, 0.001))));
}

TEST(Scene, EmptySceneBlocksNothing) {
  const Scene scene({false, false});
  EXPECT_TRUE(scene.is_visible({0, 0, 0}, {0, 0, -1}));
  EXPECT_FALSE(scene.intersect({0, 0, 0}, {0, 0, -1}).has_value());
}

TEST(Scene, HitsLieOnTheSurface) {
  const Scene scene({true, false});
  const auto hit = scene.intersect({0.0, -5.0, 0.0}, {0.0, 1.0, 0.0});
  ASSERT_TRUE(hit.has_value());
  EXPECT_NEAR(hit->position.y, -1.0 - kSurfaceOffset, 1e-12);
  EXPECT_NEAR(hit->normal.y, -1.0, 1e-12);
}

TEST(Receiver, ViewsLieAboveTheSurface) {
  for (const ReceiverInfo& receiver : receivers()) {
    const Scene scene(receiver.content);
    const auto pixels = visible_pixels(receiver, scene, {40, 30});
    ASSERT_FALSE(pixels.empty()) << receiver.name;
    for (const Pixel& pixel : pixels) {
      ASSERT_GT(glm::dot(pixel.point.view, pixel.point.frame.normal), 0.0) << receiver.name;
    }
  }
  EXPECT_THROW(receiver_by_name("teapot"), InputError);
}

TEST(Receiver, EdgesOfTheIntegrandAreFound) {
  // Wherever visibility or the horizon differs inside a small cap, straddles_edge must say so.
  const ReceiverInfo& receiver = receiver_by_name("sphere-on-plane");
  const Scene scene(receiver.content);
  const RandomStream stream("edges", 1);
  constexpr double kAngle = 0.02;
  std::uint64_t next = 0;
  int edges = 0;
  const auto lit = [&](const ShadingPoint& point, Direction d) {
    return glm::dot(point.frame.normal, d) > 0.0 && scene.is_visible(point.position, d);
  };
  for (const Pixel& pixel : visible_pixels(receiver, scene, {12, 9})) {
    for (int i = 0; i < 300; ++i) {
      const SquarePoint u = stream.point(next++);
      const Direction centre = direction_around_z(2.0 * u.t - 1.0, u.s);
      const Frame frame = frame_around(centre);
      bool differs = false;
      for (int k = 0; k < 8; ++k) {
        const Direction d = frame.to_world(direction_around_z(std::cos(0.95 * kAngle), k / 8.0));
        differs = differs || lit(pixel.point, d) != lit(pixel.point, centre);
      }
      if (!differs) continue;
      ++edges;
      ASSERT_TRUE(straddles_edge(receiver, pixel.point, centre, kAngle))
          << "pixel " << pixel.x << ", " << pixel.y;
    }
  }
  EXPECT_GT(edges, 100);
}

}  // namespace
}  // namespace lightproof
