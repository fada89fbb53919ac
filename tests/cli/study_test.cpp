// lightproof study: what it writes. The studies run side by side, once for all tests.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <set>
#include <sstream>
#include <string>

#include "lightproof/image/reader.h"
#include "tests/cli/program.h"
#include "tests/cli/schema.h"

namespace lightproof::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::AllOf;
using testing::AnyOf;
using testing::Contains;
using testing::Each;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

const Words kStudy = {
    "study",           "constant",       "--size",       "32x16",          "-n", "65536",
    "--no-throughput", "--no-self-test", "--no-regimes", "--no-stability", "-o", "report"};
constexpr const char* kPlugin = "correct";  // its file, and the name that it gives itself
constexpr auto kLimit = std::chrono::seconds(1000);

/// A disk of 64 kB, on which an earlier report lies; then what is on it.
const std::string kOnFullDisk =
    "mount -t tmpfs -o size=64k none report && echo earlier > report/report.html && "
    "echo older > report/constant-sphere-on-plane-phong-brdf.exr && "
    "echo '{\"format\": \"lightproof manifest\", \"files\": [\"report.html\", "
    "\"constant-sphere-on-plane-phong-brdf.exr\"]}' > report/manifest.json && \"$@\" --force; "
    "code=$?; ls -A report; cat report/*.exr report/report.html; exit $code";

/// The folder of the studies and how they ended.
struct Studies {
  Studies();

  TemporaryFolder folder;
  Finished plain;
  std::optional<Finished> full;  ///< none where mount namespaces are not available
};

Studies::Studies() {
  for (const char* name : {"plain", "full", "full/report"}) fs::create_directory(folder / name);
  Words with_plugin = kStudy;
  with_plugin.insert(with_plugin.end(),
                     {"--plugin", std::string(LIGHTPROOF_TEST_PLUGINS) + "/" + kPlugin + ".so"});
  Process first(lightproof_command(with_plugin, folder / "plain"));
  if (has_mount_namespaces()) {
    Words quiet = kStudy;
    quiet.insert(quiet.end(), {"--progress", "0"});
    full = Process(in_mount_namespace(kOnFullDisk, quiet, folder / "full")).wait(kLimit);
  }
  plain = first.wait(kLimit);
}

class Study : public testing::Test {
 protected:
  static void SetUpTestSuite() { studies() = std::make_unique<Studies>(); }
  static void TearDownTestSuite() { studies().reset(); }

  static const Finished& plain() { return studies()->plain; }
  static const std::optional<Finished>& full() { return studies()->full; }
  static fs::path path(const std::string& name) {
    return studies()->folder / ("plain/report/" + name);
  }

 private:
  static std::unique_ptr<Studies>& studies() {
    static std::unique_ptr<Studies> all;
    return all;
  }
};

TEST_F(Study, EndsWithThePathOfItsReport) {
  EXPECT_EQ(plain().exit_code, 0);
  EXPECT_EQ(plain().out, "report/report.html\n");
}

TEST_F(Study, SaysHowLongEachStepTookWhereNobodySeesABar) {
  for (const char* step : {"exact light", "convergence"}) {
    EXPECT_THAT(plain().err,
                testing::ContainsRegex(std::string("(^|\n)") + step + ": done in [0-9.]+ s\n"));
  }
  std::istringstream lines(plain().err);
  for (std::string line; std::getline(lines, line);) {
    EXPECT_THAT(line, testing::MatchesRegex(".+: (done in [0-9.]+ s|[0-9]+ %.*)"));
  }
}

TEST_F(Study, WritesOneSelfContainedPage) {
  const std::string page = bytes_of(path("report.html"));
  EXPECT_THAT(page, AllOf(StartsWith("<!"), HasSubstr("</html>"), HasSubstr("constant")));
  EXPECT_THAT(page, Not(AnyOf(HasSubstr("<script src="), HasSubstr("<link rel=\"stylesheet\""))));
}

TEST_F(Study, WritesResultsAsJson) {
  const json results = json_of(path("results.json"));
  EXPECT_EQ(results.at("gate").at("outcome"), "accept");
  EXPECT_EQ(results.at("maps").at(0).at("name"), "constant");
  EXPECT_FALSE(results.at("convergence").empty());
  EXPECT_TRUE(results.at("throughput").empty());
  for (const json& render : results.at("renders")) {
    for (const char* key : {"picture", "error", "reference"}) {
      EXPECT_TRUE(fs::exists(path(render.at(key)))) << render.dump();
    }
  }
}

