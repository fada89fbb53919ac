// The machine that measurements come from.
#pragma once

#include <string>

namespace lightproof {

/// Wall time over processor time of one thread from which a measurement says that the machine had
/// other work.
inline constexpr double kBusyRatio = 1.1;

/// Model of the machine's processor and the number of its cores, as text.
std::string machine_name();

}  // namespace lightproof
