#include "lightproof/page/text_table.h"

#include <algorithm>

#include "lightproof/core/text_escapes.h"

namespace lightproof {
namespace {

/// Columns on the screen: code points of UTF-8 (no wide or combining characters are printed).
std::size_t screen_width(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
  }));
}

TextRows for_terminal(TextRows rows) {
  for (auto& row : rows) {
    for (std::string& cell : row) cell = terminal_text(cell);
  }
  return rows;
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

std::vector<std::string> aligned_lines(const TextRows& unsafe) {
  const TextRows rows = for_terminal(unsafe);
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

}  // namespace lightproof
