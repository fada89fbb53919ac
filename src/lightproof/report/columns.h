// Rows of text as tables for a terminal and for Markdown.
#pragma once

#include <string>
#include <vector>

namespace lightproof {

using TextRows = std::vector<std::vector<std::string>>;

/// One line a row, without its end: columns as wide as their widest cell, two spaces between them.
std::vector<std::string> aligned_lines(const TextRows& rows);

/// The text without what would end a cell of a Markdown table.
std::string markdown_cell(std::string text);

}  // namespace lightproof
