#include "lightproof/core/text_escapes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <optional>

namespace lightproof {
namespace {

/// One character of UTF-8, or one byte that is none.
struct Character {
  std::string_view bytes;
  std::optional<std::uint32_t> code_point;  ///< none: no UTF-8
};

std::uint32_t byte_at(std::string_view text, std::size_t i) {
  return static_cast<unsigned char>(text[i]);
}

/// The length that a first byte announces; 0 if it is none.
std::size_t announced_length(std::uint32_t first) {
  if (first < 0x80U) return 1;
  if (first < 0xC2U) return 0;
  if (first < 0xE0U) return 2;
  if (first < 0xF0U) return 3;
  return first < 0xF5U ? 4 : 0;
}

/// `text` is not empty.
Character first_character(std::string_view text) {
  const Character bad{text.substr(0, 1), std::nullopt};
  const std::size_t length = announced_length(byte_at(text, 0));
  if (length == 0 || length > text.size()) return bad;
  std::uint32_t point = length == 1 ? byte_at(text, 0) : byte_at(text, 0) & (0x7FU >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte_at(text, i) & 0xC0U) != 0x80U) return bad;
    point = (point << 6U) | (byte_at(text, i) & 0x3FU);
  }
  const bool surrogate = point >= 0xD800U && point < 0xE000U;
  const bool overlong = (length == 3 && point < 0x800U) || (length == 4 && point < 0x10000U);
  if (surrogate || overlong || point > 0x10FFFFU) return bad;
  return {text.substr(0, length), point};
}

/// Control characters (C0, DEL, C1), separators of lines and paragraphs, and the marks that turn
/// the direction of writing (Unicode's Bidi_Control).
bool is_control(std::uint32_t point) {
  return point < 0x20U || (point >= 0x7FU && point < 0xA0U) || point == 0x061CU ||
         (point >= 0x200EU && point <= 0x200FU) || (point >= 0x2028U && point <= 0x202EU) ||
         (point >= 0x2066U && point <= 0x2069U);
}

bool is_printable(const Character& character) {
  return character.code_point && !is_control(*character.code_point);
}

std::string hexadecimal(std::string_view bytes) {
  std::string text;
  for (const char c : bytes) text += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
  return text;
}

/// Every character through `replaced`, which returns what stands for it.
template <class Replace>
std::string replaced_characters(std::string_view text, const Replace& replaced) {
  std::string result;
  while (!text.empty()) {
    const Character character = first_character(text);
    result += replaced(character);
    text.remove_prefix(character.bytes.size());
  }
  return result;
}

std::string terminal_character(const Character& character) {
  return is_printable(character) ? std::string(character.bytes) : hexadecimal(character.bytes);
}

/// https://github.github.com/gfm: entities stand for what would be a tag or end a cell. A comment
/// after '@' and '#' keeps GitHub from finding names and numbers there.
std::string markdown_character(const Character& character) {
  const std::string_view c = character.bytes;
  if (c == "\n" || c == "\r" || c == "\t") return " ";
  if (c == "&") return "&amp;";
  if (c == "<") return "&lt;";
  if (c == ">") return "&gt;";
  if (c == "|") return "&#124;";
  if (c == "@" || c == "#") return std::string(c) + "<!-- -->";
  if (c.find_first_of("\\`*[]~$") != std::string_view::npos) return fmt::format("\\{}", c);
  return terminal_character(character);
}

std::string workflow_character(const Character& character, std::string_view encoded) {
  const std::string_view c = character.bytes;
  if (c.size() == 1 && encoded.find(c[0]) != std::string_view::npos) {
    return fmt::format("%{:02X}", static_cast<unsigned char>(c[0]));
  }
  return terminal_character(character);
}

bool is_word_character(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }

/// Between letters and digits GitHub's Markdown takes an underscore as it is.
std::string with_escaped_underscores(const std::string& text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool inside = i > 0 && i + 1 < text.size() && is_word_character(text[i - 1]) &&
                        is_word_character(text[i + 1]);
    if (text[i] == '_' && !inside) result += '\\';
    result += text[i];
  }
  return result;
}

/// The character as it stands inside $'…'.
std::string quoted_character(const Character& character) {
  if (!is_printable(character)) return hexadecimal(character.bytes);
  const bool special = character.bytes == "'" || character.bytes == "\\";
  return fmt::format("{}{}", special ? "\\" : "", character.bytes);
}

}  // namespace

std::string terminal_text(std::string_view text) {
  return replaced_characters(text, terminal_character);
}

std::string terminal_lines(std::string_view text) {
  return replaced_characters(text, [](const Character& character) {
    return character.bytes == "\n" ? "\n" : terminal_character(character);
  });
}

std::string well_formed_text(std::string_view text) {
  return replaced_characters(text, [](const Character& character) {
    const std::uint32_t point = character.code_point.value_or(0);
    const bool allowed = point >= 0x20U || point == '\t' || point == '\n' || point == '\r';
    const bool fits = allowed && point != 0xFFFEU && point != 0xFFFFU;
    return fits ? std::string(character.bytes) : std::string("\xEF\xBF\xBD");
  });
}

std::string markdown_text(std::string_view text) {
  return with_escaped_underscores(replaced_characters(text, markdown_character));
}

std::string workflow_message(std::string_view text) {
  return replaced_characters(text,
                             [](const Character& c) { return workflow_character(c, "%\r\n"); });
}

std::string workflow_property(std::string_view text) {
  return replaced_characters(text,
                             [](const Character& c) { return workflow_character(c, "%\r\n:,"); });
}

std::string shell_word(std::string_view text) {
  const bool plain = !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
    return is_word_character(c) || std::string_view("_-./=+,:@").find(c) != std::string_view::npos;
  });
  if (plain) return std::string(text);
  if (terminal_text(text) != text) {
    return "$'" + replaced_characters(text, quoted_character) + "'";
  }
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

}  // namespace lightproof
