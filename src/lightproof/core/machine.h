// The machine that measurements come from.
#pragma once

#include <iosfwd>
#include <string>

namespace lightproof {

/// Wall time over processor time of one thread from which a measurement says that the machine had
/// other work.
inline constexpr double kBusyRatio = 1.1;

/// The processor's model, by the text of Linux's /proc/cpuinfo; of an ARM processor, which has no
/// name there, the numbers of its maker, part and revision.
std::string processor_name(std::istream& cpuinfo);

/// Model of the machine's processor and the number of its cores, as text.
std::string machine_name();

}  // namespace lightproof
