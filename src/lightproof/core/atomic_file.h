// Files appear complete or not at all: written under a temporary name, then renamed.
#pragma once

#include <filesystem>
#include <string_view>

namespace lightproof {

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
  /// Makes the target if it is not there. Throws InputError if it cannot be made or written.
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
  std::filesystem::path temporary_;
};

/// Writes `content` to `path` through an AtomicFile. A link is followed; a pipe or device is
/// written to as it is. Throws InputError (a full disk included).
void write_file(const std::filesystem::path& path, std::string_view content);

/// Throws the InputError that write_file would throw at once: before minutes are spent on content.
void check_writable(const std::filesystem::path& path);

}  // namespace lightproof
