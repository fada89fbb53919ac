// Point sets as a study measures them: all of them, with the rates that theory gives.
#include "lightproof/study/point_study.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "lightproof/core/kept_file.h"
#include "lightproof/core/parallel.h"
#include "lightproof/core/serialise.h"
#include "lightproof/core/temporary_folder.h"
#include "lightproof/points/registry.h"
#include "lightproof/study/frame_study.h"

namespace lightproof {
namespace {

PointStudyOptions small_options() {
  PointStudyOptions options;
  options.errors = {.counts = {16, 64, 256}, .seeds = 256, .seed = 1};
  options.discrepancy_counts = {16, 64};
  options.decay_window = 256;
  options.first_decay_power = 16;
  return options;
}

std::string bytes_of(const PointStudy& study) {
  ValueWriter writer;
  writer.add(study);
  return writer.take();
}

const PointRate& rate_of(const PointStudy& study, const std::string& set,
                         const std::string& integrand) {
  return *std::ranges::find_if(study.rates, [&](const PointRate& rate) {
    return rate.set == set && rate.integrand == integrand;
  });
}

TEST(PointStudy, HasEverySetOnEveryIntegrandAndTheDecayOfThoseInFloat) {
  const PointStudy study = study_points(small_options());
  EXPECT_EQ(study.rates.size(), point_sets().size() * integrands().size());
  EXPECT_EQ(study.discrepancies.size(), point_sets().size() * 2);
  std::set<std::string> decaying;
  for (const PointDecay& decay : study.decay) decaying.insert(decay.set);
  EXPECT_EQ(decaying.size(), static_cast<std::size_t>(
                                 std::ranges::count(point_sets(), true, &PointSetInfo::is_float)));
  EXPECT_EQ(study.decay.size(), decaying.size() * (1 + 16)) << "at 0, 2^16, …, 2^31";
}

// An exponent is off by six of its standard errors with a probability of 2e-9, if they are those of
// a normal error; by scatter about the line, of one degree of freedom, they may be underestimated,
// never below the errors' own.
TEST(PointStudy, HasTheRatesOfIndependentPointsAndOfScrambledNets) {
  const PointStudy study = study_points(small_options());
  for (const Integrand& integrand : integrands()) {
    const PointRate& random = rate_of(study, "philox", std::string(integrand.name));
    EXPECT_NEAR(random.exponent, -0.5, 6.0 * random.exponent_error) << integrand.name;
    EXPECT_GT(random.exponent_error, 0.0);
  }
  const PointRate& net = rate_of(study, "sobol", "exponential");
  EXPECT_LT(net.exponent + 6.0 * net.exponent_error, -1.0);
}

TEST(PointStudy, HasTheSameBitsOnAnyNumberOfThreads) {
  PointStudyOptions options = small_options();
  options.errors.seeds = 8;
  const std::string many = bytes_of(study_points(options));
  const ThreadLimit one(1);
  EXPECT_EQ(bytes_of(study_points(options)), many);
}

TEST(FrameStudy, GoesFromThePolesToTheEquatorInBothPrecisions) {
  const std::vector<FrameErrorRecord> frames = study_frames();
  for (const bool is_float : {true, false}) {
    for (const bool is_nadir : {true, false}) {
      const auto line = [&](const FrameErrorRecord& r) {
        return r.construction == "duff" && r.is_float == is_float && r.is_nadir == is_nadir;
      };
      std::vector<double> distances;
      for (const FrameErrorRecord& r : frames) {
        if (line(r)) distances.push_back(r.distance);
      }
      ASSERT_GT(distances.size(), 12U);
      EXPECT_TRUE(std::ranges::is_sorted(distances));
      EXPECT_NEAR(distances.front(), 1e-12, 1e-20);
      EXPECT_NEAR(distances.back(), std::acos(0.0), 1e-12);
    }
  }
}

}  // namespace
}  // namespace lightproof
