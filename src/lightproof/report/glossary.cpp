#include "lightproof/report/glossary.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <string_view>
#include <vector>

#include "lightproof/page/html.h"

namespace lightproof {
namespace {

/// A word, in lower case, and what it means.
struct Word {
  std::string_view word;
  std::string_view meaning;
};

constexpr std::array kGlossary = {
    Word{"family-wise error",
         "the probability that a run over correct samplers rejects any of them: all of its tests "
         "together are one family"},
    Word{"oracle",
         "what samples are held against: the map itself, exact integrals of it, or the sampler's "
         "own density"},
    Word{"oracles",
         "what samples are held against: the map itself, exact integrals of it, or the sampler's "
         "own density"},
    Word{"effect", "how far samples are off, relative to what is expected, whatever their number"},
    Word{"effects", "how far samples are off, relative to what is expected, whatever their number"},
    Word{"environment a",
         "directions drawn from the map, texels in proportion to their luminance (texture-space)"},
    Word{"environment b",
         "directions drawn from the map, in proportion to luminance times solid angle"},
    Word{"environment c",
         "directions drawn from the map, texels in proportion to luminance times solid angle, and "
         "evenly in (s,t) inside a texel, as pbrt-v3, Mitsuba and Cycles do"},
    Word{
        "stage",
        "a test whose p-value is small is run again with new samples, and more of them: the second "
        "stage; it alone can reject"},
    Word{"transformed pair",
         "a sample taken back through the map's own cumulative distribution to two numbers, which "
         "must be uniform and independent"},
    Word{"effective fraction",
         "the share of the sphere from which an even light would have the same variance under "
         "uniform sampling"},
    Word{"receiver", "the surface that the map lights: its visible points are the shading points"},
    Word{
        "resolution-limited",
        "off by no more than 32-bit floating-point numbers must be: neither accepted nor rejected"},
    Word{"pareto front", "what nothing else beats in all ways at once"},
    Word{"rmse", "root mean square error"},
    Word{"log10 p",
         "the logarithm to base 10 of the probability that a correct sampler deviates as much: "
         "\u22126 is one in a million"},
};

/// Elements whose text stays as it is.
constexpr std::array<std::string_view, 6> kLeftAlone = {"script", "style", "svg",
                                                        "select", "abbr",  "code"};

bool is_letter(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_';
}

char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

/// The name of the element that a tag begins; empty of others.
std::string_view element_of(std::string_view tag) {
  std::size_t end = 1;
  while (end < tag.size() && is_letter(tag[end])) ++end;
  return tag.substr(1, end - 1);
}

/// Behind the end of an element that is left alone, or of the tag itself.
std::size_t end_of_tag(std::string_view html, std::size_t begin) {
  const std::size_t end = html.find('>', begin);
  if (end == std::string_view::npos) return html.size();
  const std::string_view name = element_of(html.substr(begin, end - begin));
  if (std::find(kLeftAlone.begin(), kLeftAlone.end(), name) == kLeftAlone.end()) return end + 1;
  const std::string close = fmt::format("</{}>", name);
  const std::size_t closing = html.find(close, end);
  return closing == std::string_view::npos ? html.size() : closing + close.size();
}

bool stands_at(std::string_view text, std::size_t at, std::string_view word) {
  if (at + word.size() > text.size()) return false;
  if (at > 0 && is_letter(text[at - 1])) return false;
  if (at + word.size() < text.size() && is_letter(text[at + word.size()])) return false;
  return std::equal(word.begin(), word.end(), text.begin() + static_cast<std::ptrdiff_t>(at),
                    [](char a, char b) { return a == lower(b); });
}

/// Words that were not explained yet.
class Unexplained {
 public:
  /// Text without tags, with what stands there for the first time explained.
  std::string explain(std::string_view text) {
    std::string html;
    for (std::size_t at = 0; at < text.size();) {
      const std::optional<Word> word = taken_at(text, at);
      const std::size_t length = word ? word->word.size() : 1;
      const std::string_view part = text.substr(at, length);
      html += word ? fmt::format("<abbr tabindex=\"0\" title=\"{}\">{}</abbr>",
                                 escaped(word->meaning), part)
                   : std::string(part);
      at += length;
    }
    return html;
  }

 private:
  std::optional<Word> taken_at(std::string_view text, std::size_t at) {
    const auto found = std::find_if(words_.begin(), words_.end(), [&](const Word& word) {
      return stands_at(text, at, word.word);
    });
    if (found == words_.end()) return std::nullopt;
    const Word word = *found;
    std::erase_if(words_, [&](const Word& other) { return other.meaning == word.meaning; });
    return word;
  }

  std::vector<Word> words_{kGlossary.begin(), kGlossary.end()};
};

}  // namespace

std::string with_words_explained(const std::string& html) {
  Unexplained words;
  std::string explained;
  explained.reserve(html.size() + 8192);
  const std::string_view all = html;
  for (std::size_t at = 0; at < all.size();) {
    const std::size_t tag = std::min(all.find('<', at), all.size());
    explained += words.explain(all.substr(at, tag - at));
    const std::size_t end = tag == all.size() ? tag : end_of_tag(all, tag);
    explained += all.substr(tag, end - tag);
    at = end;
  }
  return explained;
}

}  // namespace lightproof
