#include "lightproof/study/study.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>

#include "lightproof/core/error.h"
#include "lightproof/core/random.h"
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

/// All of what a study found that no clock had a part in, as bytes.
std::string untimed_bytes(const StudyResult& study) {
  ValueWriter writer;
  writer.add(study.gate);
  writer.add(study.convergence);
  writer.add(study.split_sum);
  writer.add(study.renders.size());
  for (const AccuracyChart& chart : study.accuracy) {
    for (const AccuracyLine& line : chart.lines) {
      writer.add(std::string_view(line.estimator));
      for (const AccuracyPoint& point : line.points) writer.add(point.rmse);
    }
  }
  return writer.take();
}

/// A study of some seconds.
StudyOptions small_study() {
  StudyOptions options = on_a_sphere();
  options.gate.samples = 1024;
  options.convergence.most_samples = 4;
  options.convergence.estimates = 8;
  options.convergence.picture = {2, 2};
  options.renders.picture = {8, 6};
  options.renders.reference_samples = 1;
  options.recommended_error.reset();
  options.accuracy.select = [](const EstimatorInfo& info) { return info.name == "uniform"; };
  return options;
}

// Ended again and again, at a random moment each time, and gone on with each time.
TEST(RunStudy, GoesOnToTheSameBitsWhereverItIsEnded) {
  const std::vector<EnvironmentMap> maps = {make_synthetic_map("sun-sky", {16, 8})};
  const StudyOptions options = small_study();
  std::atomic<long> calls = 0;
  const Progress counting = [&calls](std::string_view /*step*/, double /*fraction*/) { ++calls; };
  const std::string whole = untimed_bytes(run_study(maps, options, counting));
  const TemporaryFolder folder;
  const RandomStream moments("study-ends", 7);
  constexpr int kEnds = 8;
  int ended = 0;
  for (int run = 0; run <= kEnds; ++run) {
    const double share = moments.point(static_cast<std::uint64_t>(run)).s / 3.0;
    std::atomic<long> left = 1 + static_cast<long>(share * static_cast<double>(calls.load()));
    const Progress ending = [&left, run](std::string_view /*step*/, double /*fraction*/) {
      if (--left <= 0 && run < kEnds) throw Interrupted();
    };
    const UnfinishedWork unfinished(folder / "", {{"--seed", "1"}}, Unfinished::continued);
    try {
      EXPECT_TRUE(untimed_bytes(run_study(maps, options, ending, unfinished)) == whole);
    } catch (const Interrupted&) {
      ++ended;
    }
  }
  EXPECT_GT(ended, 2);
}

}  // namespace
}  // namespace lightproof
