// A folder that a run fills, and that a later run may fill again: it holds a manifest, the list of
// the files that the run wrote. What the manifest does not list is the user's, and stays.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <string_view>

#include "lightproof/core/atomic_file.h"
#include "lightproof/core/run_description.h"

namespace lightproof {

/// The file name of the manifest.
inline constexpr std::string_view kManifestName = "manifest.json";
/// Version of the format of the manifest (docs/schema/manifest.schema.json).
inline constexpr int kManifestFormatVersion = 1;

/// Whether a folder that holds something may be written to.
enum class Overwriting {
  refused,
  of_listed_files,  ///< what the folder's manifest lists is replaced; other files stay
};

/// The files that the manifest in `folder` lists; none if there is none. Throws InputError if the
/// manifest is not one of ours or lists something that is no plain file name: a path, "..".
std::set<std::string> listed_files(const std::filesystem::path& folder);

/// Makes the folder of results. Unfinished work, and what killed runs left of their files, is
/// nothing that stands in the way. Throws InputError, before minutes are spent, if the results
/// cannot go to `folder`: it is a file, cannot be made or written, or another run is at it; or it
/// holds something and overwriting is refused; or it holds one of `names`, which will be written,
/// and the manifest does not list it.
void check_result_folder(const std::filesystem::path& folder, Overwriting overwriting,
                         const std::set<std::string>& names);

/// Results on their way into a folder: written to temporary(), then commit().
class ResultFolder {
 public:
  /// Throws InputError if the folder cannot be written.
  ResultFolder(std::filesystem::path folder, Overwriting overwriting);

  /// The folder to write into.
  const std::filesystem::path& temporary() const { return file_.temporary(); }

  /// Moves the files into the folder, removes those of the earlier run that were not written again,
  /// and writes the manifest last. Throws InputError, with nothing changed, if a file that no
  /// manifest lists stands in the way. A run that is killed in between leaves a manifest that
  /// lists the files of both runs and says that it is not complete.
  void commit(const RunDescription& run);

 private:
  std::filesystem::path folder_;
  std::set<std::string> earlier_;
  AtomicFolder file_;
};

}  // namespace lightproof
