#include "command_line.h"

#include <algorithm>

#include "lightproof/core/text_escapes.h"

namespace lightproof::cli {

std::string text_of(const CommandLine& line) {
  std::string text;
  for (const std::string& word : line) text += (text.empty() ? "" : " ") + shell_word(word);
  return text;
}

CommandLine with_flags(CommandLine line, const std::vector<std::string>& flags) {
  line.insert(std::find(line.begin(), line.end(), "--"), flags.begin(), flags.end());
  return line;
}

}  // namespace lightproof::cli
