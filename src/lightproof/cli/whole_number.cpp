#include "whole_number.h"

#include <charconv>
#include <string>

namespace lightproof::cli {
namespace {

constexpr std::string_view kDigits = "0123456789";
constexpr int kMostTens = 19;  // 10^20 has no room in 64 bits

std::optional<std::uint64_t> power_of_two(std::string_view exponent) {
  const auto bits = whole_number_in_digits(exponent);
  if (!bits || *bits > 63) return std::nullopt;
  return std::uint64_t{1} << *bits;
}

/// `digits` times 10^tens, if that is whole and fits.
std::optional<std::uint64_t> scaled(std::string digits, int tens) {
  for (; tens < 0 && digits.ends_with('0'); ++tens) digits.pop_back();
  if (digits.find_first_not_of('0') == std::string::npos) return 0;
  if (tens < 0 || tens > kMostTens) return std::nullopt;
  return whole_number_in_digits(digits + std::string(static_cast<std::size_t>(tens), '0'));
}

/// The power of ten that stands behind the digits: of "e6", "k", "M", "G".
std::optional<int> tens_of(std::string_view suffix) {
  if (suffix == "k" || suffix == "K") return 3;
  if (suffix == "M") return 6;
  if (suffix == "G") return 9;
  if (!suffix.starts_with('e') && !suffix.starts_with('E')) return std::nullopt;
  suffix.remove_prefix(suffix.substr(1).starts_with('+') ? 2 : 1);
  const auto exponent = whole_number_in_digits(suffix);
  if (!exponent || *exponent > kMostTens) return std::nullopt;
  return static_cast<int>(*exponent);
}

}  // namespace

std::optional<std::uint64_t> whole_number_in_digits(std::string_view text) {
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

std::optional<std::uint64_t> whole_number(std::string_view text) {
  if (text.starts_with("2^")) return power_of_two(text.substr(2));
  const std::size_t before = std::min(text.find_first_not_of(kDigits), text.size());
  if (before == 0) return std::nullopt;
  if (before == text.size()) return whole_number_in_digits(text);
  std::string digits(text.substr(0, before));
  std::string_view rest = text.substr(before);
  int tens = 0;
  if (rest.starts_with('.')) {
    const std::size_t end = std::min(rest.find_first_not_of(kDigits, 1), rest.size());
    if (end == 1) return std::nullopt;
    digits += rest.substr(1, end - 1);
    tens -= static_cast<int>(end) - 1;
    rest.remove_prefix(end);
  }
  const std::optional<int> suffix = tens_of(rest);
  if (!suffix) return std::nullopt;
  return scaled(digits, tens + *suffix);
}

}  // namespace lightproof::cli
