// The machine that measurements come from.
#pragma once

#include <string>

namespace lightproof {

/// Model of the machine's processor and the number of its cores, as text.
std::string machine_name();

}  // namespace lightproof
