// Rows of text as tables for a terminal.
#pragma once

#include <string>
#include <vector>

namespace lightproof {

/// The cells of a table, row by row.
using TextRows = std::vector<std::vector<std::string>>;

/// The lines of a table, one a row and without its end: columns as wide as their widest cell, two
/// spaces between them. Cells are written as terminal_text().
std::vector<std::string> aligned_lines(const TextRows& rows);

}  // namespace lightproof
