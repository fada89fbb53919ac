#include "reference/quadrature.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "lightproof/warp/lat_long.h"
#include "maps.h"

namespace lightproof::reference {
namespace {

constexpr CellNodes kAllNodes[] = {CellNodes::middle, CellNodes::gauss};

/// Calls visit(QuadratureCell) for all parts of a cell that have this depth.
void visit_all(const SphereQuadrature& quadrature, const QuadratureCell& cell, int depth,
               const std::function<void(const QuadratureCell&)>& visit) {
  if (cell.depth == depth) return visit(cell);
  quadrature.visit_parts(
      cell, [&](const QuadratureCell& part) { visit_all(quadrature, part, depth, visit); });
}

/// By Gauss's nodes in all cells of the least or of the greatest depth.
double integral(Extent extent, bool deepest, const std::function<double(const Node&)>& f) {
  const SphereQuadrature quadrature(extent);
  double sum = 0.0;
  for (int y = 0; y < extent.height; ++y) {
    for (int x = 0; x < extent.width; ++x) {
      visit_all(quadrature, {x, y, 0}, deepest ? quadrature.depth() : 0,
                [&](const QuadratureCell& cell) {
                  quadrature.visit(cell, CellNodes::gauss,
                                   [&](const Node& node) { sum += f(node) * node.solid_angle; });
                });
    }
  }
  return sum;
}

void expect_exact_weights(const SphereQuadrature& quadrature, int y, int depth, CellNodes nodes) {
  const Extent extent = quadrature.extent();
  double sum = 0.0;
  std::size_t count = 0;
  visit_all(quadrature, {extent.width - 1, y, 0}, depth, [&](const QuadratureCell& cell) {
    quadrature.visit(cell, nodes, [&](const Node& node) {
      sum += node.solid_angle;
      ++count;
    });
  });
  // Additions of numbers of one sign: the number of nodes times eps, and in practice its root.
  const double bound = 1e-14 + 2.3e-16 * std::sqrt(static_cast<double>(count)) * 20.0;
  EXPECT_NEAR(sum / texel_solid_angle(extent, y), 1.0, bound);
}

TEST(SphereQuadrature, WeightsOfATexelSumToItsSolidAngle) {
  for (const Extent extent : kExtents) {
    const SphereQuadrature quadrature(extent);
    for (int y = 0; y < extent.height; y += 3) {
      for (int depth = 0; depth <= quadrature.depth(); ++depth) {
        for (const CellNodes nodes : kAllNodes) expect_exact_weights(quadrature, y, depth, nodes);
      }
    }
  }
}

void expect_nodes_inside(const SphereQuadrature& quadrature, const QuadratureCell& texel, int depth,
                         CellNodes nodes) {
  visit_all(quadrature, texel, depth, [&](const QuadratureCell& cell) {
    quadrature.visit(cell, nodes, [&](const Node& node) {
      const SquarePoint at = square_from_direction(node.direction);
      EXPECT_EQ(static_cast<int>(at.s * quadrature.extent().width), texel.x);
      EXPECT_EQ(static_cast<int>(at.t * quadrature.extent().height), texel.y);
      EXPECT_NEAR(node.sin_theta, std::hypot(node.direction.x, node.direction.y), 1e-15);
      EXPECT_NEAR(glm::length(node.direction), 1.0, 1e-15);
      EXPECT_LE(glm::length(node.direction - quadrature.centre(cell)),
                quadrature.radius(cell.depth));
    });
  });
}

TEST(SphereQuadrature, NodesLieInsideTheirTexel) {
  const SphereQuadrature quadrature({33, 17});
  for (int y = 0; y < 17; ++y) {
    for (const int x : {0, 16, 32}) {
      for (const int depth : {0, 1, 3, quadrature.depth()}) {
        for (const CellNodes nodes : kAllNodes) {
          expect_nodes_inside(quadrature, {x, y, 0}, depth, nodes);
        }
      }
    }
  }
}

// Cells are halved as long as the sphere has too few of them, to either side.
TEST(SphereQuadrature, IsDividedUntilEdgesAreSmall) {
  EXPECT_EQ(SphereQuadrature({4096, 2048}).depth(), 0);
  EXPECT_EQ(SphereQuadrature({1024, 512}).depth(), 2);
  EXPECT_EQ(SphereQuadrature({320, 160}).depth(), 4);
  const SphereQuadrature quadrature({2048, 128});
  EXPECT_EQ(quadrature.depth(), 4);
  std::size_t parts = 0;
  visit_all(quadrature, {5, 7, 0}, 4, [&](const QuadratureCell&) { ++parts; });
  EXPECT_EQ(parts, 2U * 16U);
}

TEST(SphereQuadrature, RadiusReachesTheCorners) {
  for (const Extent extent : kExtents) {
    const SphereQuadrature quadrature(extent);
    for (int y = 0; y < extent.height; ++y) {
      const Direction centre = quadrature.centre({0, y, 0});
      for (const int edge : {y, y + 1}) {
        const auto t = static_cast<double>(edge) / extent.height;
        const double cosine = glm::dot(centre, direction_from_square({0.0, t}));
        EXPECT_LE(std::acos(std::clamp(cosine, -1.0, 1.0)), quadrature.radius(0) + 1e-7);
      }
    }
  }
}

TEST(SphereQuadrature, RunsCoverEachRowOnceAndTheirRadiusReachesTheCorners) {
  for (const Extent extent : kExtents) {
    const SphereQuadrature quadrature(extent);
    for (int y = 0; y < extent.height; ++y) {
      int next = 0;
      for (int index = 0; index < quadrature.runs(); ++index) {
        const CellRun run = quadrature.run(index, y);
        EXPECT_EQ(run.begin, next);
        next = run.end;
        for (const int column : {run.begin, run.end}) {
          for (const int row : {y, y + 1}) {
            const Direction corner =
                direction_from_square({static_cast<double>(column) / extent.width,
                                       static_cast<double>(row) / extent.height});
            const double cosine = glm::dot(run.centre, corner);
            EXPECT_LE(std::acos(std::clamp(cosine, -1.0, 1.0)), run.radius + 1e-7);
          }
        }
      }
      EXPECT_EQ(next, extent.width);
    }
  }
}

TEST(SphereQuadrature, IntegratesPolynomialsOfTheDirection) {
  // Promised: an error below 1e-9 of an integrand as smooth as a cosine. A square is half as
  // smooth, a fourth power a quarter: the rule is of fourth order, hence 16 and 256 times.
  for (const Extent texels : kExtents) {
    const Extent parts = SphereQuadrature::cells_per_texel(texels);
    const Extent extent = {texels.width * parts.width, texels.height * parts.height};
    const auto of = [&](const std::function<double(const Node&)>& f) {
      return integral(extent, false, f) / kSphere;
    };
    EXPECT_NEAR(of([](const Node& n) { return n.direction.x; }), 0.0, 1e-9);
    EXPECT_NEAR(of([](const Node& n) { return n.direction.z; }), 0.0, 1e-9);
    EXPECT_NEAR(of([](const Node& n) { return n.direction.x * n.direction.x; }), 1.0 / 3.0, 1.6e-8);
    EXPECT_NEAR(of([](const Node& n) { return n.direction.z * n.direction.z; }), 1.0 / 3.0, 1.6e-8);
    EXPECT_NEAR(of([](const Node& n) { return n.direction.x * n.direction.y; }), 0.0, 1.6e-8);
    EXPECT_NEAR(of([](const Node& n) { return std::pow(n.direction.z, 4); }), 0.2, 2.6e-7);
    EXPECT_NEAR(of([](const Node& n) { return n.sin_theta; }), kPi / 4.0, 1e-9);
  }
}

TEST(SphereQuadrature, SplitIsFinerByTheSixthPower) {
  // Of z^1024, whose mean is 1/1025: the coarse error is 16^6 times the fine one, up to the
  // rounding of 3e7 additions of numbers of one sign, each half an ulp at random: 6e3 eps.
  const auto power = [](const Node& n) { return std::pow(n.direction.z, 1024) / kSphere; };
  const Extent extent = {64, 32};
  const double coarse = std::abs(integral(extent, false, power) - 1.0 / 1025.0);
  const double fine = std::abs(integral(extent, true, power) - 1.0 / 1025.0);
  EXPECT_GT(coarse, 1e-9) << "nothing to improve";
  EXPECT_LT(fine, coarse / 1e6 + 5e-12);
}

}  // namespace
}  // namespace lightproof::reference
