#include "kept_measurements.h"

#include <cstdlib>
#include <utility>

#include "lightproof/core/running_program.h"

namespace lightproof::cli {

std::filesystem::path cache_folder() {
  namespace fs = std::filesystem;
  const auto folder = [](const char* variable) {
    const char* value = std::getenv(variable);
    return value != nullptr ? fs::path(value) : fs::path();
  };
  if (const fs::path own = folder("LIGHTPROOF_CACHE"); !own.empty()) return own;
  if (const fs::path all = folder("XDG_CACHE_HOME"); !all.empty()) return all / "lightproof";
  const fs::path home = folder("HOME");
  return home.empty() ? home : home / ".cache" / "lightproof";
}

MeasurementCache kept_measurements(std::string commit, bool measure_again) {
  return {cache_folder(), running_program_file(), std::move(commit), measure_again};
}

}  // namespace lightproof::cli
