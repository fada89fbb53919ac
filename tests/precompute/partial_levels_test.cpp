#include "lightproof/precompute/partial_levels.h"

#include <gtest/gtest.h>

#include <fstream>

#include "lightproof/core/temporary_folder.h"
#include "lightproof/image/synthetic.h"
#include "lightproof/precompute/levels.h"

namespace lightproof {
namespace {

namespace fs = std::filesystem;

PrecomputeRequest some_request() {
  PrecomputeRequest request;
  request.products = {{Product::specular, Extent{16, 8}, 3}};
  return request;
}

class Partial : public testing::Test {
 protected:
  fs::path folder() const { return folder_ / "maps.partial"; }
  EnvironmentMap map_ = make_synthetic_map("sun-sky", {32, 16});
  PrecomputeRequest request_ = some_request();
  std::vector<MapLevel> levels_ =
      make_levels(map_, request_, plan_levels(request_.products[0], request_.projection));

 private:
  TemporaryFolder folder_;
};

TEST_F(Partial, GivesBackWhatWasKeptToTheLastBit) {
  const std::string fingerprint = fingerprint_of(map_, request_);
  PartialLevels(folder(), fingerprint).keep("specular", levels_);
  const auto found = PartialLevels(folder(), fingerprint).find("specular");
  ASSERT_TRUE(found);
  ASSERT_EQ(found->size(), levels_.size());
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    EXPECT_EQ((*found)[i].roughness, levels_[i].roughness);
    const auto a = (*found)[i].faces[0].values();
    const auto b = levels_[i].faces[0].values();
    EXPECT_TRUE(std::equal(a.begin(), a.end(), b.begin(), b.end()));
  }
  EXPECT_FALSE(PartialLevels(folder(), fingerprint).find("irradiance"));
}

TEST_F(Partial, IsOfOneMapAndOneRequest) {
  const PartialLevels kept(folder(), fingerprint_of(map_, request_));
  kept.keep("specular", levels_);
  const auto is_found = [&] {
    return PartialLevels(folder(), fingerprint_of(map_, request_)).find("specular").has_value();
  };
  EXPECT_TRUE(is_found());
  map_.radiance(3, 3).g += 1e-3F;
  EXPECT_FALSE(is_found()) << "another map";
  map_ = make_synthetic_map("sun-sky", {32, 16});
  request_.method.samples = 7;
  EXPECT_FALSE(is_found()) << "another number of samples";
  request_ = some_request();
  request_.projection = Projection::cube;
  request_.products = {{Product::specular, Extent{8, 8}, 3}};
  EXPECT_FALSE(is_found()) << "another projection";
}

TEST_F(Partial, TakesNoDamagedFile) {
  const std::string fingerprint = fingerprint_of(map_, request_);
  const PartialLevels partial(folder(), fingerprint);
  partial.keep("specular", levels_);
  const fs::path file = folder() / "specular.levels";
  fs::resize_file(file, fs::file_size(file) - 1);
  EXPECT_FALSE(partial.find("specular"));
  std::ofstream(file) << "not ours";
  EXPECT_FALSE(partial.find("specular"));
}

TEST_F(Partial, LiesBesideTheResults) {
  EXPECT_EQ(partial_folder_of("out/maps"), fs::path("out/maps.partial"));
  EXPECT_EQ(partial_folder_of("out/maps/"), fs::path("out/maps.partial"));
}

TEST_F(Partial, GoesAwayOnceTheResultsAreWritten) {
  const PartialLevels partial(folder(), fingerprint_of(map_, request_));
  partial.keep("specular", levels_);
  partial.remove();
  EXPECT_FALSE(fs::exists(folder()));
}

}  // namespace
}  // namespace lightproof
