// Tests that find the rarer faults with more replicates have two forms: a quick one, which ci/gate
// runs, and the thorough one of ci/thorough.
#pragma once

#include <cstdlib>

namespace lightproof::test {

/// Whether tests take the time that rare faults need.
inline bool is_thorough() { return std::getenv("LIGHTPROOF_THOROUGH") != nullptr; }

}  // namespace lightproof::test
