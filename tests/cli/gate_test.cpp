// lightproof gate: exit codes, table, JSON, and what they depend on.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "lightproof/samplers/registry.h"
#include "tests/cli/program.h"
#include "tests/cli/schema.h"

namespace lightproof::test {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

const Words kSound = {"gate", "constant", "--size", "64x32", "-n", "65536"};

Finished gate_into(const std::filesystem::path& file, Words words) {
  words.insert(words.end(), {"--json", file.string()});
  return lightproof(words);
}

bool has_rejected_check_at_origin(const json& gate) {
  const auto& tests = gate.at("tests");
  return std::any_of(tests.begin(), tests.end(), [](const json& test) {
    const std::string detail = test.at("detail");
    return test.at("outcome") == "reject" && test.at("oracle") == "check" &&
           detail.find("u = (0, 0)") != std::string::npos;
  });
}

TEST(Gate, AcceptsACorrectSamplerWithATable) {
  Words words = kSound;
  words.insert(words.end(), {"--sampler", "binary_search"});
  const Finished gate = lightproof(words);
  EXPECT_EQ(gate.exit_code, 0);
  EXPECT_THAT(gate.out, AllOf(HasSubstr("verdict"), HasSubstr("binary_search A"),
                              HasSubstr("binary_search B"), HasSubstr("accept"),
                              HasSubstr("0 rejected"), HasSubstr("65,536 samples")));
  EXPECT_THAT(gate.out, Not(HasSubstr("linear_scan")));
  EXPECT_THAT(gate.err, IsEmpty());
}

TEST(Gate, RejectsThePublishedScanWhereTheFirstRowIsBlack) {
  const TemporaryFolder folder;
  const Finished gate =
      gate_into(folder / "g.json", {"gate", "black-first-row", "--sampler", "linear_scan_published",
                                    "--size", "64x32", "-n", "65536"});
  EXPECT_EQ(gate.exit_code, 1);
  EXPECT_THAT(gate.out, AllOf(HasSubstr("\n\u2717 reject: "), HasSubstr("Rejected tests")));
  const json results = json_of(folder / "g.json");
  EXPECT_EQ(results.at("outcome"), "reject");
  EXPECT_TRUE(has_rejected_check_at_origin(results)) << results.dump(1);
}

TEST(Gate, JudgesTheTexelsOfTheFileAndTellsWhatTheyLeaveOut) {
  const TemporaryFolder folder;
  write_map(folder / "faces.exr", {48, 8});
  const std::string map = (folder / "faces.exr").string();
  const Words words = {"gate", map, "--preset", "cube", "-n", "65536", "--sampler", "packed_alias"};
  const Finished gate = gate_into(folder / "g.json", words);
  EXPECT_EQ(gate.exit_code, 0) << gate.out << gate.err;
  EXPECT_THAT(gate.out, AllOf(HasSubstr("packed_alias A"), HasSubstr("packed_alias C"),
                              HasSubstr("Left out\n  faces: positions uniform in solid angle need"),
                              HasSubstr("packed_alias B")));
  expect_valid("gate.schema.json", folder / "g.json");
  const json left_out = json_of(folder / "g.json").at("left_out");
  ASSERT_EQ(left_out.size(), 1U);
  EXPECT_EQ(left_out.at(0).at("density"), "B");

  Words resampled = words;
  resampled.emplace_back("--resample");
  EXPECT_EQ(gate_into(folder / "r.json", resampled).exit_code, 0);
  EXPECT_TRUE(json_of(folder / "r.json").at("left_out").empty());
}

TEST(Gate, RefusesToCallNothingAcceptance) {
  const TemporaryFolder folder;
  write_map(folder / "faces.exr", {48, 8});
  const Finished gate = lightproof({"gate", (folder / "faces.exr").string(), "--preset", "cube",
                                    "--density", "B", "-n", "65536"});
  EXPECT_EQ(gate.exit_code, 2);
  EXPECT_THAT(gate.err,
              AllOf(HasSubstr("nothing is left to test"),
                    HasSubstr("density C draws the same texels"), HasSubstr("--resample")));
}

TEST(Gate, RefusesAMapOnWhichNothingIsTestedBesideOthersThatAre) {
  const TemporaryFolder folder;
  write_map(folder / "faces.exr", {48, 8});
  const Finished gate = lightproof({"gate", "constant", (folder / "faces.exr").string(), "--size",
                                    "64x32", "--preset", "cube", "--density", "B", "-n", "65536"});
  EXPECT_EQ(gate.exit_code, 2);
  EXPECT_THAT(gate.err, AllOf(HasSubstr("faces"), HasSubstr("nothing is left to test")));
}

TEST(Gate, LooksLikeAPassWhereItPasses) {
  const TemporaryFolder folder;
  const Finished gate =
      gate_into(folder / "g.json", {"gate", "black-first-row", "--size", "64x32", "-n", "65536"});
  EXPECT_EQ(gate.exit_code, 0) << gate.out;
  EXPECT_THAT(gate.out, AllOf(Not(HasSubstr("published")), Not(HasSubstr("\u2717")),
                              Not(HasSubstr("Rejected tests")), Not(HasSubstr("Diagnosis"))));
  const json results = json_of(folder / "g.json");
  EXPECT_TRUE(results.at("rejections").empty());
  EXPECT_TRUE(results.at("known_defects").empty());
}

TEST(Gate, ShowsKnownDefectsApartIfToldTo) {
  const TemporaryFolder folder;
  const Finished gate = gate_into(folder / "g.json", {"gate", "black-first-row", "--size", "64x32",
                                                      "-n", "65536", "--with-published"});
  EXPECT_EQ(gate.exit_code, 0) << gate.out;
  const std::size_t section = gate.out.find("Kept as published, with known defects");
  ASSERT_NE(section, std::string::npos) << gate.out;
  EXPECT_GT(gate.out.find("\u2717"), section) << gate.out;
  EXPECT_TRUE(json_of(folder / "g.json").at("rejections").empty());
  EXPECT_FALSE(json_of(folder / "g.json").at("known_defects").empty());
  const json results = json_of(folder / "g.json");
  EXPECT_EQ(results.at("outcome"), "accept");
  for (const json& test : results.at("tests")) {
    EXPECT_EQ(test.at("known_defect"), test.at("sampler") == "linear_scan_published");
    // The black row has no positions that could be tested.
    EXPECT_TRUE(
        test.at("known_defect") || test.at("outcome") == "accept" ||
        (test.at("outcome") == "not-run" && test.at("test") == "positions in the first row"))
        << test.dump();
  }
}

/// One texel holds all light but a few hundred millionths: all bins make one pool.
void put_light_into_one_texel(Grid<Rgb>& picture) {
  std::ranges::fill(picture.values(), Rgb(1e-6F));
  picture(16, 7) = Rgb(1e3F);
}

TEST(Gate, IsInconclusiveWhereSamplesAreTooFewToTell) {
  const TemporaryFolder folder;
  write_map(folder / "spike.exr", {32, 16}, put_light_into_one_texel);
  const Finished gate = gate_into(folder / "g.json", {"gate", (folder / "spike.exr").string(), "-n",
                                                      "1024", "--sampler", "binary_search"});
  EXPECT_EQ(gate.exit_code, 3) << gate.out << gate.err;
  EXPECT_THAT(gate.out, HasSubstr("inconclusive"));
  EXPECT_EQ(json_of(folder / "g.json").at("outcome"), "inconclusive");
}

TEST(GateJson, HasTheTypesThatItsReadersExpect) {
  const json gate = gate_results({"constant"});
  EXPECT_TRUE(gate.at("outcome").is_string());
  EXPECT_TRUE(gate.at("family_alpha").is_number());
  EXPECT_EQ(gate.at("samples"), 1024);
  EXPECT_EQ(gate.at("seed"), 1);
  ASSERT_FALSE(gate.at("tests").empty());
  for (const json& test : gate.at("tests")) {
    for (const char* key : {"sampler", "density", "map", "oracle", "test", "outcome"}) {
      EXPECT_TRUE(test.at(key).is_string() && !test.at(key).empty()) << key << test.dump();
    }
    const json& log10_p = test.at("log10_p");
    EXPECT_EQ(log10_p.is_null(), test.at("oracle") == "check") << test.dump();
    EXPECT_TRUE(log10_p.is_null() || (log10_p.is_number() && log10_p <= 0.0)) << test.dump();
    EXPECT_TRUE(test.at("effect").is_number()) << test.dump();
    EXPECT_TRUE(test.at("known_defect").is_boolean());
    EXPECT_TRUE(test.at("detail").is_string());
  }
}

TEST(GateJson, HoldsWhatWasChosen) {
  EXPECT_THAT(values_of(gate_results({"constant", "step"}), "map"),
              ElementsAre("constant", "step"));
  const json scan = gate_results({"constant", "--sampler", "linear_scan", "--density", "B"});
  EXPECT_THAT(values_of(scan, "sampler"), ElementsAre("linear_scan"));
  EXPECT_THAT(values_of(scan, "density"), ElementsAre("B"));
  EXPECT_EQ(values_of(gate_results({"--sampler", "binary_search"}), "map").size(), 8U);
  EXPECT_THAT(values_of(gate_results({"--sampler", "phong_45"}), "map"), ElementsAre("directions"));
}

TEST(GateJson, IsTheSameForAnyNumberOfThreads) {
  const TemporaryFolder folder;
  // Three tasks of samples per run, the last one not full.
  Words words = {"gate", "sun-sky", "--size", "32x16", "-n", "600000", "-q", "-t", "1"};
  std::vector<std::string> texts;
  for (const char* threads : {"1", "2", "7"}) {
    words.back() = threads;
    EXPECT_EQ(gate_into(folder / "g.json", words).exit_code, 0);
    const std::string text = bytes_of(folder / "g.json");
    texts.push_back(text.substr(text.find("\"maps\"")));  // before it stands the command
  }
  EXPECT_EQ(texts[0], texts[1]);
  EXPECT_EQ(texts[0], texts[2]);
}

TEST(GateJson, FollowsTheSeed) {
  const Words words = {"constant", "--sampler", "binary_search", "--seed"};
  const auto results = [](const Words& all) {
    json gate = gate_results(all);
    gate.erase("command");
    return gate;
  };
  const auto with_seed = [&](const char* seed) {
    Words all = words;
    all.emplace_back(seed);
    return results(all);
  };
  const json one = with_seed("1");
  json two = with_seed("2");
  EXPECT_EQ(one, with_seed("1"));
  EXPECT_EQ(one, results({"constant", "--sampler", "binary_search"}));
  EXPECT_EQ(two.at("seed"), 2);
  EXPECT_NE(one.at("tests"), two.at("tests"));
}

TEST(GateQuiet, PrintsNothing) {
  const TemporaryFolder folder;
  const Finished gate = quick_gate({"constant", "-q", "--json", (folder / "g.json").string()});
  EXPECT_EQ(gate.exit_code, 0);
  EXPECT_THAT(gate.out, IsEmpty());
  EXPECT_THAT(gate.err, IsEmpty());
  EXPECT_TRUE(std::filesystem::exists(folder / "g.json"));
}

TEST(GateQuiet, KeepsTheExitCode) {
  const Finished gate = quick_gate({"black-first-row", "-q", "--sampler", "linear_scan_published"});
  EXPECT_EQ(gate.exit_code, 1);
  EXPECT_THAT(gate.out + gate.err, IsEmpty());
}

TEST(GateQuiet, StillSaysWhatIsWrong) {
  EXPECT_THAT(quick_gate({"none.exr", "-q"}).err, HasSubstr("none.exr"));
}

TEST(GateOptions, LeaveAMapAfterASamplerAMap) {
  const Finished gate = quick_gate({"--sampler", "binary_search", "constant"});
  EXPECT_EQ(gate.exit_code, 0) << gate.err;
}

TEST(GateOptions, ReadSamplesAsDecimal) {
  EXPECT_EQ(gate_results({"constant", "-n", "02048"}).at("samples"), 2048);
}

TEST(GateOptions, ReadSamplesAsPeopleWriteThem) {
  const std::pair<const char*, int> numbers[] = {
      {"2^11", 2048}, {"2e3", 2000},   {"2.5e3", 2500},   {"2k", 2000},
      {"1.5K", 1500}, {"1e+4", 10000}, {"20.50e2", 2050}, {"0.002M", 2000}};
  for (const auto& [text, number] : numbers) {
    EXPECT_EQ(gate_results({"constant", "--sampler", "alias", "-n", text}).at("samples"), number)
        << text;
  }
}

TEST(GateOptions, RefuseANegativeSeed) {
  const Finished gate = quick_gate({"constant", "--seed", "-1"});
  EXPECT_EQ(gate.exit_code, 2);
  EXPECT_THAT(gate.err, HasSubstr("--seed"));
}

TEST(GateSequential, StopsBeforeAllSamplesAndSaysHowToRunItAgain) {
  const TemporaryFolder folder;
  const Finished gate =
      gate_into(folder / "g.json", {"gate", "sun-sky", "--size", "128x64", "--sampler", "squared",
                                    "--density", "B", "--sequential"});
  EXPECT_EQ(gate.exit_code, 1);
  EXPECT_THAT(gate.out, AllOf(HasSubstr("luminance squared"), HasSubstr("--sequential")));
  const json results = json_of(folder / "g.json");
  EXPECT_EQ(results.at("tests")[0].at("test"), "sequential");
  EXPECT_LT(results.at("tests")[0].at("samples"), 1 << 20);
}

TEST(GateRejections, AreWrittenAsFiles) {
  const TemporaryFolder folder;
  const std::string target = (folder / "rejected").string();
  const Finished gate = lightproof({"gate", "sun-sky", "--size", "128x64", "--sampler", "squared",
                                    "-n", "65536", "-q", "--rejections", target});
  EXPECT_EQ(gate.exit_code, 1);
  EXPECT_THAT(names_in(folder / "rejected"),
              ElementsAre("manifest.json", "squared-A-sun-sky-residual.exr",
                          "squared-A-sun-sky-residual.png", "squared-A-sun-sky.json",
                          "squared-B-sun-sky-residual.exr", "squared-B-sun-sky-residual.png",
                          "squared-B-sun-sky.json", "squared-C-sun-sky-residual.exr",
                          "squared-C-sun-sky-residual.png", "squared-C-sun-sky.json"));
  const json rejection = json_of(folder / "rejected" / "squared-B-sun-sky.json");
  EXPECT_EQ(rejection.at("looks_like"), "squared");
  EXPECT_EQ(rejection.at("worst_bins").size(), 20U);
  EXPECT_EQ(rejection.at("cumulative_row_divergence").size(), 64U);
  const std::string replay = rejection.at("replay");
  EXPECT_THAT(replay, AllOf(HasSubstr("--sampler squared"), HasSubstr("--size 128x64"),
                            HasSubstr("--samples 65536"), HasSubstr("--seed 1")));
}

TEST(GateRejections, ReplaceThoseOfAnEarlierRunIfForced) {
  const TemporaryFolder folder;
  const auto gate = [&](const Words& more) {
    Words words = {"gate",  "sun-sky", "--size",       "128x64",   "-n",
                   "65536", "-q",      "--rejections", "rejected", "--sampler"};
    words.insert(words.end(), more.begin(), more.end());
    return lightproof(words, folder / "");
  };
  EXPECT_EQ(gate({"squared"}).exit_code, 1);
  write_bytes(folder / "rejected/notes.txt", "mine");
  const Finished refused = gate({"alias"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err,
              AllOf(HasSubstr("rejected"), HasSubstr("--force"), HasSubstr("This would go on: ")));
  EXPECT_GT(names_in(folder / "rejected").size(), 2U);
  EXPECT_NE(gate({"alias", "--force"}).exit_code, 2);
  EXPECT_THAT(names_in(folder / "rejected"), ElementsAre("manifest.json", "notes.txt"));
  // A name that may be needed is refused at once: so many samples would take days.
  write_bytes(folder / "rejected/squared-A-sun-sky.json", "mine");
  const Finished in_the_way = gate({"squared", "--force", "-n", "1099511627776"});
  EXPECT_EQ(in_the_way.exit_code, 2);
  EXPECT_THAT(in_the_way.err, HasSubstr("squared-A-sun-sky.json: would be written over"));
}

TEST(GateGithub, PrintsOneAnnotationForEachDefectEvenIfQuiet) {
  const Finished gate = lightproof({"gate", "sun-sky", "--size", "128x64", "--sampler", "squared",
                                    "-n", "65536", "-q", "--github"});
  EXPECT_EQ(gate.exit_code, 1);
  EXPECT_EQ(std::count(gate.out.begin(), gate.out.end(), '\n'), 3) << gate.out;
  EXPECT_THAT(gate.out, AllOf(StartsWith("::error title=lightproof%3A squared "),
                              HasSubstr("looks like: "), HasSubstr("Again: lightproof gate ")));
}

TEST(Gate, LeavesOutKnownDefects) {
  Words correct;
  for (const SamplerInfo& sampler : samplers()) {
    if (!sampler.known_defects) correct.emplace_back(sampler.name);
  }
  EXPECT_EQ(values_of(gate_results({"constant"}), "sampler"), correct);
  EXPECT_EQ(values_of(gate_results({"constant", "--sound-only"}), "sampler"), correct)
      << "scripts of earlier versions go on";
  const Finished both =
      lightproof({"gate", "--with-published", "--sampler", "linear_scan_published"});
  EXPECT_EQ(both.exit_code, 2);
  EXPECT_THAT(both.err, AllOf(HasSubstr("--with-published"), HasSubstr("--sampler")));
}

TEST(GateSamplers, OfDirectionsTakeNoMap) {
  const Finished gate = quick_gate({"sun-sky", "--sampler", "cosine_hemisphere"});
  EXPECT_EQ(gate.exit_code, 2) << gate.out;
  EXPECT_THAT(gate.err, AllOf(HasSubstr("cosine_hemisphere"), HasSubstr("needs no map")));
  const Words both = {"sun-sky", "--sampler", "cosine_hemisphere", "--sampler", "alias"};
  const Finished mixed = quick_gate(both);
  EXPECT_NE(mixed.exit_code, 2) << mixed.out;
  EXPECT_THAT(mixed.err, HasSubstr("cosine_hemisphere draws directions and needs no map"));
  EXPECT_THAT(values_of(gate_results(both), "map"), ElementsAre("sun-sky", "directions"));
}

// By one name: what runs without a map, and everything.
TEST(GateSamplers, OfDirectionsGoByGroups) {
  const auto names = [](const char* group) {
    return values_of(gate_results({"--sampler", group, "-n", "1024"}), "sampler");
  };
  const Words some = names("directions");
  EXPECT_THAT(some, AllOf(Contains("cosine_quaternion"), Contains("phong_89.9"),
                          Contains("ggx_visible_0.6_45"), Not(Contains("ggx_visible_0.3_45"))));
  const Finished mixed = quick_gate({"sun-sky", "--sampler", "directions"});
  EXPECT_EQ(mixed.exit_code, 2);
  EXPECT_THAT(mixed.err, HasSubstr("--sampler: directions draws directions and needs no map"));
}

TEST(GateSamplers, NamedTwiceAreTestedOnce) {
  EXPECT_THAT(values_of(gate_results({"sun-sky", "--sampler", "alias", "--sampler", "eytzinger",
                                      "--sampler", "alias"}),
                        "sampler"),
              ElementsAre("alias", "eytzinger"));
  EXPECT_EQ(gate_results({"--sampler", "cosine_hemisphere", "--sampler", "cosine_hemisphere"})
                .at("tests")
                .size(),
            gate_results({"--sampler", "cosine_hemisphere"}).at("tests").size());
}

TEST(GateSamplers, OfDirectionsHaveNoDensityOfAMap) {
  const Finished gate = quick_gate({"--sampler", "cosine_hemisphere", "--density", "B"});
  EXPECT_EQ(gate.exit_code, 2) << gate.out;
  EXPECT_THAT(gate.err, AllOf(HasSubstr("--density"), HasSubstr("leave the option out")));
}

// The command that stands beside a rejection gives the same bits, out of a run over more samplers
// and with other files, and without what was only for the eyes.
class GateReplay : public testing::TestWithParam<bool> {};

TEST_P(GateReplay, ReproducesTheSameBits) {
  const TemporaryFolder folder;
  write_map(folder / "a map.exr", {64, 32});
  const std::string map = (folder / "a map.exr").string();
  const std::filesystem::path rejected = folder / "rejected";
  Words gate = {"gate",         map,
                "--sampler",    "binary_search",
                "--sampler",    "t-flipped-in-both",
                "--sampler",    "squared",
                "--any-aspect", "-n",
                "65536",        "--seed",
                "77",           "-q",
                "--json",       (folder / "whole.json").string(),
                "--rejections", rejected.string()};
  if (GetParam()) gate.emplace_back("--sequential");
  const Finished whole = lightproof(gate);
  ASSERT_EQ(whole.exit_code, 1) << whole.err;
  const json all = json_of(folder / "whole.json");
  std::size_t replayed = 0;
  for (const std::string& file : names_in(rejected)) {
    if (!file.ends_with(".json") || file == "manifest.json") continue;
    const json rejection = json_of(rejected / file);
    const std::string replay = rejection.at("replay");
    const std::string words = replay.substr(std::string_view("lightproof ").size());
    const std::string script = fmt::format("cd '{}' && '{}' {} -q --json again.json",
                                           rejected.parent_path().string(), program(), words);
    const Finished again = Process({{"/bin/sh", "-c", script}}).wait();
    EXPECT_EQ(again.exit_code, 1) << replay << again.err;
    std::vector<json> expected;
    for (const json& test : all.at("tests")) {
      if (test.at("sampler") == rejection.at("sampler") &&
          test.at("density") == rejection.at("density")) {
        expected.push_back(test);
      }
    }
    EXPECT_GT(expected.size(), GetParam() ? 5U : 10U);
    EXPECT_EQ(json_of(folder / "again.json").at("tests"), json(expected)) << replay;
    ++replayed;
  }
  EXPECT_EQ(replayed, 6U);
}

INSTANTIATE_TEST_SUITE_P(Whole, GateReplay, testing::Values(false, true),
                         [](const auto& param_info) {
                           return param_info.param ? "sequential" : "fixed";
                         });

// Without --seed it is the date, in eight digits.
TEST(GateLevel, OfTheNightHasAnotherSeedEveryDay) {
  const TemporaryFolder folder;
  EXPECT_EQ(gate_into(folder / "g.json", {"gate", "constant", "--size", "8x4", "--sampler",
                                          "linear_scan", "--density", "B", "--level", "nightly"})
                .exit_code,
            0);
  const json results = json_of(folder / "g.json");
  EXPECT_EQ(results.at("samples"), 1 << 26);
  EXPECT_GT(results.at("seed"), 20200101);
  EXPECT_LT(results.at("seed"), 30000000);
}

}  // namespace
}  // namespace lightproof::test
