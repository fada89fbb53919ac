#include "lightproof/gate/direction_sampler.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "lightproof/gate/gate.h"
#include "lightproof/gate/material_distribution.h"

namespace lightproof {
namespace {

using testing::Contains;
using testing::IsSubsetOf;
using testing::Not;
using testing::SizeIs;

std::set<std::string> names_of(const std::vector<DirectionSamplerInfo>& samplers) {
  std::set<std::string> names;
  for (const DirectionSamplerInfo& sampler : samplers) names.insert(sampler.name);
  EXPECT_EQ(names.size(), samplers.size()) << "a name twice";
  return names;
}

TEST(DirectionSamplers, AreEveryWayToDrawMicrofacetsAtEveryRoughnessAndAngle) {
  const std::set<std::string> all = names_of(all_direction_samplers());
  for (const char* way : {"ggx_normals", "ggx_visible", "ggx_caps", "ggx_bounded", "blinn"}) {
    for (const char* roughness : {"0.01", "0.1", "0.3", "0.6", "1"}) {
      for (const char* degrees : {"0", "45", "80", "89.9"}) {
        EXPECT_THAT(all, Contains(std::string(way) + "_" + roughness + "_" + degrees));
      }
    }
  }
}

// Of the selection: every way and angle once, and with it every way and roughness but one.
TEST(DirectionSamplers, SelectOneRoughnessForEachWayAndAngle) {
  const std::set<std::string> some = names_of(direction_samplers());
  EXPECT_THAT(some, IsSubsetOf(names_of(all_direction_samplers())));
  for (const std::string way : {"ggx_normals", "ggx_visible", "ggx_caps", "ggx_bounded", "blinn"}) {
    std::set<std::string> roughnesses;
    for (const std::string degrees : {"_0", "_45", "_80", "_89.9"}) {
      std::vector<std::string> found;
      for (const std::string& name : some) {
        if (name.starts_with(way + "_") && name.ends_with(degrees)) found.push_back(name);
      }
      ASSERT_THAT(found, SizeIs(1)) << way << degrees;
      const std::size_t length = found[0].size() - way.size() - degrees.size() - 1;
      roughnesses.insert(found[0].substr(way.size() + 1, length));
    }
    EXPECT_THAT(roughnesses, SizeIs(4)) << way;
  }
}

/// A material seen from +x, tested against the distribution of another.
DirectionSamplerInfo claiming(const Material& claimed, const Material& drawn, double degrees) {
  const double angle = degrees * kPi / 180.0;
  const Direction view = {std::sin(angle), 0.0, std::cos(angle)};
  const ShadingPoint at = {{}, frame_around({0, 0, 1}), view};
  return {"claiming", "", distribution_of(claimed, view),
          [drawn, at](SquarePoint u) {
            const DirectionSample sample =
                std::visit([&](const auto& m) { return m.sample(at, u); }, drawn);
            return DrawnDirection{sample.direction, sample.scattering.pdf};
          },
          [drawn, at](Direction d) {
            return std::visit([&](const auto& m) { return m.evaluate(at, d).pdf; }, drawn);
          }};
}

Outcome outcome_of(const DirectionSamplerInfo& sampler) {
  const GateResult result = run_gate(test_cases_of({&sampler, 1}), {.samples = 1U << 16U});
  return overall_outcome(result, true);
}

// A lobe 1e-4 radians wide, and 4e-7 across the view where that grazes the surface: a cell of
// latitude and longitude would hold all of it. alpha is the square of the roughness.
TEST(ChartedDensity, ShowsANarrowLobesAlphaFourInAHundredTooLarge) {
  constexpr double kRight = 0.01;
  constexpr double kWrong = 0.0102;
  for (const double degrees : {0.0, 89.9}) {
    for (const MicrofacetSampling sampling :
         {MicrofacetSampling::normals, MicrofacetSampling::visible_normals,
          MicrofacetSampling::spherical_caps, MicrofacetSampling::bounded_caps}) {
      SCOPED_TRACE(testing::Message() << degrees << ", " << static_cast<int>(sampling));
      const auto ggx = [&](double roughness) {
        return Ggx{roughness, 1.0, SmithMasking::height_correlated, sampling};
      };
      EXPECT_EQ(outcome_of(claiming(ggx(kRight), ggx(kWrong), degrees)), Outcome::reject);
    }
    EXPECT_EQ(
        outcome_of(claiming(BlinnMicrofacet{kRight, 1.0}, BlinnMicrofacet{kWrong, 1.0}, degrees)),
        Outcome::reject);
  }
}

// Visible normals are drawn in two ways, each of which passes for the other.
TEST(ChartedDensity, TakesOneWayToDrawVisibleNormalsForTheOther) {
  const auto ggx = [](MicrofacetSampling sampling) {
    return Ggx{0.6, 1.0, SmithMasking::separable, sampling};
  };
  const Ggx projected = ggx(MicrofacetSampling::visible_normals);
  const Ggx caps = ggx(MicrofacetSampling::spherical_caps);
  EXPECT_EQ(outcome_of(claiming(projected, caps, 80.0)), Outcome::accept);
  EXPECT_EQ(outcome_of(claiming(caps, projected, 80.0)), Outcome::accept);
  // Seen from the normal all normals are visible; from elsewhere not.
  const Ggx normals = ggx(MicrofacetSampling::normals);
  EXPECT_EQ(outcome_of(claiming(projected, normals, 0.0)), Outcome::accept);
  EXPECT_EQ(outcome_of(claiming(projected, normals, 45.0)), Outcome::reject);
  EXPECT_EQ(outcome_of(claiming(normals, projected, 45.0)), Outcome::reject);
}

}  // namespace
}  // namespace lightproof
