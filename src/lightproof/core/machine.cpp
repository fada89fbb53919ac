#include "lightproof/core/machine.h"

#include <fmt/format.h>

#include <fstream>
#include <string>

#include "lightproof/core/parallel.h"

namespace lightproof {

std::string machine_name() {
  std::ifstream info("/proc/cpuinfo");
  std::string model = "unknown processor";
  for (std::string line; std::getline(info, line);) {
    if (!line.starts_with("model name")) continue;
    const std::size_t name = line.find_first_not_of(" \t", line.find(':') + 1);
    if (name != std::string::npos) model = line.substr(name);
    break;
  }
  return fmt::format("{}, {} cores", model, thread_count(0));
}

}  // namespace lightproof
