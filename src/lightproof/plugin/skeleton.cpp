#include "lightproof/plugin/skeleton.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "lightproof/plugin/skeleton_files.h"

namespace lightproof {
namespace {

constexpr std::string_view kNamePlaceholder = "@NAME@";
constexpr std::string_view kHeader = "lightproof_plugin.h";
constexpr std::string_view kCMakeBuild = "cmake -B build && cmake --build build";

constexpr std::array kLanguages = {
    SkeletonLanguage{"c", kCMakeBuild, "build/lib@NAME@.so"},
    SkeletonLanguage{"c++", kCMakeBuild, "build/lib@NAME@.so"},
    SkeletonLanguage{"rust", "cargo build --release", "target/release/lib@NAME@.so"},
};

}  // namespace

std::span<const SkeletonLanguage> skeleton_languages() { return kLanguages; }

std::string sampler_name_of(std::string_view folder) {
  std::string name(folder);
  std::ranges::replace_if(
      name, [](unsigned char c) { return c >= 0x80 || std::isalnum(c) == 0; }, '_');
  if (name.empty() || std::isdigit(static_cast<unsigned char>(name.front())) != 0) {
    name.insert(0, "sampler_");
  }
  return name;
}

std::string with_name(std::string_view text, std::string_view name) {
  std::string result;
  for (;;) {
    const std::size_t at = text.find(kNamePlaceholder);
    result += text.substr(0, at);
    if (at == std::string_view::npos) return result;
    result += name;
    text.remove_prefix(at + kNamePlaceholder.size());
  }
}

std::vector<SkeletonFile> skeleton(const SkeletonLanguage& language, const std::string& name) {
  const std::string folder = std::string(language.name) + "/";
  std::vector<SkeletonFile> files;
  for (const SkeletonSource& source : skeleton_sources()) {
    if (source.path == kHeader) {
      files.push_back({std::string(kHeader), std::string(source.text)});
    } else if (source.path.starts_with(folder)) {
      files.push_back(
          {std::string(source.path.substr(folder.size())), with_name(source.text, name)});
    }
  }
  return files;
}

}  // namespace lightproof
