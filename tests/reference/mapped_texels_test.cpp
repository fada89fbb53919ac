#include "reference/mapped_texels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "lightproof/image/synthetic.h"
#include "lightproof/warp/lat_long.h"
#include "reference/texel_masses.h"

namespace lightproof::reference {
namespace {

struct Case {
  Mapping mapping;
  Extent extent;
};

std::vector<Case> cases() {
  return {{{.shift = 0.5 / 15}, {15, 7}},        {node_mapping({16, 9}), {16, 9}},
          {{MappingKind::octahedral}, {16, 16}}, {{MappingKind::octahedral}, {9, 9}},
          {{MappingKind::cube_strip}, {48, 8}},  {{MappingKind::cube_strip}, {30, 5}}};
}

double sum_of(const Grid<double>& masses) {
  return std::accumulate(masses.values().begin(), masses.values().end(), 0.0);
}

template <class Visit>
void for_each_texel(Extent extent, const Visit& visit) {
  for (int y = 0; y < extent.height; ++y) {
    for (int x = 0; x < extent.width; ++x) visit(x, y);
  }
}

// Two closed forms that share nothing: the difference of four angles keeps 16 digits of the sphere.
TEST(MappedTexels, HaveTheSolidAnglesOfTheWarp) {
  for (const Case& each : cases()) {
    SCOPED_TRACE(describe(each.mapping));
    for_each_texel(each.extent, [&](int x, int y) {
      EXPECT_NEAR(cell_solid_angle(each.mapping, texel_cell(each.extent, x, y)),
                  texel_solid_angle(each.mapping, each.extent, x, y), 1e-15 * kSphere);
    });
  }
}

TEST(MappedTexels, MassesUnderCAreThoseOfSolidAngle) {
  for (const Case& each : cases()) {
    SCOPED_TRACE(describe(each.mapping));
    const EnvironmentMap map = make_synthetic_map("constant", each.extent, each.mapping);
    const Grid<double> masses = texel_masses(map, {DensitySpace::sine_weighted});
    EXPECT_NEAR(sum_of(masses), 1.0, 1e-13);
    for_each_texel(each.extent, [&](int x, int y) {
      EXPECT_NEAR(masses(x, y), texel_solid_angle(each.mapping, each.extent, x, y) / kSphere,
                  1e-15);
    });
  }
}

TEST(MappedTexels, OfEqualAreaHaveOneDensity) {
  const EnvironmentMap map = make_synthetic_map("gradient", {12, 12}, {MappingKind::octahedral});
  const Grid<double> a = texel_masses(map, {DensitySpace::texture});
  for (const DensitySpace other : {DensitySpace::solid_angle, DensitySpace::sine_weighted}) {
    const Grid<double> masses = texel_masses(map, {other});
    for (std::size_t i = 0; i < a.values().size(); ++i) {
      EXPECT_EQ(masses.values()[i], a.values()[i]);
    }
  }
}

/// Mass of the part of a polygon's area in a cell, both in the square: its corners are cut off one
/// line at a time (Sutherland and Hodgman 1974), and its area is the shoelace formula's.
double area_in(std::vector<SquarePoint> polygon, const SquareCell& cell) {
  const auto cut = [&](const auto& inside) {
    std::vector<SquarePoint> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const SquarePoint a = polygon[i];
      const SquarePoint b = polygon[(i + 1) % polygon.size()];
      const double fa = inside(a);
      const double fb = inside(b);
      if (fa >= 0.0) kept.push_back(a);
      if ((fa > 0.0 && fb < 0.0) || (fa < 0.0 && fb > 0.0)) {
        const double share = fa / (fa - fb);
        kept.push_back({a.s + share * (b.s - a.s), a.t + share * (b.t - a.t)});
      }
    }
    polygon = kept;
  };
  cut([&](SquarePoint p) { return p.s - cell.left; });
  cut([&](SquarePoint p) { return cell.right - p.s; });
  cut([&](SquarePoint p) { return p.t - cell.bottom; });
  cut([&](SquarePoint p) { return cell.top - p.t; });
  double area = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const SquarePoint a = polygon[i];
    const SquarePoint b = polygon[(i + 1) % polygon.size()];
    area += 0.5 * (a.s * b.t - b.s * a.t);
  }
  return std::abs(area);
}