TEST_F(Study, WritesTablesWithAHeadAndRows) {
  for (const char* name : {"gate.csv", "convergence.csv", "variance.csv", "renders.csv", "maps.csv",
                           "frames.csv", "points.csv", "discrepancy.csv", "decay.csv",
                           "split_sum.csv", "accuracy.csv", "published.csv"}) {
    const std::string table = bytes_of(path(name));
    EXPECT_GE(std::count(table.begin(), table.end(), '\n'), 2) << name;
    EXPECT_NE(table.find(','), std::string::npos) << name;
  }
}

TEST_F(Study, WritesPicturesThatCanBeRead) {
  int pictures = 0;
  for (const std::string& name : names_in(path(""))) {
    if (!name.ends_with(".exr") || name.ends_with("-error.exr")) continue;
    const EnvironmentMap picture = read_environment_map(path(name), {.any_aspect = true});
    EXPECT_EQ(picture.radiance.extent(), (Extent{128, 96})) << name;
    ++pictures;
  }
  const json renders = json_of(path("results.json")).at("renders");
  std::set<std::string> references;
  for (const json& render : renders) references.insert(render.at("reference"));
  EXPECT_EQ(references.size(), 2U);
  EXPECT_EQ(pictures, static_cast<int>(renders.size() + references.size()));
}

TEST_F(Study, NamesFilesWithoutSpaces) {
  EXPECT_THAT(names_in(path("")), Each(Not(HasSubstr(" "))));
}

TEST_F(Study, ListsItsFilesInAManifest) {
  Words names = json_of(path("manifest.json")).at("files");
  names.emplace_back("manifest.json");
  EXPECT_THAT(names, testing::UnorderedElementsAreArray(names_in(path(""))));
  EXPECT_TRUE(json_of(path("manifest.json")).at("complete"));
}

TEST_F(Study, WritesJsonThatItsSchemasDescribe) {
  expect_valid("study.schema.json", path("results.json"));
  expect_valid("manifest.schema.json", path("manifest.json"));
}

TEST_F(Study, LeavesNoPartsBehind) { EXPECT_THAT(parts_in(path("")), IsEmpty()); }

/// Tests of our samplers on maps, without what depends on the number of all tests: a study has
/// more.
std::vector<json> verdicts_on_maps(const json& gate) {
  std::vector<json> tests;
  for (json test : gate.at("tests")) {
    test.erase("minimum_detectable_effect");
    if (test.at("map") == "directions" || test.at("sampler") == kPlugin) continue;
    tests.push_back(std::move(test));
  }
  return tests;
}

TEST_F(Study, TestsAPluginBesideTheSamplersOfTheRegistry) {
  EXPECT_THAT(values_of(json_of(path("results.json")).at("gate"), "sampler"),
              AllOf(Contains(kPlugin), Contains("alias")));
}

/// Likewise: a replay names the number of all tests.
std::vector<json> rejections_of(const json& gate) {
  std::vector<json> rejections;
  for (const char* kind : {"rejections", "known_defects"}) {
    for (json rejection : gate.at(kind)) {
      rejection.erase("replay");
      rejections.push_back(std::move(rejection));
    }
  }
  return rejections;
}

TEST_F(Study, FindsTheSameAsTheGate) {
  const json gate = json_of(path("results.json")).at("gate");
  const TemporaryFolder folder;
  lightproof({"gate", "constant", "--size", "32x16", "-n", "65536", "-q", "--with-published",
              "--json", (folder / "g.json").string()});
  const json alone = json_of(folder / "g.json");
  EXPECT_TRUE(verdicts_on_maps(gate) == verdicts_on_maps(alone));
  EXPECT_EQ(rejections_of(gate), rejections_of(alone));
  EXPECT_GT(gate.at("tests").size(), alone.at("tests").size());
}

// Which of the files that are kept does not fit depends on how long each step takes.
TEST_F(Study, OnAFullDiskNamesFileAndReason) {
  if (!full()) GTEST_SKIP() << "mount namespaces are not available here";
  EXPECT_EQ(full()->exit_code, 2);
  EXPECT_THAT(full()->err, AllOf(StartsWith("lightproof: report/unfinished/"),
                                 HasSubstr("No space left on device")));
}

TEST_F(Study, OnAFullDiskKeepsTheEarlierReportAndLeavesNoParts) {
  if (!full()) GTEST_SKIP() << "mount namespaces are not available here";
  EXPECT_THAT(full()->out, AllOf(HasSubstr("manifest.json\nreport.html\n"),
                                 HasSubstr("\nolder\nearlier\n"), Not(HasSubstr(".part"))));
}

}  // namespace
}  // namespace lightproof::test
