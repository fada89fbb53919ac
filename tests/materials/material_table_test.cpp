#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "lightproof/core/error.h"
#include "lightproof/materials/material.h"

namespace lightproof {
namespace {

using testing::HasSubstr;

TEST(MaterialTable, HasEveryMaterialOnceByItsName) {
  std::set<std::string_view> names;
  for (const MaterialInfo& info : materials()) {
    EXPECT_TRUE(names.insert(info.name).second) << info.name;
    EXPECT_EQ(&material_by_name(info.name), &info);
    EXPECT_FALSE(info.description.empty());
  }
  std::set<std::size_t> kinds;
  for (const MaterialInfo& info : materials()) kinds.insert(info.material.index());
  EXPECT_EQ(kinds.size(), std::variant_size_v<Material>);
}

bool conserves_energy(const Lambert& lambert) {
  return lambert.albedo >= 0.0 && lambert.albedo <= 1.0;
}
bool conserves_energy(const ModifiedPhong& phong) {
  return phong.diffuse >= 0.0 && phong.specular >= 0.0 && phong.exponent >= 0.0 &&
         phong.diffuse + phong.specular <= 1.0;
}
/// Microfacets do whatever their roughness is.
bool conserves_energy(const auto& microfacets) {
  return microfacets.roughness > 0.0 && microfacets.roughness <= 1.0 &&
         microfacets.normal_reflectance >= 0.0 && microfacets.normal_reflectance <= 1.0;
}

TEST(MaterialTable, ConservesEnergy) {
  for (const MaterialInfo& info : materials()) {
    EXPECT_TRUE(std::visit([](const auto& m) { return conserves_energy(m); }, info.material))
        << info.name;
  }
}

TEST(MaterialTable, AnswersAnUnknownNameWithTheKnownOnes) {
  try {
    material_by_name("glass");
    FAIL() << "nothing was thrown";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("'glass'"));
    for (const MaterialInfo& info : materials()) {
      EXPECT_THAT(error.what(), HasSubstr(std::string(info.name)));
    }
  }
}

}  // namespace
TEST(MaterialOf, TakesAParameterOfTheUsersOwn) {
  EXPECT_EQ(std::get<ModifiedPhong>(material_of("phong:12.5")).exponent, 12.5);
  EXPECT_EQ(std::get<ModifiedPhong>(material_of("phong:12.5")).diffuse,
            std::get<ModifiedPhong>(material_of("phong")).diffuse);
  EXPECT_EQ(std::get<Ggx>(material_of("ggx:0.1")).roughness, 0.1);
  EXPECT_TRUE(std::holds_alternative<Lambert>(material_of("lambert")));
}

TEST(MaterialOf, RefusesWhatIsNoMaterialAndSaysWhatThereIs) {
  for (const char* text : {"phong:", "phong:0.5", "phong:nan", "phong:5x", "phong:2e5", "ggx:0",
                           "ggx:1.5", "ggx:-0.3", "lambert:1", "glass", ":", ""}) {
    EXPECT_THROW(material_of(text), InputError) << text;
  }
}

}  // namespace lightproof
