// Files appear complete or not at all: written under a temporary name, then renamed.
#pragma once

#include <filesystem>
#include <string_view>

#include "lightproof/core/folder_lock.h"

namespace lightproof {

/// Whether a file or folder of this name is what AtomicFile or AtomicFolder write to:
/// ".g.123.part.json",
/// ".123.part".
bool is_part(std::string_view name);

/// The name beside `target` under which this process writes what will be `target`.
std::filesystem::path part_of(const std::filesystem::path& target);

/// Removes what processes that were killed left of unfinished files. Not while any of them may
/// still run: behind a FolderLock.
void remove_abandoned_parts(const std::filesystem::path& folder);

/// A file being written. Write to temporary(), then commit(); without commit the temporary file
/// is removed and whatever stood under the final name is untouched.
class AtomicFile {
 public:
  /// Throws InputError if the folder does not exist or cannot be written.
  explicit AtomicFile(std::filesystem::path target);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// The file to write to: beside the target, with the same extension (image writers choose the
  /// format by it).
  const std::filesystem::path& temporary() const { return temporary_; }
  /// Flushes the temporary file to the disk and renames it to the target. Throws InputError if
  /// either fails.
  void commit();

 private:
  std::filesystem::path target_;
  std::filesystem::path temporary_;
  bool committed_ = false;
};

/// A folder of files being written. Write into temporary(), then commit(): nothing appears in the
/// target before everything is on the disk, and then it only takes renaming. Without commit the
/// temporary folder is removed and the target untouched.
class AtomicFolder {
 public:
  /// Makes the target if it is not there, and removes what was left in it by processes that were
  /// killed. Throws InputError if it cannot be made or written, or if another process is at it.
  explicit AtomicFolder(std::filesystem::path target);
  ~AtomicFolder();
  AtomicFolder(const AtomicFolder&) = delete;
  AtomicFolder& operator=(const AtomicFolder&) = delete;

  /// The folder to write into: inside the target, so that files move by renaming.
  const std::filesystem::path& temporary() const { return temporary_; }
  /// Moves the files to the target, over what stood there under their names.
  void commit();

 private:
  std::filesystem::path target_;
  FolderLock lock_;
  std::filesystem::path temporary_;
};

/// Writes `content` to `path` through an AtomicFile. A link is followed; a pipe or device is
/// written to as it is. Throws InputError (a full disk included).
void write_file(const std::filesystem::path& path, std::string_view content);

/// Throws the InputError that write_file would throw at once: before minutes are spent on content.
void check_writable(const std::filesystem::path& path);

}  // namespace lightproof
