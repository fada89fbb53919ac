#include "lightproof/precompute/inputs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lightproof/image/synthetic.h"

namespace lightproof {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

PrecomputeRequest some_request() {
  PrecomputeRequest request;
  request.products = {{Product::specular, Extent{16, 8}, 3}};
  return request;
}

class PrecomputeInputs : public testing::Test {
 protected:
  /// What differs now from what it was at the beginning.
  std::string difference() const { return difference_of(before_, inputs_of(map_, request_)); }

  EnvironmentMap map_ = make_synthetic_map("sun-sky", {32, 16});
  PrecomputeRequest request_ = some_request();

 private:
  std::vector<RunInput> before_ = inputs_of(map_, request_);
};

TEST_F(PrecomputeInputs, AreTheSameForTheSameLevels) {
  EXPECT_THAT(difference(), IsEmpty());
  request_.masking = Masking::karis;
  request_.products.push_back({Product::brdf_map});
  EXPECT_THAT(difference(), IsEmpty()) << "a BRDF map is made of no map";
}

TEST_F(PrecomputeInputs, DifferInWhatChangesALevelAndSaySo) {
  map_.radiance(3, 3).g += 1e-3F;
  EXPECT_THAT(difference(), HasSubstr("the map was 32x16 "));
  map_ = make_synthetic_map("sun-sky", {32, 16});
  request_.method.samples = 7;
  EXPECT_EQ(difference(), "--samples was 1024 and is 7");
  request_ = some_request();
  request_.projection = Projection::cube;
  request_.products = {{Product::specular, Extent{8, 8}, 3}};
  EXPECT_THAT(difference(), AllOf(HasSubstr("--projection was latlong and is cube"),
                                  HasSubstr("--specular was 16x8 with 3 levels and is 8x8")));
  request_ = some_request();
  request_.products.push_back({Product::irradiance, Extent{8, 4}});
  EXPECT_EQ(difference(), "--irradiance (8x4 with 1 level) is new");
}

}  // namespace
}  // namespace lightproof
