#include "lightproof/core/out_of_memory.h"

#include <fmt/format.h>

#include "lightproof/core/huge_pages.h"

namespace lightproof {
namespace {

/// "2.15 GB".
std::string bytes_text(std::size_t bytes) {
  const auto count = static_cast<double>(bytes);
  return count < 1e9 ? fmt::format("{:.3g} MB", 1e-6 * count)
                     : fmt::format("{:.3g} GB", 1e-9 * count);
}

}  // namespace

OutOfMemory out_of_memory(const std::string& purpose, const std::bad_alloc& error) {
  std::string message = "not enough memory";
  if (!purpose.empty()) message += " for " + purpose;
  if (const auto* table = dynamic_cast<const NoMemoryForTable*>(&error)) {
    message += fmt::format(": {} more could not be had", bytes_text(table->bytes()));
  }
  return OutOfMemory(message + "; smaller maps, fewer at once, or fewer threads take less");
}

}  // namespace lightproof
