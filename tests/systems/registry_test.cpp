#include "lightproof/systems/registry.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>

namespace lightproof {
namespace {

TEST(Systems, AreAllOfTheFourDocumentsInTheirOrder) {
  std::vector<std::string> expected;
  const std::pair<const char*, int> documents[] = {{"000", 6}, {"002", 6}, {"003", 8}, {"004", 16}};
  for (const auto& [document, count] : documents) {
    for (int i = 1; i <= count; ++i) {
      expected.push_back(std::string(document) + "-" + std::to_string(i));
    }
  }
  std::vector<std::string> ids;
  for (const SystemInfo& system : systems()) ids.emplace_back(system.id);
  EXPECT_EQ(ids, expected);
}

TEST(Systems, StandInADocumentWithATitle) {
  for (const SystemInfo& system : systems()) EXPECT_FALSE(document_of(system).empty()) << system.id;
  EXPECT_TRUE(document_of(systems().front()).starts_with("lecture"));
}

/// "Suite.Name" of every test in the sources. Suites of parameterised tests are known by the class.
std::set<std::string> all_tests() {
  static const std::regex test_macro(R"(TEST(?:_F|_P)?\((\w+),\s*(\w+)\))");
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(LIGHTPROOF_TEST_SOURCES)) {
    if (entry.path().extension() != ".cpp") continue;
    std::ifstream file(entry.path());
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    for (auto found = std::sregex_iterator(text.begin(), text.end(), test_macro);
         found != std::sregex_iterator(); ++found) {
      names.insert((*found)[1].str() + "." + (*found)[2].str());
    }
  }
  return names;
}

TEST(Systems, AreCoveredByTestsThatThereAre) {
  const std::set<std::string> tests = all_tests();
  ASSERT_TRUE(tests.contains("Systems.AreCoveredByTestsThatThereAre"));
  for (const SystemInfo& system : systems()) {
    EXPECT_TRUE(tests.contains(std::string(system.test))) << system.id << ": " << system.test;
  }
}

}  // namespace
}  // namespace lightproof
