// Whether JSON is what its schema in docs/schema says.
#pragma once

#include <filesystem>
#include <string>

namespace lightproof::test {

/// Fails the test with the places and reasons if the file does not follow the schema.
void expect_valid(const std::string& schema, const std::filesystem::path& file);

/// The reasons why it does not; empty if it does.
std::string faults_of(const std::string& schema, const std::filesystem::path& file);

/// Of the schemas themselves: keys without a description, and what JSON Schema forbids.
std::string faults_of_schemas();

}  // namespace lightproof::test
