#include "lightproof/core/unfinished_work.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "lightproof/core/atomic_file.h"
#include "lightproof/core/cell_log.h"
#include "lightproof/core/error.h"
#include "lightproof/core/folder_lock.h"
#include "lightproof/core/kept_file.h"

namespace lightproof {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view kIdentity = "inputs of an unfinished run 1";

KeptFile inputs_file(const fs::path& folder) { return {folder, "inputs", std::string(kIdentity)}; }

/// What the name of a file may hold.
std::string plain(std::string name) {
  std::ranges::replace_if(
      name, [](unsigned char c) { return std::isalnum(c) == 0 && c != '-' && c != '.'; }, '_');
  return name;
}

KeptFile stage_file(const fs::path& folder, const std::string& name) {
  return {folder, plain(name), name};
}

fs::path cells_file(const fs::path& folder, const std::string& name) {
  return path_of(stage_file(folder, name)).replace_extension(".cells");
}

std::optional<std::vector<RunInput>> inputs_of(const fs::path& folder) {
  const std::optional<std::string> bytes = read_kept(inputs_file(folder));
  if (!bytes) return std::nullopt;
  try {
    return ValueReader(*bytes).value<std::vector<RunInput>>();
  } catch (const std::out_of_range&) {
    return std::nullopt;
  }
}

const RunInput* find_input(const std::vector<RunInput>& inputs, const std::string& name) {
  const auto found = std::ranges::find(inputs, name, &RunInput::name);
  return found == inputs.end() ? nullptr : &*found;
}

[[noreturn]] void fail(const fs::path& folder, const std::error_code& error) {
  throw InputError(
      fmt::format("{}: finished work cannot be kept: {}", folder.string(), error.message()));
}

/// Parts beside the inputs; neither logs that nothing came into, nor files that a run was killed
/// while it wrote.
bool holds_parts(const fs::path& folder) {
  const fs::path inputs = path_of(inputs_file(folder));
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const bool is_hidden = entry->path().filename().string().starts_with('.');
    std::error_code ignored;
    if (!is_hidden && entry->path() != inputs && !fs::is_empty(entry->path(), ignored)) return true;
  }
  return false;
}

std::string shown(const std::string& value) { return value.empty() ? "not given" : value; }

}  // namespace

std::string difference_of(const std::vector<RunInput>& before, const std::vector<RunInput>& now) {
  std::vector<std::string> differences;
  for (const RunInput& was : before) {
    const RunInput* is = find_input(now, was.name);
    if (is == nullptr) {
      differences.push_back(fmt::format("{} ({}) is left out", was.name, shown(was.value)));
    } else if (is->value != was.value) {
      differences.push_back(
          fmt::format("{} was {} and is {}", was.name, shown(was.value), shown(is->value)));
    }
  }
  for (const RunInput& is : now) {
    if (find_input(before, is.name) == nullptr) {
      differences.push_back(fmt::format("{} ({}) is new", is.name, shown(is.value)));
    }
  }
  std::string text;
  for (const std::string& difference : differences) {
    text += (text.empty() ? "" : "; ") + difference;
  }
  return text;
}

bool is_unfinished_work(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) return false;
  if (inputs_of(folder)) return true;
  // Killed before it had written its inputs.
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    if (!is_part(entry->path().filename().string())) return false;
  }
  return !error;
}

struct UnfinishedWork::Store {
  fs::path folder;
  FolderLock lock;

  void refuse_other_inputs(const std::vector<RunInput>& inputs) const {
    const std::string difference =
        difference_of(inputs_of(folder).value_or(std::vector<RunInput>()), inputs);
    if (difference.empty()) return;
    throw InputError(
        fmt::format("{}: the unfinished work in this folder is of other inputs: {}. "
                    "--force without --resume removes it and begins anew",
                    folder.string(), difference));
  }

  /// No parts, and these inputs; they go last, so that the folder is known as ours all the time.
  void begin(const std::vector<RunInput>& inputs) const {
    const fs::path old_inputs = path_of(inputs_file(folder));
    std::vector<fs::path> parts;
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error)) {
      if (entry->path() != old_inputs) parts.push_back(entry->path());
    }
    for (const fs::path& part : parts) {
      if (!error) fs::remove_all(part, error);
    }
    if (error) fail(folder, error);
    ValueWriter writer;
    writer.add(inputs);
    write_kept(inputs_file(folder), writer.take());
  }
};

UnfinishedWork::UnfinishedWork() = default;

UnfinishedWork::UnfinishedWork(const fs::path& results, const std::vector<RunInput>& inputs,
                               Unfinished earlier)
    : store_(std::make_unique<Store>()) {
  store_->folder = results / kUnfinishedName;
  std::error_code error;
  fs::create_directories(store_->folder, error);
  if (error) fail(store_->folder, error);
  store_->lock = FolderLock(store_->folder);
  if (!is_unfinished_work(store_->folder)) {
    throw InputError(fmt::format(
        "{}: is no unfinished work of this program: move it away, or name another folder",
        store_->folder.string()));
  }
  const bool begins = !holds_parts(store_->folder) || earlier == Unfinished::discarded;
  if (!begins && earlier == Unfinished::refused) {
    throw InputError(
        fmt::format("{}: here lies work of a run that did not end; --resume goes on with it, "
                    "--force begins anew",
                    store_->folder.string()));
  }
  if (!begins) {
    store_->refuse_other_inputs(inputs);
    return;
  }
  try {
    store_->begin(inputs);
  } catch (const InputError&) {
    remove();
    throw;
  }
}

UnfinishedWork::UnfinishedWork(UnfinishedWork&& other) noexcept = default;

UnfinishedWork::~UnfinishedWork() {
  if (store_ && !holds_parts(store_->folder)) remove();
}

std::optional<std::string> UnfinishedWork::find(const std::string& name) const {
  return store_ ? read_kept(stage_file(store_->folder, name)) : std::nullopt;
}

Communicator UnfinishedWork::begin_stage(const std::string& name) const {
  if (!store_) return {};
  const auto log = std::make_shared<CellLog>(cells_file(store_->folder, name));
  Communicator alone;
  alone.kept.find = [log](const std::string& key) { return log->find(key); };
  alone.kept.keep = [log](const std::string& key, std::string_view bytes) { log->add(key, bytes); };
  return alone;
}

void UnfinishedWork::end_stage(const std::string& name, std::string_view bytes) const {
  if (!store_) return;
  write_kept(stage_file(store_->folder, name), bytes);
  std::error_code ignored;
  fs::remove(cells_file(store_->folder, name), ignored);
}

bool UnfinishedWork::holds_something() const { return store_ && holds_parts(store_->folder); }

void UnfinishedWork::remove() {
  if (!store_) return;
  // All at once, as it would be none of ours without its inputs: what is left under the other name
  // is a part that a killed run abandoned.
  const fs::path gone = part_of(store_->folder);
  std::error_code error;
  fs::rename(store_->folder, gone, error);
  fs::remove_all(error ? store_->folder : gone, error);
  store_.reset();
}

}  // namespace lightproof
