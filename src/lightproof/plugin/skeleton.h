// A plug-in to begin with: sources of a sampler that works, and what builds it.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lightproof {

/// A language that skeletons are written in.
struct SkeletonLanguage {
  std::string_view name;     ///< "c++"
  std::string_view build;    ///< the command that builds it, in its folder
  std::string_view library;  ///< what that makes, seen from the folder, with `@NAME@` in it
};

/// All languages.
std::span<const SkeletonLanguage> skeleton_languages();

/// A file of a skeleton.
struct SkeletonFile {
  std::string path;  ///< in the folder
  std::string text;
};

/// The name of a sampler that goes by a folder's: its letters, digits and underscores, others as
/// underscores, behind "sampler_" if it begins with a digit or is empty.
std::string sampler_name_of(std::string_view folder);

/// The files of a skeleton for a sampler of this name.
std::vector<SkeletonFile> skeleton(const SkeletonLanguage& language, const std::string& name);

/// The text with the sampler's name for `@NAME@`.
std::string with_name(std::string_view text, std::string_view name);

}  // namespace lightproof
