#include "lightproof/core/temporary_folder.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdlib>
#include <string>
#include <system_error>

#include "lightproof/core/error.h"

namespace lightproof {
namespace fs = std::filesystem;

TemporaryFolder::TemporaryFolder() {
  std::error_code error;
  const fs::path parent = fs::temp_directory_path(error);
  std::string name = (parent / "lightproof-XXXXXX").string();
  if (error || ::mkdtemp(name.data()) == nullptr) {
    throw InputError(fmt::format("cannot make a temporary folder (TMPDIR): {}",
                                 error ? error.message() : std::generic_category().message(errno)));
  }
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

}  // namespace lightproof
