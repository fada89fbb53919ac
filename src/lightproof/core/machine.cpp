#include "lightproof/core/machine.h"

#include <fmt/format.h>

#include <array>
#include <fstream>
#include <istream>
#include <string>
#include <string_view>

#include "lightproof/core/parallel.h"

namespace lightproof {

std::string processor_name(std::istream& cpuinfo) {
  // What processors are called: by x86 in one line, by ARM in numbers of maker, part and revision.
  constexpr std::array<std::string_view, 3> kArm = {"CPU implementer", "CPU part", "CPU revision"};
  std::array<std::string, kArm.size()> numbers;
  for (std::string line; std::getline(cpuinfo, line);) {
    const std::size_t colon = line.find(':');
    const std::size_t begin =
        colon == std::string::npos ? colon : line.find_first_not_of(" \t", colon + 1);
    if (begin == std::string::npos) continue;
    if (line.starts_with("model name")) return line.substr(begin);
    for (std::size_t i = 0; i < kArm.size(); ++i) {
      if (line.starts_with(kArm[i]) && numbers[i].empty()) numbers[i] = line.substr(begin);
    }
  }
  if (numbers[0].empty()) return "unknown processor";
  return fmt::format("implementer {}, part {}, revision {}", numbers[0], numbers[1], numbers[2]);
}

std::string machine_name() {
  std::ifstream cpuinfo("/proc/cpuinfo");
  return fmt::format("{}, {} cores", processor_name(cpuinfo), thread_count(0));
}

}  // namespace lightproof
