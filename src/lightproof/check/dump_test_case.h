// A dump against what it is declared to be drawn from, as a test case of the gate.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "lightproof/dump/sample_dump.h"
#include "lightproof/gate/gate.h"
#include "lightproof/gate/test_case.h"
#include "lightproof/image/environment_map.h"
#include "lightproof/image/target_density.h"

namespace lightproof {

/// What is said of a dump beside its numbers.
struct DumpClaim {
  std::string name;      ///< what the dump goes by in records
  TargetDensity target;  ///< the density that its samples are declared to have on the map
  /// By how much, relative, the density that comes with a sample may differ from the declared one.
  double pdf_tolerance = 1e-4;
};

/// The test case of a dump on a map, which must outlive it. The dump's samples are put into the
/// map's own texels. Throws InputError if these cannot have the declared density, see
/// why_not_declared().
TestCase dump_test_case(std::shared_ptr<const SampleDump> dump, const EnvironmentMap& map,
                        const DumpClaim& claim);

/// The options with which the gate spends a dump of so many samples: its first fifth screens, the
/// rest confirms.
GateOptions spending(GateOptions options, std::uint64_t samples);

}  // namespace lightproof
