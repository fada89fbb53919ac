// No operation of a warp gives NaN or an infinity, at poles, seams and the ends of the random
// numbers.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "lightproof/warp/hemisphere_around.h"
#include "lightproof/warp/lat_long.h"
#include "lightproof/warp/mapping.h"
#include "lightproof/warp/sphere_batch.h"
#include "tests/core/kinds_of_vectors.h"
#include "tests/core/trap_floating_point.h"

namespace lightproof {
namespace {

constexpr double kEnds[] = {0.0, 0x1p-60,       0x1p-24,       0.25, 0.5,
                            0.7, 1.0 - 0x1p-24, 1.0 - 0x1p-53, 1.0};

std::vector<SquarePoint> points() {
  std::vector<SquarePoint> all;
  for (const double s : kEnds) {
    for (const double t : kEnds) all.push_back({s, t});
  }
  return all;
}

bool is_unit(Direction d) { return std::abs(glm::dot(d, d) - 1.0) < 1e-12; }

TEST(FloatingPoint, OfNoMappingGivesNaNOrInfinity) {
  constexpr Extent kCube = {48, 8};
  for (const MappingInfo& info : mappings()) {
    Mapping mapping{.kind = info.kind};
    if (info.kind == MappingKind::node_rows) mapping = node_mapping(kCube);
    const test::TrapFloatingPoint trap;
    for (const SquarePoint at : points()) {
      const Direction direction = direction_at(mapping, at);
      EXPECT_TRUE(is_unit(direction)) << info.name;
      const SquarePoint back = square_point_of(mapping, direction);
      EXPECT_TRUE(std::isfinite(back.s) && std::isfinite(back.t)) << info.name;
      EXPECT_TRUE(std::isfinite(solid_angle_per_square(mapping, at))) << info.name;
    }
    for (const Direction axis : {Direction(1, 0, 0), Direction(-1, 0, 0), Direction(0, 1, 0),
                                 Direction(0, -1, 0), Direction(0, 0, 1), Direction(0, 0, -1)}) {
      const SquarePoint at = square_point_of(mapping, axis);
      EXPECT_TRUE(std::isfinite(at.s) && std::isfinite(at.t)) << info.name;
    }
    if (!size_fault(mapping, kCube).empty()) continue;
    EXPECT_TRUE(texel_solid_angle(mapping, kCube, 0, 0) > 0.0) << info.name;
  }
}

TEST(FloatingPoint, OfNoHemisphereGivesNaNOrInfinity) {
  const test::TrapFloatingPoint trap;
  for (const SquarePoint u : points()) {
    for (const Direction n :
         {Direction(0, 0, 1), Direction(0, 0, -1), Direction(-1, 0, 0), Direction(1e-9, 0, -1)}) {
      EXPECT_TRUE(is_unit(uniform_hemisphere_around(n, u)));
      EXPECT_TRUE(is_unit(cosine_hemisphere_around(n, u)));
      EXPECT_TRUE(is_unit(cosine_hemisphere_by_tangent_frame(n, u)));
      EXPECT_TRUE(is_unit(cosine_hemisphere_by_quaternion(n, u)));
    }
    for (const double exponent : {0.0, 1.0, 1000.0, 1e5}) {
      const Direction d = phong_lobe_from_square(u, exponent);
      EXPECT_TRUE(is_unit(d));
      EXPECT_TRUE(std::isfinite(phong_lobe_pdf(d.z, exponent).value));
    }
  }
}

TEST(FloatingPoint, OfNoBatchOfDirectionsGivesNaNOrInfinity) {
  std::vector<double> s;
  std::vector<double> t;
  for (const SquarePoint at : points()) {
    s.push_back(at.s);
    t.push_back(at.t);
  }
  for_each_kind_of_vector([&](const char* vectors) {
    SCOPED_TRACE(vectors);
    std::vector<double> x(s.size());
    std::vector<double> y(s.size());
    std::vector<double> z(s.size());
    std::vector<double> more(s.size());
    {
      const test::TrapFloatingPoint trap;
      uniform_directions(s, t, {x, y, z, more});
      directions_of_positions(s, t, {x, y, z, more});
    }
    for (std::size_t i = 0; i < s.size(); ++i) EXPECT_TRUE(is_unit({x[i], y[i], z[i]}));
    // Not trapped: vectors divide 0 by 0 at the poles, where the quotient is not taken.
    std::vector<double> found(s.size());
    approximate_positions(x, y, z, {found, more});
    for (const double position : found) EXPECT_TRUE(std::isfinite(position));
  });
}

}  // namespace
}  // namespace lightproof
