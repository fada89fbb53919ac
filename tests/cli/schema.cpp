#include "tests/cli/schema.h"

#include <gtest/gtest.h>

#include "tests/cli/process.h"

namespace lightproof::test {
namespace {

std::string check(std::vector<std::string> arguments) {
  std::vector<std::string> words = {LIGHTPROOF_PYTHON, "-W", "ignore", LIGHTPROOF_SCHEMA_CHECK};
  words.insert(words.end(), arguments.begin(), arguments.end());
  const Finished finished = run({.words = words});
  if (finished.exit_code == 0) return "";
  const std::string text = finished.out + finished.err;
  return text.empty() ? "the check failed without a word" : text;
}

}  // namespace

std::string faults_of(const std::string& schema, const std::filesystem::path& file) {
  return check({schema, file.string()});
}

void expect_valid(const std::string& schema, const std::filesystem::path& file) {
  EXPECT_EQ(faults_of(schema, file), "") << file;
}

std::string faults_of_schemas() { return check({}); }

}  // namespace lightproof::test
