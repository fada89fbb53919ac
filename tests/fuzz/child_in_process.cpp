#include "tests/fuzz/child_in_process.h"

#include <cstdlib>

#include "lightproof/image/decoder_program.h"

namespace lightproof {
namespace {

fuzz::ChildInProcess* current = nullptr;

}  // namespace

void fuzz::set_child(ChildInProcess& child) {
  current = &child;
  ::setenv(kDecoderVariable, "/proc/self/exe", 1);  // any program that is there
}

ChildConversation::ChildConversation(const std::filesystem::path& /*program*/,
                                     const std::vector<std::string>& /*arguments*/,
                                     std::span<const int> files, std::chrono::milliseconds patience)
    : patience_(patience) {
  current->begin(files);
}

ChildConversation::ChildConversation(const std::filesystem::path& program,
                                     const std::vector<std::string>& arguments, int file,
                                     std::chrono::milliseconds patience)
    : ChildConversation(program, arguments, file < 0 ? std::span<const int>() : std::span(&file, 1),
                        patience) {}

ChildConversation::~ChildConversation() { current->end(); }

Exchange ChildConversation::send(std::span<const std::byte> bytes) {
  current->take(bytes);
  return Exchange::done;
}

Exchange ChildConversation::receive(std::span<std::byte> bytes) { return current->give(bytes); }

std::optional<ChildEnd> ChildConversation::end() { return current->ending(); }

}  // namespace lightproof
