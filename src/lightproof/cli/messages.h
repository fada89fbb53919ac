// Words for whoever watches.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <string_view>
#include <utility>

namespace lightproof::cli {

/// Prints to the standard error, and flushes. Where nobody listens any more, or there is no room,
/// that is no reason to fail: what counts are results and exit code.
template <class... Values>
void tell(fmt::format_string<Values...> form, Values&&... values) {
  const std::string text = fmt::format(form, std::forward<Values>(values)...);
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

/// Prints to one of the standard streams. If it cannot, main() says so of the standard output, and
/// nothing is said of the standard error.
inline void show(std::FILE* stream, std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), stream);
}

/// What a program that fails prints behind the error; empty: nothing.
inline std::string& last_words() {
  static std::string words;
  return words;
}

}  // namespace lightproof::cli
