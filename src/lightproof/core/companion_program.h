// Where the programs lie that come with this one, and that it starts.
#pragma once

#include <filesystem>
#include <string>

namespace lightproof {

/// A program that comes with this one.
struct CompanionProgram {
  std::string name;      ///< of its file
  std::string variable;  ///< of the environment: names the program, whatever is found elsewhere
  std::string purpose;   ///< "the program that reads and writes pictures"
};

/// The program that the environment's variable names; else the first that is there: beside the
/// running program, in the folder above (a build tree), in ../libexec/lightproof seen from there
/// (an installation), where the libraries were configured to be installed. Throws InputError that
/// lists these places if there is none.
std::filesystem::path find_companion(const CompanionProgram& program);

}  // namespace lightproof
