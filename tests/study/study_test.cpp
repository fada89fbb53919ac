#include "lightproof/study/study.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lightproof/core/error.h"
#include "lightproof/core/temporary_folder.h"
#include "lightproof/image/synthetic.h"

namespace lightproof {
namespace {

// The light of a constant map is that of its resampled one; points drawn from it are points of the
// picture, whose texels are those of latitude and longitude.
TEST(DescribeMap, ShowsItInLatitudeAndLongitudeAndTellsItsOwnTexels) {
  const EnvironmentMap cube = make_synthetic_map("constant", {48, 8}, {MappingKind::cube_strip});
  const MapRecord record = describe_map(cube, 1);
  EXPECT_EQ(record.own_mapping, cube.mapping);
  EXPECT_EQ(record.own_texels, (Extent{48, 8}));
  EXPECT_EQ(record.map.mapping, Mapping{});
  EXPECT_EQ(record.map.radiance.extent(), (Extent{32, 16}));
  EXPECT_NEAR(record.effective_fraction, 1.0, 1e-12);
  EXPECT_FALSE(record.drawn.empty());

  const EnvironmentMap plain = make_synthetic_map("constant", {32, 16});
  EXPECT_EQ(describe_map(plain, 1).own_texels, (Extent{32, 16}));
  EXPECT_TRUE(describe_map(plain, 1).map.notes.empty());
}

/// A lambert sphere, of which costs are measured once.
StudyOptions on_a_sphere() {
  static const TemporaryFolder folder;
  StudyOptions options;
  options.cache = {folder / "", "/proc/self/exe", "", false};
  options.accuracy_scenes = {{&receiver_by_name("sphere"), {"lambert", material_of("lambert")}}};
  return options;
}

// A scene in which nothing can be recommended is told, and what is recommended in others stays.
TEST(RecommendMethods, HasAnAnswerForEveryScene) {
  const EnvironmentMap map = make_synthetic_map("gradient", {64, 32});
  StudyOptions options = on_a_sphere();
  StudyResult result;
  for (const double error : {0.05, 1e-7}) {
    options.recommended_error = error;
    recommend_methods(map, options, {}, result);
  }
  ASSERT_EQ(result.recommendations.size(), 1U);
  EXPECT_EQ(result.recommendations[0].question.map, "gradient");
  EXPECT_FALSE(result.recommendations[0].choice.estimator.empty());
  ASSERT_EQ(result.refused_recommendations.size(), 1U);
  EXPECT_EQ(result.refused_recommendations[0].question.error, 1e-7);
  EXPECT_FALSE(result.refused_recommendations[0].unreached.empty());
}

// A map without light is no scene without a method.
TEST(RecommendMethods, DoesNotTakeOtherErrorsForRefusals) {
  StudyResult result;
  EXPECT_THROW(recommend_methods({"black", Grid<Rgb>({16, 8})}, on_a_sphere(), {}, result),
               InputError);
  EXPECT_TRUE(result.refused_recommendations.empty());
}

}  // namespace
}  // namespace lightproof
