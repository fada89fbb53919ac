// Batches are what one direction at a time is, whatever the vectors.
#include "lightproof/materials/material_batch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "lightproof/core/random.h"
#include "tests/core/kinds_of_vectors.h"
#include "tests/core/whole_vectors.h"
#include "tests/materials/shading.h"

namespace lightproof {
namespace {

constexpr std::size_t kSize = 203;  // no whole number of vectors

struct Samples {
  MaterialSamples spans() { return {x, y, z, pdf, reflected_cosine}; }
  Direction direction(std::size_t i) const { return {x[i], y[i], z[i]}; }

  std::vector<double> x = std::vector<double>(kSize);
  std::vector<double> y = std::vector<double>(kSize);
  std::vector<double> z = std::vector<double>(kSize);
  std::vector<double> pdf = std::vector<double>(kSize);
  std::vector<double> reflected_cosine = std::vector<double>(kSize);
};

/// A power's error grows with its exponent, 100 at most; the values of lobes are some 20. What is
/// larger is so because it is divided by a small v.h, whose rounding shows in proportion to the
/// quotient: relatively, as the value itself.
double value_error(double value) { return 1e-12 * std::max(1.0, 0.1 * value * value); }
/// Around the axis of a lobe an error of four units in the last place of the cosine turns the
/// direction by the square root of eight of them.
constexpr double kDirectionError = 3e-8;

class MaterialBatch : public testing::TestWithParam<ShadingCase> {};

TEST_P(MaterialBatch, SamplesAreThoseOfOnePointAtATime) {
  const auto& [name, material, at] = GetParam();
  const RandomStream stream("material batch", 1);
  std::vector<double> s;
  std::vector<double> t;
  for (std::size_t i = 0; i < kSize; ++i) {
    const SquarePoint u = i == 0 ? SquarePoint{0.0, 0.0} : stream.point(i);
    s.push_back(u.s);
    t.push_back(u.t);
  }
  for_each_kind_of_vector([&, &at = at, &material = material](const char* vectors) {
    SCOPED_TRACE(vectors);
    Samples samples;
    sample_material(material, at, s, t, samples.spans());
    std::visit(
        [&](const auto& surface) {
          for (std::size_t i = 0; i < kSize; ++i) {
            const Direction drawn = surface.sample(at, {s[i], t[i]}).direction;
            EXPECT_NEAR(glm::distance(samples.direction(i), drawn), 0.0, kDirectionError);
            EXPECT_NEAR(glm::length(samples.direction(i)), 1.0, 1e-14);
            const Scattering scattering = surface.evaluate(at, samples.direction(i));
            EXPECT_NEAR(samples.pdf[i], scattering.pdf.value, value_error(scattering.pdf.value));
            EXPECT_NEAR(samples.reflected_cosine[i], scattering.reflected_cosine,
                        value_error(scattering.reflected_cosine));
          }
        },
        material);
  });
}

TEST_P(MaterialBatch, ValuesAndDensitiesAreThoseOfOneDirectionAtATime) {
  const auto& [name, material, at] = GetParam();
  const RandomStream stream("material batch", 2);
  Samples all;
  for (std::size_t i = 0; i < kSize; ++i) {
    const SquarePoint u = stream.point(i);
    const double z = 2.0 * u.t - 1.0;
    const double sine = std::sqrt(1.0 - z * z);
    all.x[i] = sine * std::cos(2.0 * kPi * u.s);
    all.y[i] = sine * std::sin(2.0 * kPi * u.s);
    all.z[i] = z;
  }
  for_each_kind_of_vector([&, &at = at, &material = material](const char* vectors) {
    SCOPED_TRACE(vectors);
    Samples both;
    reflected_cosines(material, at, {all.x, all.y, all.z}, all.reflected_cosine);
    scatterings(material, at, {all.x, all.y, all.z}, {both.reflected_cosine, both.pdf});
    std::visit(
        [&](const auto& surface) {
          for (std::size_t i = 0; i < kSize; ++i) {
            const auto [expected, pdf] = surface.evaluate(at, all.direction(i));
            EXPECT_NEAR(all.reflected_cosine[i], expected, value_error(expected));
            EXPECT_NEAR(both.reflected_cosine[i], expected, value_error(expected));
            EXPECT_NEAR(both.pdf[i], pdf.value, value_error(pdf.value));
          }
        },
        material);
  });
}

TEST_P(MaterialBatch, IsDoneByVectors) {
  const auto& [name, material, at] = GetParam();
  const std::vector<double> s(kSize, 0.3);
  const std::vector<double> t(kSize, 0.6);
  for_each_kind_of_vector([&, &at = at, &material = material](const char* vectors) {
    SCOPED_TRACE(vectors);
    Samples samples;
    expect_whole_vectors(vectors, sample_material(material, at, s, t, samples.spans()), kSize);
    std::vector<double> reflected(kSize);
    const DirectionArrays light = {samples.x, samples.y, samples.z};
    expect_whole_vectors(vectors, reflected_cosines(material, at, light, reflected), kSize);
    expect_whole_vectors(vectors, scatterings(material, at, light, {reflected, samples.pdf}),
                         kSize);
  });
}

/// How many of the first directions and values differ from the scalar code's in some bit.
struct Differences {
  std::size_t draws = 0;
  std::size_t values = 0;
};

template <class Surface>
Differences differences(const Surface& surface, const ShadingPoint& at, std::size_t done,
                        std::span<const double> s, std::span<const double> t,
                        const Samples& samples, std::span<const double> reflected) {
  Differences found;
  for (std::size_t i = 0; i < done; ++i) {
    const Direction direction = samples.direction(i);
    found.draws += surface.sample(at, {s[i], t[i]}).direction == direction ? 0U : 1U;
    found.values += surface.evaluate(at, direction).reflected_cosine == reflected[i] ? 0U : 1U;
  }
  return found;
}

// What the vectors wrote is what comes out: of some hundred sines, sums and powers in an oblique
// frame some differ from those of the scalar code in their last bit.
TEST(MaterialBits, AreThoseOfTheVectors) {
  const ShadingPoint at = shading_point(glm::normalize(Direction{1, 2, 3}), 0.7);
  const RandomStream stream("material batch", 3);
  std::vector<double> s;
  std::vector<double> t;
  for (std::size_t i = 0; i < kSize; ++i) {
    s.push_back(stream.point(i).s);
    t.push_back(stream.point(i).t);
  }
  for (const Material& material :
       {Material(Lambert{0.8}), Material(ModifiedPhong{0.3, 0.6, 9.5})}) {
    for_each_kind_of_vector([&](const char* vectors) {
      SCOPED_TRACE(vectors);
      Samples samples;
      const std::size_t done = sample_material(material, at, s, t, samples.spans());
      std::vector<double> reflected(kSize);
      reflected_cosines(material, at, {samples.x, samples.y, samples.z}, reflected);
      const Differences found = std::visit(
          [&](const auto& surface) {
            return differences(surface, at, done, s, t, samples, reflected);
          },
          material);
      EXPECT_EQ(found.draws > 0, done > 0);
      EXPECT_EQ(found.values > 0, done > 0);
    });
  }
}

/// Every way to draw microfacets, to mask them, and Blinn's lobe.
std::vector<ShadingCase> microfacet_cases() {
  std::vector<std::pair<std::string, Material>> materials = {
      {"Blinn", BlinnMicrofacet{0.5, 0.04}}, {"BlinnRough", BlinnMicrofacet{1.0, 0.9}}};
  using Sampling = MicrofacetSampling;
  const std::pair<const char*, Sampling> samplings[] = {{"Normals", Sampling::normals},
                                                        {"Visible", Sampling::visible_normals},
                                                        {"Caps", Sampling::spherical_caps},
                                                        {"Bounded", Sampling::bounded_caps}};
  for (const auto& [name, sampling] : samplings) {
    const std::string ggx = std::string("Ggx") + name;
    materials.push_back({ggx, Ggx{0.3, 0.9, SmithMasking::height_correlated, sampling}});
    materials.push_back({ggx + "Rough", Ggx{1.0, 0.04, SmithMasking::separable, sampling}});
  }
  materials.push_back({"GgxKaris", Ggx{0.6, 0.5, SmithMasking::karis}});
  std::vector<ShadingCase> cases;
  for (const auto& [name, material] : materials) {
    for (const int degrees : {0, 45, 85}) {
      cases.push_back(
          {name + std::to_string(degrees), material,
           shading_point(glm::normalize(Direction(0.3, -0.5, -0.4)), degrees * kPi / 180.0)});
    }
  }
  return cases;
}

/// Besides, powers that are not squared again and again, and microfacets.
std::vector<ShadingCase> batch_cases() {
  std::vector<ShadingCase> cases = shading_cases();
  for (ShadingCase& each : microfacet_cases()) cases.push_back(std::move(each));
  for (const double exponent : {2.5, 99.5}) {
    cases.push_back({"PhongPower" + std::to_string(static_cast<int>(exponent)),
                     ModifiedPhong{0.3, 0.6, exponent}, shading_point({0, 0, 1}, 0.7)});
  }
  return cases;
}

INSTANTIATE_TEST_SUITE_P(All, MaterialBatch, testing::ValuesIn(batch_cases()),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace lightproof
