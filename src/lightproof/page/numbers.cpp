#include "lightproof/page/numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace lightproof {
namespace {

constexpr std::string_view kMinus = "\u2212";

std::string with_true_minus(const std::string& ascii) {
  std::string text;
  for (const char c : ascii) {
    if (c == '-') {
      text += kMinus;
    } else {
      text += c;
    }
  }
  return text;
}

/// "1.23e-07" to "1.23e-7".
std::string short_exponent(const std::string& text) {
  const std::size_t e = text.find('e');
  if (e == std::string::npos) return text;
  std::size_t digit = e + 1;
  std::string sign;
  if (text[digit] == '-') sign = "-";
  if (text[digit] == '-' || text[digit] == '+') ++digit;
  while (digit + 1 < text.size() && text[digit] == '0') ++digit;
  return text.substr(0, e + 1) + sign + text.substr(digit);
}

}  // namespace

std::string significant(double value, int digits) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value < 0.0 ? "-inf" : "inf";
  if (value == 0.0) return "0";
  if (value == std::floor(value) && std::abs(value) < std::min(1e6, std::pow(10.0, digits))) {
    return fmt::format("{:.0f}", value);
  }
  // Rounding first: 99999.9 to three digits is 100000, which needs no exponent.
  const double size = std::abs(std::stod(fmt::format("{:.{}e}", value, digits - 1)));
  if (size < 1e-3 || size >= 1e6) return short_exponent(fmt::format("{:.{}g}", value, digits));
  const int decimals = std::max(0, digits - 1 - static_cast<int>(std::floor(std::log10(size))));
  return fmt::format("{:.{}f}", value, decimals);
}

std::string format_number(double value, int digits) {
  if (std::isnan(value)) return "n/a";
  if (std::isinf(value)) return value < 0.0 ? "\u2212\u221e" : "\u221e";
  return with_true_minus(significant(value, digits));
}

std::string with_error(double value, double error) {
  if (!std::isfinite(value) || !std::isfinite(error) || error <= 0.0) return format_number(value);
  const int decimals = std::clamp(1 - static_cast<int>(std::floor(std::log10(error))), 0, 9);
  return with_true_minus(fmt::format("{:.{}f}", value, decimals)) +
         fmt::format(" \u00b1 {:.{}f}", error, decimals);
}

std::string percent(double fraction) { return format_number(100.0 * fraction, 2) + "\u00a0%"; }

std::string percent_with_error(double fraction, double error) {
  if (!(error > 0.0) || !std::isfinite(error)) return percent(fraction);
  return with_error(100.0 * fraction, 100.0 * error) + "\u00a0%";
}

std::string seconds_text(double seconds) {
  struct Unit {
    double seconds;
    std::string_view name;
  };
  constexpr std::array<Unit, 3> kSmall = {{{1e-6, "ns"}, {1e-3, "\u00b5s"}, {1.0, "ms"}}};
  // 999.5 of a unit would be written as 1000.
  for (const auto& [limit, name] : kSmall) {
    if (seconds < 0.9995 * limit) {
      return fmt::format("{}\u00a0{}", format_number(seconds / limit * 1000.0, 2), name);
    }
  }
  return format_number(seconds, 2) + "\u00a0s";
}

std::string with_thousands(std::uint64_t value) {
  std::string digits = std::to_string(value);
  for (std::size_t end = digits.size(); end > 3; end -= 3) digits.insert(end - 3, ",");
  return digits;
}

std::string count_word(std::size_t count) {
  constexpr std::array<std::string_view, 13> kWords = {"no",   "one",    "two",   "three", "four",
                                                       "five", "six",    "seven", "eight", "nine",
                                                       "ten",  "eleven", "twelve"};
  return count < kWords.size() ? std::string(kWords[count]) : with_thousands(count);
}

std::string counted(std::size_t count, std::string_view noun) {
  return fmt::format("{} {}{}", with_thousands(count), noun, count == 1 ? "" : "s");
}

std::string bytes_text(double bytes) {
  constexpr std::array<std::string_view, 4> kUnits = {"B", "KiB", "MiB", "GiB"};
  std::size_t unit = 0;
  for (; unit + 1 < kUnits.size() && bytes >= 1024.0; ++unit) bytes /= 1024.0;
  return fmt::format("{}\u00a0{}", format_number(bytes), kUnits[unit]);
}

std::string extent_text(Extent extent) {
  return fmt::format("{}\u00d7{}", extent.width, extent.height);
}

}  // namespace lightproof
