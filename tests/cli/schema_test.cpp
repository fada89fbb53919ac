// Every document in JSON against the schema that describes it: a key that no schema names fails.
#include "tests/cli/schema.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/program.h"

namespace lightproof::test {
namespace {

using testing::HasSubstr;

TEST(Schemas, DescribeEveryKeyAndLetNoOtherPass) { EXPECT_EQ(faults_of_schemas(), ""); }

class GateSchema : public testing::TestWithParam<Words> {};

TEST_P(GateSchema, DescribesTheGatesJson) {
  const TemporaryFolder folder;
  write_map(folder / "cold.exr", {8, 4}, [](Grid<Rgb>& picture) { picture(3, 1).b = -1.0F; });
  Words words = GetParam();
  words.insert(words.end(), {"-q", "--json", "g.json", "--rejections", "rejected"});
  EXPECT_NE(quick_gate(words, folder / "").exit_code, 2);
  expect_valid("gate.schema.json", folder / "g.json");
  for (const std::string& name : names_in(folder / "rejected")) {
    if (!name.ends_with(".json")) continue;
    const bool manifest = name == "manifest.json";
    expect_valid(manifest ? "manifest.schema.json" : "rejection.schema.json",
                 folder / ("rejected/" + name));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Runs, GateSchema,
    testing::Values(Words{"constant"}, Words{},
                    Words{"black-first-row", "--with-published", "-n", "65536"},
                    Words{"sun-sky", "--sampler", "squared", "-n", "65536"},
                    Words{"sun-sky", "--sampler", "squared", "--sequential"},
                    Words{"cold.exr", "--repair", "--preset", "mitsuba", "--sampler", "alias"}));

TEST(GateSchema, RefusesAnUnknownKeyAndAWrongType) {
  const TemporaryFolder folder;
  nlohmann::json gate = gate_results({"constant", "--sampler", "alias"});
  gate["tests"][0]["unheard_of"] = 1;
  write_bytes(folder / "g.json", gate.dump());
  EXPECT_THAT(faults_of("gate.schema.json", folder / "g.json"), HasSubstr("unheard_of"));
  gate["tests"][0].erase("unheard_of");
  gate["tests"][0]["effect"] = "large";
  write_bytes(folder / "g.json", gate.dump());
  EXPECT_THAT(faults_of("gate.schema.json", folder / "g.json"), HasSubstr("tests/0/effect"));
}

TEST(GateJson, SaysWhatItWasMadeWith) {
  const TemporaryFolder folder;
  write_map(folder / "cold.exr", {8, 4}, [](Grid<Rgb>& picture) { picture(3, 1).b = -1.0F; });
  quick_gate({"cold.exr", "constant", "--repair", "--preset", "mitsuba", "-q", "--json", "g.json"},
             folder / "");
  const nlohmann::json gate = json_of(folder / "g.json");
  const std::string command = gate.at("command");
  EXPECT_TRUE(command.ends_with(
      "lightproof gate -n 1024 --must-detect 10 --size 8x4 cold.exr constant --repair "
      "--preset mitsuba -q --json g.json"))
      << command;
  EXPECT_EQ(lightproof({"--version"}).out, "lightproof " + std::string(gate.at("version")) + "\n");
  ASSERT_EQ(gate.at("maps").size(), 2U);
  const nlohmann::json& file = gate.at("maps")[0];
  EXPECT_EQ(file.at("file"), "cold.exr");
  EXPECT_EQ(file.at("width"), 8);
  EXPECT_EQ(file.at("height"), 4);
  EXPECT_EQ(file.at("preset"), "mitsuba");
  EXPECT_THAT(file.at("notes").dump(), HasSubstr("Set to 0"));
  EXPECT_EQ(file.at("faults")[0].at("kind"), "negative values");
  EXPECT_EQ(gate.at("maps")[1].at("file"), "constant");
}

TEST(InfoSchema, DescribesOneFileAndSeveral) {
  const TemporaryFolder folder;
  write_map(folder / "cold.exr", {8, 4}, [](Grid<Rgb>& picture) { picture(3, 1).b = -1.0F; });
  for (const Words& files : {Words{"cold.exr"}, Words{"cold.exr", "sun-sky"}}) {
    Words words = {"info", "--json"};
    words.insert(words.end(), files.begin(), files.end());
    const std::string text = lightproof(words, folder / "").out;
    write_bytes(folder / "i.json", text);
    expect_valid("info.schema.json", folder / "i.json");
    EXPECT_THAT(text,
                AllOf(HasSubstr("\"version\""), HasSubstr("lightproof info --json cold.exr")));
  }
}

TEST(ListSchema, DescribesRegistries) {
  const TemporaryFolder folder;
  for (const char* registry : {"samplers", "mutants", "points"}) {
    write_bytes(folder / "l.json", lightproof({"list", registry, "--json"}).out);
    expect_valid("list.schema.json", folder / "l.json");
  }
}

}  // namespace
}  // namespace lightproof::test
