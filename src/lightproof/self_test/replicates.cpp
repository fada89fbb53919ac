#include "lightproof/self_test/replicates.h"

#include <fmt/format.h>

namespace lightproof {

std::string key_of_replicate(const std::string& name, std::uint64_t replicate) {
  return fmt::format("{}/{:020}", name, replicate);
}

}  // namespace lightproof
