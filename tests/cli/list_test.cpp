// lightproof list: the registries as text and as JSON.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "tests/cli/program.h"

namespace lightproof::test {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

struct Registry {
  std::string name;
  std::string member;

  friend void PrintTo(const Registry& r, std::ostream* out) { *out << r.name; }
};

class List : public testing::TestWithParam<Registry> {
 protected:
  static Words lines(const std::string& text) {
    Words lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
  }
};

TEST_P(List, StartsEachLineWithAName) {
  const Finished list = lightproof({"list", GetParam().name});
  EXPECT_EQ(list.exit_code, 0);
  EXPECT_THAT(list.err, IsEmpty());
  EXPECT_THAT(lines(list.out), Contains(StartsWith(GetParam().member + " ")));
}

TEST_P(List, SaysTheSameAsJson) {
  const Finished list = lightproof({"list", GetParam().name, "--json"});
  EXPECT_EQ(list.exit_code, 0);
  const auto listed = nlohmann::json::parse(list.out).at("entries");
  const Words text = lines(lightproof({"list", GetParam().name}).out);
  ASSERT_EQ(listed.size(), text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    const std::string name = listed[i].at("name");
    const std::string description = listed[i].at("description");
    EXPECT_THAT(text[i], StartsWith(name + " "));
    EXPECT_THAT(text[i], HasSubstr("  " + description));
    EXPECT_THAT(description, Not(IsEmpty()));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Registries, List,
    testing::Values(Registry{"samplers", "binary_search"}, Registry{"densities", "C"},
                    Registry{"maps", "sun-sky"}, Registry{"presets", "openexr"},
                    Registry{"materials", "phong"}, Registry{"receivers", "sphere-on-plane"},
                    Registry{"estimators", "environment B"}, Registry{"points", "sobol"}),
    [](const auto& test) { return test.param.name; });

TEST(ListSamplers, MarksKnownDefects) {
  EXPECT_THAT(lightproof({"list", "samplers"}).out, HasSubstr("known defects"));
}

TEST(ListEstimators, SaysWhatTheyAre) {
  const auto listed = nlohmann::json::parse(lightproof({"list", "estimators", "--json"}).out);
  const auto entry = [&](const std::string& name) {
    for (const auto& one : listed.at("entries")) {
      if (one.at("name") == name) return one;
    }
    return nlohmann::json();
  };
  EXPECT_EQ(entry("mis balance").at("kind"), "multi-sample");
  EXPECT_EQ(entry("mis balance").at("biased"), false);
  EXPECT_EQ(entry("mis balance").at("source"), "Veach and Guibas 1995");
  EXPECT_EQ(entry("split-sum").at("biased"), true);
  EXPECT_EQ(entry("split-sum").at("ignores_occlusion"), true);
  EXPECT_EQ(entry("split-sum").at("materials"), nlohmann::json({"ggx", "ggx_rough"}));
}

TEST(ListPoints, SaysWhatTheyAre) {
  const Finished list = lightproof({"list", "points"});
  EXPECT_THAT(list.out, HasSubstr("in float as shaders have it; defect: "));
  const auto listed = nlohmann::json::parse(lightproof({"list", "points", "--json"}).out);
  const auto entry = [&](const std::string& name) {
    for (const auto& one : listed.at("entries")) {
      if (one.at("name") == name) return one;
    }
    return nlohmann::json();
  };
  EXPECT_EQ(entry("sobol").at("kind"), "net");
  EXPECT_EQ(entry("sobol").at("finite"), false);
  EXPECT_EQ(entry("sobol").at("float"), false);
  EXPECT_TRUE(entry("sobol").at("defect").is_null());
  EXPECT_EQ(entry("hammersley float").at("finite"), true);
  EXPECT_EQ(entry("hammersley float").at("float"), true);
  EXPECT_FALSE(entry("hammersley float").at("defect").is_null());
}

TEST(ListMaps, NamesMapsThatTheGateTakes) {
  const auto list = nlohmann::json::parse(lightproof({"list", "maps", "--json"}).out);
  for (const auto& map : list.at("entries")) {
    const std::string name = map.at("name");
    EXPECT_EQ(quick_gate({name, "--sampler", "binary_search", "-q"}).exit_code, 0) << name;
  }
}

}  // namespace
}  // namespace lightproof::test
