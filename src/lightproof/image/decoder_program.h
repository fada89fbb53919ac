// Where lightproof-decode lies, the program that decodes and encodes pictures.
#pragma once

#include <filesystem>

namespace lightproof {

/// Names the program, whatever is found elsewhere.
inline constexpr const char* kDecoderVariable = "LIGHTPROOF_DECODER";

/// The program that the environment variable LIGHTPROOF_DECODER names; else the first that is
/// there: beside the running program, in the folder above (a build tree), in ../libexec/lightproof
/// seen from there (an installation), where the libraries were configured to be installed. Throws
/// InputError that lists these places if there is none.
std::filesystem::path decoder_program();

}  // namespace lightproof
