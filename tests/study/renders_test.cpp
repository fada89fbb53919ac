#include "lightproof/study/renders.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "lightproof/core/serialise.h"
#include "lightproof/estimators/registry.h"
#include "lightproof/image/synthetic.h"
#include "lightproof/materials/material.h"

namespace lightproof {
namespace {

std::vector<RenderRecord> small_renders(bool every_estimator) {
  const std::vector<EnvironmentMap> maps = {make_synthetic_map("sun-sky", {32, 16})};
  return study_renders(maps, {.picture = {12, 9},
                              .point_seconds = 1e-7,
                              .reference_samples = 64,
                              .every_estimator = every_estimator});
}

std::multiset<std::string> estimators_on(const std::vector<RenderRecord>& renders,
                                         const std::string& material) {
  std::multiset<std::string> names;
  for (const RenderRecord& r : renders) {
    if (r.material == material) names.insert(r.estimator);
  }
  return names;
}

std::multiset<std::string> that_serve(const Material& material) {
  std::multiset<std::string> names;
  for (const EstimatorInfo& info : estimators()) {
    if (info.serves(material)) names.insert(std::string(info.name));
  }
  return names;
}

TEST(Renders, OfEveryEstimatorShowEachThatServesTheMaterialOnce) {
  const std::vector<RenderRecord> renders = small_renders(true);
  for (const char* material : {"ggx:0.3", "lambert"}) {
    EXPECT_EQ(estimators_on(renders, material), that_serve(material_of(material))) << material;
  }
  for (const RenderRecord& r : renders) {
    EXPECT_TRUE(std::isfinite(r.rmse)) << r.estimator << " on " << r.material;
  }
}

// What a resumed study reads of its pictures.
TEST(Renders, AreReadBackAsTheyAreKept) {
  RenderRecord folded;
  folded.estimator = "uniform";
  folded.is_representative = false;
  folded.samples = 7;
  ValueWriter writer;
  writer.add(folded);
  const std::string bytes = writer.take();
  ValueReader reader(bytes);
  const auto read = reader.value<RenderRecord>();
  EXPECT_FALSE(read.is_representative);
  EXPECT_EQ(read.estimator, "uniform");
  EXPECT_EQ(read.samples, 7U);
  EXPECT_TRUE(reader.is_at_end());
}

TEST(Renders, StandForTheirKindsAloneUnlessEveryOneIsAskedFor) {
  const std::vector<RenderRecord> few = small_renders(false);
  EXPECT_TRUE(std::ranges::all_of(few, &RenderRecord::is_representative));
  std::vector<RenderRecord> all = small_renders(true);
  std::erase_if(all, [](const RenderRecord& r) { return !r.is_representative; });
  for (const char* material : {"ggx:0.3", "lambert"}) {
    EXPECT_GE(estimators_on(few, material).size(), 7U) << material;
    EXPECT_EQ(estimators_on(few, material), estimators_on(all, material)) << material;
  }
}

}  // namespace
}  // namespace lightproof
