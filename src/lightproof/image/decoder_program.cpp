#include "lightproof/image/decoder_program.h"

#include "lightproof/core/companion_program.h"

namespace lightproof {

std::filesystem::path decoder_program() {
  return find_companion(
      {"lightproof-decode", kDecoderVariable, "the program that reads and writes pictures"});
}

}  // namespace lightproof
