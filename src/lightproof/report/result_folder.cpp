#include "lightproof/report/result_folder.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "lightproof/core/error.h"
#include "lightproof/core/file_content.h"
#include "lightproof/core/json_text.h"
#include "lightproof/core/unfinished_work.h"

namespace lightproof {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kMarker = "lightproof manifest";

[[noreturn]] void refuse_manifest(const fs::path& file, std::string_view reason) {
  throw InputError(
      fmt::format("{}: {}; name another folder, or remove the file", file.string(), reason));
}

bool is_plain_name(const std::string& name) {
  return !name.empty() && name != "." && name != ".." && name.find('/') == std::string::npos &&
         name.find('\0') == std::string::npos;
}

/// The names in `files`, checked.
std::set<std::string> names_in(const Json& files, const fs::path& manifest) {
  std::set<std::string> names;
  for (const Json& entry : files) {
    if (!entry.is_string()) refuse_manifest(manifest, "lists something that is no name");
    const std::string name = entry;
    if (!is_plain_name(name)) {
      refuse_manifest(
          manifest,
          fmt::format("lists '{}', which is no plain name of a file in this folder", name));
    }
    std::error_code error;
    const fs::file_status status = fs::symlink_status(manifest.parent_path() / name, error);
    if (status.type() == fs::file_type::none) {  // a name that is too long, for example
      refuse_manifest(manifest, fmt::format("lists '{}', which cannot be looked at: {}", name,
                                            error.message()));
    }
    if (fs::is_directory(status)) {
      refuse_manifest(manifest, fmt::format("lists '{}', which is a folder", name));
    }
    names.insert(name);
  }
  return names;
}

void write_manifest(const fs::path& folder, const RunDescription& run,
                    const std::set<std::string>& names, bool complete) {
  const Json document = {
      {"format", kMarker},      {"format_version", kManifestFormatVersion},
      {"version", run.version}, {"commit", run.commit.empty() ? Json(nullptr) : Json(run.commit)},
      {"command", run.command}, {"complete", complete},
      {"files", names}};
  write_file(folder / kManifestName,
             document.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
}

std::set<std::string> files_in(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) {
    names.insert(entry.path().filename().string());
  }
  return names;
}

/// Whether something stands there, be it a link that leads nowhere.
bool is_there(const fs::path& path) {
  std::error_code error;
  return fs::exists(fs::symlink_status(path, error));
}

/// What the user put under a name that is about to be written must stay.
void refuse_unlisted(const fs::path& folder, const std::set<std::string>& names,
                     const std::set<std::string>& listed) {
  for (const std::string& name : names) {
    if (listed.count(name) > 0 || !is_there(folder / name)) continue;
    throw InputError(fmt::format(
        "{}: would be written over, but the manifest does not list it: move it away, or name "
        "another folder",
        (folder / name).string()));
  }
}

void remove_file(const fs::path& file) {
  std::error_code error;
  fs::remove(file, error);
  if (error) {
    throw InputError(fmt::format("{}: cannot be removed: {}", file.string(), error.message()));
  }
}

/// Something beside what runs that were ended left there.
bool holds_something(const fs::path& folder) {
  std::error_code error;  // what cannot be looked at is reported when it is written to
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const fs::path name = entry->path().filename();
    const bool is_left =
        is_part(name.string()) || (name == kUnfinishedName && is_unfinished_work(entry->path()));
    if (!is_left) return true;
  }
  return false;
}

}  // namespace

std::set<std::string> listed_files(const fs::path& folder) {
  const fs::path manifest = folder / kManifestName;
  if (!is_there(manifest)) return {};
  const std::string text = content_of(manifest).value_or("");
  const Json document =
      json_depth(text) > kDeepestJson ? Json() : Json::parse(text, nullptr, false);
  const bool ours = document.is_object() && document.value("format", Json()) == kMarker &&
                    document.contains("files") && document["files"].is_array();
  if (!ours) refuse_manifest(manifest, "is no manifest of an earlier run");
  std::set<std::string> names = names_in(document["files"], manifest);
  names.emplace(kManifestName);
  return names;
}

void check_result_folder(const fs::path& folder, Overwriting overwriting,
                         const std::set<std::string>& names) {
  std::error_code error;
  if (fs::exists(folder, error) && !fs::is_directory(folder, error)) {
    throw InputError(fmt::format("{}: is not a folder; name another one", folder.string()));
  }
  if (holds_something(folder)) {
    if (overwriting == Overwriting::refused) {
      throw InputError(fmt::format(
          "{}: holds files already; --force replaces those that an earlier run listed in its {} "
          "and leaves all others",
          folder.string(), kManifestName));
    }
    refuse_unlisted(folder, names, listed_files(folder));
  }
  fs::create_directories(folder, error);
  if (error) {
    throw InputError(fmt::format("{}: cannot be made: {}", folder.string(), error.message()));
  }
  const FolderLock alone(folder);
  if (alone.holds()) remove_abandoned_parts(folder);
  check_writable(folder / kManifestName);
}

ResultFolder::ResultFolder(fs::path folder, Overwriting overwriting)
    : folder_(std::move(folder)), file_(folder_) {
  if (overwriting == Overwriting::of_listed_files) earlier_ = listed_files(folder_);
}

void ResultFolder::commit(const RunDescription& run) {
  const std::set<std::string> written = files_in(temporary());
  std::set<std::string> guarded = written;
  guarded.emplace(kManifestName);
  refuse_unlisted(folder_, guarded, earlier_);
  std::set<std::string> both = earlier_;
  both.erase(std::string(kManifestName));
  both.insert(written.begin(), written.end());
  write_manifest(folder_, run, both, false);
  file_.commit();
  for (const std::string& name : both) {
    if (written.count(name) == 0) remove_file(folder_ / name);
  }
  write_manifest(folder_, run, written, true);
}

}  // namespace lightproof
