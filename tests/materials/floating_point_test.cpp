// No operation of a material gives NaN or an infinity, and no vector of them returns one: at
// grazing views and lights, in lobes as narrow as they may be.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "lightproof/core/random.h"
#include "lightproof/materials/material_batch.h"
#include "tests/core/kinds_of_vectors.h"
#include "tests/core/trap_floating_point.h"
#include "tests/materials/shading.h"

namespace lightproof {
namespace {

constexpr std::size_t kSize = 203;  // no whole number of vectors

std::vector<Material> all_materials() {
  std::vector<Material> all;
  for (const MaterialInfo& info : materials()) all.push_back(info.material);
  for (const double roughness : {0.02, 0.3, 1.0}) {
    all.emplace_back(Ggx{roughness, 0.04});
    all.emplace_back(BlinnMicrofacet{roughness, 1.0});
  }
  all.emplace_back(ModifiedPhong{0.2, 0.7, 1e5});
  return all;
}

std::vector<ShadingPoint> all_points() {
  std::vector<ShadingPoint> points;
  for (const Direction normal :
       {Direction(0, 0, 1), Direction(0, 0, -1), Direction(0.6, 0.0, 0.8)}) {
    // Not from straight above: what is across that view is 0 / 0 behind a test of it, and compilers
    // that are told that nothing traps divide before they test.
    for (const double angle : {1e-9, 0.7, 1.57, 0.5 * kPi - 1e-9}) {
      points.push_back(shading_point(normal, angle));
    }
  }
  return points;
}

struct Numbers {
  MaterialSamples spans() { return {x, y, z, pdf, reflected_cosine}; }
  DirectionArrays directions() const { return {x, y, z}; }
  bool are_finite() const {
    bool finite = true;
    for (std::size_t i = 0; i < kSize; ++i) {
      finite = finite && std::isfinite(pdf[i]) && std::isfinite(reflected_cosine[i]);
    }
    return finite;
  }

  std::vector<double> x = std::vector<double>(kSize);
  std::vector<double> y = std::vector<double>(kSize);
  std::vector<double> z = std::vector<double>(kSize);
  std::vector<double> pdf = std::vector<double>(kSize);
  std::vector<double> reflected_cosine = std::vector<double>(kSize);
};

struct Square {
  Square() {
    constexpr double kEnds[] = {0.0, 0x1p-60, 0.5, 1.0 - 0x1p-24, 1.0 - 0x1p-53};
    for (const double a : kEnds) {
      for (const double b : kEnds) add({a, b});
    }
    const RandomStream stream("tests/floating-point", 1);
    for (std::uint64_t i = 0; s.size() < kSize; ++i) add(stream.point(i));
  }
  void add(SquarePoint u) {
    s.push_back(u.s);
    t.push_back(u.t);
  }
  std::vector<double> s;
  std::vector<double> t;
};

TEST(FloatingPoint, OfNoMaterialGivesNaNOrInfinity) {
  const Square square;
  for (const Material& material : all_materials()) {
    for (const ShadingPoint& at : all_points()) {
      // What comes out of vectors is finite; inside, lanes that are not taken may not be: Highway's
      // exponential of what underflows, half vectors of opposite directions.
      for_each_kind_of_vector([&](const char* /*vectors*/) {
        Numbers drawn;
        sample_material(material, at, square.s, square.t, drawn.spans());
        EXPECT_TRUE(drawn.are_finite());
        Numbers asked;
        scatterings(material, at, drawn.directions(), {asked.reflected_cosine, asked.pdf});
        reflected_cosines(material, at, drawn.directions(), asked.reflected_cosine);
        EXPECT_TRUE(asked.are_finite());
      });
      const test::TrapFloatingPoint trap;
      std::visit(
          [&](const auto& surface) {
            for (std::size_t i = 0; i < kSize; ++i) {
              const DirectionSample one = surface.sample(at, {square.s[i], square.t[i]});
              const Scattering asked = surface.evaluate(at, one.direction);
              EXPECT_TRUE(std::isfinite(one.scattering.pdf.value) &&
                          std::isfinite(asked.pdf.value));
            }
          },
          material);
    }
  }
}

}  // namespace
}  // namespace lightproof
