// Names that the user mistyped, answered with the one that was probably meant.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lightproof::cli {

/// The known name that takes the fewest changes of a letter to reach from `typed`: a letter
/// inserted, left out, replaced, or swapped with its neighbour (optimal string alignment); capitals
/// count as small letters. None if even that takes more than a third of the letters.
std::optional<std::string> nearest_name(std::string_view typed, std::span<const std::string> known);

/// "there is no sampler 'walker'", and if a known name is near: "; did you mean 'alias'?"
std::string no_such_name(std::string_view kind, std::string_view typed,
                         std::span<const std::string> known);

/// "a, b, c".
std::string listed(std::span<const std::string> names);

/// The names of the rows of a registry.
template <class Range>
std::vector<std::string> names_of(const Range& range) {
  std::vector<std::string> names;
  for (const auto& row : range) names.emplace_back(row.name);
  return names;
}

/// For CLI::Option::check(): empty if the text is one of `known`, else the reason that it is not.
std::function<std::string(const std::string&)> one_of(std::string kind,
                                                      std::vector<std::string> known);

}  // namespace lightproof::cli
