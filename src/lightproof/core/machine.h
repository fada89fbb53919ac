// The machine that measurements come from.
#pragma once

#include <string>

namespace lightproof {

/// Model of the processor and number of cores.
std::string machine_name();

}  // namespace lightproof