/// In an octahedral map a bin over (phi, theta) inside one octant is a trapezoid: |z| = 1 - r^2
/// with r = |u| + |v|, and the azimuth in its quarter turn is |v| / r.
std::vector<SquarePoint> octahedral_bin(Extent bins, int column, int row) {
  std::vector<SquarePoint> corners;
  const auto add = [&](int i, int j) {
    const double t = static_cast<double>(j) / bins.height;
    const double z = -std::cos(kPi * t);
    const bool upper = 2 * row >= bins.height;
    const double r = std::sqrt(std::max(0.0, 1.0 - std::abs(z)));
    // The middle of the bin tells the quadrant, its edge the place.
    const double middle = kPi - 2.0 * kPi * (column + 0.5) / bins.width;
    const double phi = kPi - 2.0 * kPi * i / bins.width;
    const double x = std::copysign(1.0, std::cos(middle));
    const double y = std::copysign(1.0, std::sin(middle));
    const double turn = std::atan2(std::abs(std::sin(phi)), std::abs(std::cos(phi))) / (0.5 * kPi);
    const double u = upper ? r * (1.0 - turn) : 1.0 - r * turn;
    const double v = upper ? r * turn : 1.0 - r * (1.0 - turn);
    // Rows of the picture count from its top.
    corners.push_back({0.5 + 0.5 * x * u, 0.5 - 0.5 * y * v});
  };
  add(column, row);
  add(column + 1, row);
  add(column + 1, row + 1);
  add(column, row + 1);
  return corners;
}

TEST(MappedTexels, OctahedralBinsAreThoseOfTheirTrapezoids) {
  constexpr Extent kBins = {32, 16};
  for (const Extent extent : {Extent{16, 16}, Extent{9, 9}}) {
    const EnvironmentMap map = make_synthetic_map("sun-sky", extent, {MappingKind::octahedral});
    const Grid<double> masses = texel_masses(map, {DensitySpace::texture});
    const BinnedMasses found = binned_masses(masses, map.mapping, kBins);
    EXPECT_NEAR(sum_of(found.masses), 1.0, 1e-12);
    for_each_texel(kBins, [&](int column, int row) {
      const std::vector<SquarePoint> bin = octahedral_bin(kBins, column, row);
      double exact = 0.0;
      for_each_texel(extent, [&](int x, int y) {
        const SquareCell texel = texel_cell(extent, x, y);
        exact += masses(x, y) * area_in(bin, texel) / texel.area();
      });
      // All edges are straight lines here: what is left is the rounding of their crossings.
      EXPECT_NEAR(found.masses(column, row), exact, 1e-13) << column << ' ' << row;
      EXPECT_LE(exact, found.masses(column, row) + found.bound(column, row) + 1e-13);
    });
  }
}

// The same parts in the same order, kept instead of visited; sums of rows are added up in another
// order, of some 10^5 parts that are at most the bin.
TEST(MappedTexels, PartsThatAreKeptMakeTheSameBins) {
  constexpr Extent kBins = {32, 16};
  for (const Case& each : cases()) {
    SCOPED_TRACE(describe(each.mapping));
    const Grid<double> masses(each.extent, 1.0 / static_cast<double>(each.extent.count()));
    const BinnedMasses expected = binned_masses(masses, each.mapping, kBins);
    Grid<double> bins(kBins);
    for (const BinnedPart& part : binned_parts(each.mapping, each.extent, kBins)) {
      bins(part.column, part.row) += part.area;
    }
    for (std::size_t i = 0; i < bins.values().size(); ++i) {
      EXPECT_NEAR(bins.values()[i], expected.masses.values()[i], 1e-15) << i;
    }
  }
}

