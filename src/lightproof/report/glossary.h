// Words that a reader may not know, explained where they first stand.
#pragma once

#include <string>

namespace lightproof {

/// A page's body in which the first of each word of the glossary is an `<abbr>` with its meaning.
/// Tags, scripts, drawings, lists to choose from and what is an `<abbr>` already stay as they are.
std::string with_words_explained(const std::string& html);

}  // namespace lightproof
