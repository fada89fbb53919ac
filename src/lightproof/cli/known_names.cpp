#include "known_names.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <utility>

namespace lightproof::cli {
namespace {

std::string in_small_letters(std::string_view text) {
  std::string small(text);
  for (char& c : small) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return small;
}

/// Optimal string alignment: Levenshtein's distance, in which two neighbours that are swapped count
/// as one change.
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> cost(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) cost[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) cost[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = cost[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      cost[i][j] = std::min({cost[i - 1][j] + 1, cost[i][j - 1] + 1, replaced});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) cost[i][j] = std::min(cost[i][j], cost[i - 2][j - 2] + 1);
    }
  }
  return cost[a.size()][b.size()];
}

/// No name of ours is longer; what is costs quadratic time.
constexpr std::size_t kLongestTyped = 100;

}  // namespace

std::optional<std::string> nearest_name(std::string_view typed,
                                        std::span<const std::string> known) {
  if (typed.size() > kLongestTyped) return std::nullopt;
  const std::string small = in_small_letters(typed);
  std::size_t fewest = (typed.size() + 1) / 3 + 1;
  std::optional<std::string> nearest;
  for (const std::string& name : known) {
    const std::size_t changes = distance(small, in_small_letters(name));
    if (changes >= fewest) continue;
    fewest = changes;
    nearest = name;
  }
  return nearest;
}

std::string no_such_name(std::string_view kind, std::string_view typed,
                         std::span<const std::string> known) {
  const std::optional<std::string> near = nearest_name(typed, known);
  return fmt::format("there is no {} '{}'{}", kind, typed,
                     near ? fmt::format("; did you mean '{}'?", *near) : "");
}

std::string listed(std::span<const std::string> names) {
  return fmt::format("{}", fmt::join(names, ", "));
}

std::function<std::string(const std::string&)> one_of(std::string kind,
                                                      std::vector<std::string> known) {
  return [kind = std::move(kind), known = std::move(known)](const std::string& text) {
    if (std::find(known.begin(), known.end(), text) != known.end()) return std::string();
    return fmt::format("{} ({})", no_such_name(kind, text, known), listed(known));
  };
}

}  // namespace lightproof::cli
