// lightproof recommend: what it prints, what it writes, what it refuses.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/program.h"
#include "tests/cli/schema.h"

namespace lightproof::test {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

/// Of a small map, with costs that are kept beside nothing else.
Finished recommend(Words more, const std::filesystem::path& folder) {
  Words words = {"recommend", "--size", "64x32"};
  words.insert(words.end(), more.begin(), more.end());
  return lightproof(words, folder);
}

TEST(RecommendCommand, NamesAMethodARunnerUpAndAReason) {
  const TemporaryFolder folder;
  const Finished finished =
      recommend({"gradient", "--material", "lambert", "--error", "2%", "-q", "--json", "r.json"},
                folder / "");
  ASSERT_EQ(finished.exit_code, 0) << finished.err;
  EXPECT_THAT(finished.out, AllOf(StartsWith("gradient: for 2 % error: "), HasSubstr(" measured; "),
                                  HasSubstr(" \u00b5s predicted, set-up "),
                                  HasSubstr("\nrunner-up: "), HasSubstr("\nreason: ")));
  EXPECT_THAT(finished.err, IsEmpty());
  expect_valid("recommendation.schema.json", folder / "r.json");
  const json answer = json_of(folder / "r.json");
  EXPECT_EQ(answer.at("error"), 0.02);
  EXPECT_LE(answer.at("measured_error").get<double>(), 1.1 * 0.02);
  EXPECT_NE(answer.at("runner_up").at("choice"), answer.at("choice"));
}

TEST(RecommendCommand, PredictsOnlyIfItIsNotToVerify) {
  const TemporaryFolder folder;
  const Finished finished = recommend(
      {"sun-sky", "--material", "ggx:0.4", "--error", "0.05", "--no-verify", "-q", "--json", "-"},
      folder / "");
  ASSERT_EQ(finished.exit_code, 0) << finished.err;
  const json answer = json::parse(finished.out);
  EXPECT_TRUE(answer.at("measured_error").is_null());
  EXPECT_TRUE(answer.at("measured_time").at("point_ms").is_null());
  EXPECT_EQ(answer.at("unpredicted").size(), 3U);
  EXPECT_LE(answer.at("predicted_error").get<double>(), 0.05);
}

TEST(RecommendCommand, WarnsOfWhatIsInTheWayAndNamesWhatIsNotPredicted) {
  const TemporaryFolder folder;
  const Finished finished = recommend({"gradient", "--material", "lambert", "--error", "5%",
                                       "--receiver", "sphere-on-plane", "--no-verify", "-q"},
                                      folder / "");
  ASSERT_EQ(finished.exit_code, 0) << finished.err;
  EXPECT_THAT(finished.out, AllOf(HasSubstr("\nwarning: the error is that of a receiver with "
                                            "nothing in the way of light"),
                                  HasSubstr("\nnot predicted: riemann: ")));
}

TEST(RecommendCommand, RefusesAnErrorThatNoMethodReaches) {
  const TemporaryFolder folder;
  const Finished finished =
      recommend({"sun-sky", "--material", "ggx:0.3", "--error", "1e-7", "-q"}, folder / "");
  EXPECT_EQ(finished.exit_code, 2);
  EXPECT_THAT(finished.err, AllOf(HasSubstr("no method reaches"), HasSubstr("environment: "),
                                  HasSubstr("the floor of")));
}

// Before costs are measured, which takes seconds.
TEST(RecommendCommand, RefusesTexelsOfAnotherMapping) {
  const TemporaryFolder folder;
  write_map(folder / "faces.exr", {48, 8});
  const Finished finished = lightproof({"recommend", (folder / "faces.exr").string(), "--preset",
                                        "cube", "--material", "lambert", "--error", "2%", "-q"},
                                       folder / "");
  EXPECT_EQ(finished.exit_code, 2);
  EXPECT_THAT(finished.err, AllOf(HasSubstr("a recommendation needs those of latitude"),
                                  HasSubstr("--resample")));
}

TEST(RecommendCommand, RefusesWhatItCannotRead) {
  const TemporaryFolder folder;
  const auto message = [&](Words words) {
    const Finished finished = recommend(std::move(words), folder / "");
    EXPECT_EQ(finished.exit_code, 2);
    return finished.err;
  };
  for (const char* error : {"0", "-1%", "nan", "2 %", "%", "20", "1001%"}) {
    EXPECT_THAT(message({"constant", "--material", "lambert", "--error", error}),
                HasSubstr("--error"))
        << error;
  }
  EXPECT_THAT(message({"constant", "--material", "lambert", "--error", "20"}),
              HasSubstr("\"20\" is 2000 %, and errors are below 1000 %; 20 % is written 20%"));
  EXPECT_THAT(message({"constant", "--material", "glass", "--error", "2%"}), HasSubstr("lambert"));
  EXPECT_THAT(message({"constant", "--material", "ggx:7", "--error", "2%"}),
              HasSubstr("0.02 to 1"));
  EXPECT_THAT(message({"constant", "--material", "lambert", "--error", "2%", "--receiver", "cube"}),
              HasSubstr("sphere-on-plane"));
  EXPECT_THAT(message({"constant", "--error", "2%"}), HasSubstr("--material"));
  EXPECT_THAT(message({"constant", "--material", "lambert", "--error", "2%", "--memory", "0"}),
              HasSubstr("--memory"));
}

}  // namespace
}  // namespace lightproof::test
