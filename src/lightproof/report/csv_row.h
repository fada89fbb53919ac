// Rows of CSV files: fields are quoted where they must be, and none is a formula.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "lightproof/core/grid.h"

namespace lightproof::csv_parts {

/// A name that a spreadsheet would take for a formula gets an apostrophe before it, which is not
/// shown.
inline std::string field(std::string_view text) {
  const bool looks_like_formula =
      !text.empty() && std::string_view("=+-@\t").find(text.front()) != std::string_view::npos;
  if (looks_like_formula) return field("'" + std::string(text));
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

inline std::string field(const std::string& text) { return field(std::string_view(text)); }
inline std::string field(const char* text) { return field(std::string_view(text)); }
inline std::string field(double value) { return fmt::format("{}", value); }
inline std::string field(std::uint64_t value) { return std::to_string(value); }
inline std::string field(int value) { return std::to_string(value); }
inline std::string field(Extent extent) {
  return fmt::format("{}x{}", extent.width, extent.height);
}

template <class Value>
std::string field(const std::optional<Value>& value) {
  return value ? field(*value) : "";
}

/// A line with its end.
template <class... Values>
std::string row(const Values&... values) {
  std::string line;
  ((line += field(values), line += ','), ...);
  line.back() = '\n';
  return line;
}

}  // namespace lightproof::csv_parts