// Counted in 64 x 64 midpoints of every texel, a bin's mass is off by half of a cell's width
// along its edges, of which a bin has no more than about 6 texels' sides here.
TEST(MappedTexels, BinsAreThoseThatMidpointsFind) {
  constexpr Extent kBins = {32, 16};
  constexpr int kPoints = 64;
  for (const Case& each : cases()) {
    SCOPED_TRACE(describe(each.mapping));
    const EnvironmentMap map = make_synthetic_map("gradient", each.extent, each.mapping);
    const Grid<double> masses = texel_masses(map, {DensitySpace::sine_weighted});
    const Grid<double> found = bin_masses(map, {DensitySpace::sine_weighted}, kBins);
    EXPECT_NEAR(sum_of(found), 1.0, 1e-12);
    Grid<double> counted(kBins);
    for_each_texel(each.extent, [&](int x, int y) {
      for_each_texel({kPoints, kPoints}, [&](int i, int j) {
        const SquarePoint at = {(x + (i + 0.5) / kPoints) / each.extent.width,
                                (y + (j + 0.5) / kPoints) / each.extent.height};
        const SquarePoint in_frame = square_from_direction(direction_at(each.mapping, at));
        counted(static_cast<int>(in_frame.s * kBins.width),
                static_cast<int>(in_frame.t * kBins.height)) += masses(x, y) / (kPoints * kPoints);
      });
    });
    const double most = *std::max_element(masses.values().begin(), masses.values().end());
    for (std::size_t i = 0; i < found.values().size(); ++i) {
      EXPECT_NEAR(found.values()[i], counted.values()[i], 6.0 / (2.0 * kPoints) * most) << i;
    }
  }
}

// On a cube edges bend. Chords of half the length leave a quarter of the area beside a curve; what
// the depth that is used leaves, two steps further, is a sixteenth of what is seen here.
TEST(MappedTexels, BinsOfACubeHaveConverged) {
  constexpr Extent kBins = {32, 16};
  const Extent extent = {24, 4};
  const Mapping mapping = {MappingKind::cube_strip};
  const auto bins_at = [&](int depth) {
    Grid<double> bins(kBins);
    for_each_texel(extent, [&](int x, int y) {
      visit_binned_parts(mapping, texel_cell(extent, x, y), depth, kBins,
                         [&](const BinnedPart& part) { bins(part.column, part.row) += part.area; });
    });
    return bins;
  };
  const int depth = depth_of_parts(mapping, extent) - 2;
  const Grid<double> found = bins_at(depth);
  const Grid<double> finer = bins_at(depth + 1);
  const Grid<double> coarser = bins_at(depth - 1);
  double last = 0.0;
  double before = 0.0;
  for (std::size_t i = 0; i < found.values().size(); ++i) {
    last += std::abs(finer.values()[i] - found.values()[i]);
    before += std::abs(found.values()[i] - coarser.values()[i]);
    // An inscribed polygon of chords of an angle x misses x^2/6 of a disc, one of half the chords a
    // quarter of that. The smallest circle has the radius tan(pi/16) = 0.199 on a face from -1 to
    // 1, the diagonal of a part is 0.022: x^2/8 is 1.5e-3.
    EXPECT_NEAR(found.values()[i], finer.values()[i], 1.5e-3 * finer.values()[i]) << i;
  }
  EXPECT_NEAR(last / before, 0.25, 0.1);
}

TEST(MappedTexels, TurnedColumnsUnderBAreDividedExactly) {
  const Extent extent = {15, 7};
  const EnvironmentMap map = make_synthetic_map("gradient", extent, {.shift = 0.5 / 15});
  constexpr Extent kBins = {32, 16};
  const Grid<double> b = bin_masses(map, {DensitySpace::solid_angle}, kBins);
  EXPECT_NEAR(sum_of(b), 1.0, 1e-13);
  // A map that is the same in all columns does not see the shift.
  const EnvironmentMap plain = make_synthetic_map("gradient", extent);
  const Grid<double> expected = bin_masses(plain, {DensitySpace::solid_angle}, kBins);
  for (std::size_t i = 0; i < b.values().size(); ++i) {
    EXPECT_NEAR(b.values()[i], expected.values()[i], 1e-15);
  }
}

// Three nodes of Gauss leave h^7 f^(6) / 2016000 of a side h. Rows of pi/7 are the longest
// sides here: of sin^3(theta), whose sixth derivative is at most 183, 7 times 3.3e-7, and half of
// the turn of azimuth, together 7.3e-6; along their columns, of cos^2(phi), 7e-7. Of z the errors
// of two hemispheres cancel.
TEST(MappedTexels, NodesOfATexelIntegrateWhatIsSmooth) {
  for (const Case& each : cases()) {
    SCOPED_TRACE(describe(each.mapping));
    double area = 0.0;
    double z = 0.0;
    double square = 0.0;
    for_each_texel(each.extent, [&](int x, int y) {
      visit_nodes(each.mapping, texel_cell(each.extent, x, y), [&](const Node& node) {
        area += node.solid_angle;
        z += node.solid_angle * node.direction.z;
        square += node.solid_angle * node.direction.x * node.direction.x;
      });
    });
    EXPECT_NEAR(area, kSphere, 1e-12);
    EXPECT_NEAR(z, 0.0, 1e-12);
    EXPECT_NEAR(square, kSphere / 3.0, 1e-5);
  }
}

