#include "lightproof/report/columns.h"

#include <algorithm>
#include <string_view>

namespace lightproof {
namespace {

/// Columns on the screen: code points of UTF-8 (no wide or combining characters are printed).
std::size_t screen_width(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
  }));
}

std::vector<std::size_t> column_widths(const TextRows& rows) {
  std::vector<std::size_t> widths;
  for (const auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()), 0);
    for (std::size_t i = 0; i < row.size(); ++i) {
      widths[i] = std::max(widths[i], screen_width(row[i]));
    }
  }
  return widths;
}

}  // namespace

std::vector<std::string> aligned_lines(const TextRows& rows) {
  const std::vector<std::size_t> widths = column_widths(rows);
  std::vector<std::string> lines;
  for (const auto& row : rows) {
    std::string text;
    for (std::size_t i = 0; i < row.size(); ++i) {
      text += row[i];
      if (i + 1 < row.size()) text.append(widths[i] - screen_width(row[i]) + 2, ' ');
    }
    lines.push_back(std::move(text));
  }
  return lines;
}

std::string markdown_cell(std::string text) {
  for (const std::string_view bad : {"\n", "|"}) {
    for (std::size_t at = text.find(bad); at != std::string::npos; at = text.find(bad, at + 1)) {
      text.replace(at, 1, bad == "|" ? "/" : " ");
    }
  }
  return text;
}

}  // namespace lightproof
