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
  EXPECT_EQ(names.size(), std::variant_size_v<Material>);
}

TEST(MaterialTable, ConservesEnergy) {
  for (const MaterialInfo& info : materials()) {
    if (const auto* lambert = std::get_if<Lambert>(&info.material)) {
      EXPECT_TRUE(lambert->albedo >= 0.0 && lambert->albedo <= 1.0);
    } else {
      const auto& phong = std::get<ModifiedPhong>(info.material);
      EXPECT_TRUE(phong.diffuse >= 0.0 && phong.specular >= 0.0 && phong.exponent >= 0.0);
      EXPECT_LE(phong.diffuse + phong.specular, 1.0);
    }
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
}  // namespace lightproof