// Of radiance 1 the estimator of irradiance has the mean pi whatever the texels; and where all
// texels are of one size, that of uniform directions has the moments of the others. Of a kink in
// the middle of a side, three nodes of Gauss leave at most 0.07 of a quarter of the side squared:
// in cells of a side h along the horizon, 2 pi / h of them, 0.0175 h^3 each, 4.1e-6 with h = 2 pi /
// 1024 if all had one sign. A square has no kink, and is no worse than smooth functions are.
TEST(MappedTexels, MomentsOfAConstantMapAreKnown) {
  for (const Case& each : cases()) {
    SCOPED_TRACE(describe(each.mapping));
    const Grid<double> one(each.extent, 1.0);
    for (const Direction normal : {Direction(0, 0, 1), Direction(1, 0, 0)}) {
      const LightMoments moments = light_moments(cosine_kernel(normal), {&one, 1}, each.mapping)[0];
      const EstimatorMoments& uniform = moments[SampledDensity::uniform];
      EXPECT_NEAR(uniform.raw[0], kPi, 4.1e-6);
      // E[X^2] = 4 pi ∫ cos^2 = 4 pi 2 pi/3.
      EXPECT_NEAR(uniform.raw[1], 8.0 * kPi * kPi / 3.0, 1e-5);
      EXPECT_NEAR(moments[SampledDensity::solid_angle].raw[1], uniform.raw[1], 1e-9);
      EXPECT_NEAR(moments[SampledDensity::texture_space].raw[0], kPi, 4.1e-6);
      EXPECT_NEAR(moments[SampledDensity::sine_weighted].raw[0], kPi, 4.1e-6);
      if (!is_equal_area(each.mapping)) continue;
      EXPECT_NEAR(moments[SampledDensity::texture_space].raw[1], uniform.raw[1], 1e-9);
      EXPECT_NEAR(moments[SampledDensity::sine_weighted].raw[3], uniform.raw[3], 1e-6);
    }
  }
}

// Of the plain mapping there are two ways: the quadrature of rows and columns, and that of cells.
// The map is the same in all columns, which a shift of 1e-4 of a turn leaves as it is; the horizon
// is an edge of texels, and what is smooth is divided as finely by both ways.
TEST(MappedTexels, MomentsAgreeWithThoseOfRowsAndColumns) {
  const EnvironmentMap map = make_synthetic_map("gradient", {16, 8});
  const Grid<double> luminance = luminance_of(map);
  const Kernel kernel = cosine_kernel({0, 0, 1});
  const LightMoments plain = light_moments(kernel, {&luminance, 1})[0];
  const LightMoments shifted = light_moments(kernel, {&luminance, 1}, {.shift = 1e-4})[0];
  for (const SampledDensity density :
       {SampledDensity::uniform, SampledDensity::texture_space, SampledDensity::solid_angle,
        SampledDensity::sine_weighted}) {
    for (std::size_t m = 0; m < 4; ++m) {
      const double expected = plain[density].raw[m];
      EXPECT_NEAR(shifted[density].raw[m], expected, 1e-6 * expected) << m;
    }
  }
}

TEST(MappedTexels, IntegralsOfTheJacobianHaveClosedForms) {
  const Extent square = {8, 8};
  const Mapping octahedral = {MappingKind::octahedral};
  EXPECT_NEAR(jacobian_integral(octahedral, square, texel_cell(square, 3, 5)),
              kSphere * kSphere / 64.0, 1e-12);
  EXPECT_NEAR(largest_jacobian(octahedral, square, texel_cell(square, 3, 5)), kSphere, 1e-12);
  // ∫ (2 pi^2 sin(pi t))^2 dt = 2 pi^4 over all rows.
  const Extent rows = {4, 6};
  double sum = 0.0;
  for_each_texel(rows, [&](int x, int y) {
    sum += jacobian_integral({.shift = 0.1}, rows, texel_cell(rows, x, y));
  });
  EXPECT_NEAR(sum, 2.0 * kPi * kPi * kPi * kPi, 1e-6);
}

}  // namespace
}  // namespace lightproof::reference
