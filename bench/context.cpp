// What the results say about their origin, for `lightproof history`.
#include <benchmark/benchmark.h>

#include <string_view>

#include "bench/registration.h"
#include "lightproof/core/machine.h"
#include "lightproof_commit.h"

namespace lightproof::bench {

void add_context() {
  benchmark::AddCustomContext("machine", machine_name());
  benchmark::AddCustomContext("compiler", LIGHTPROOF_COMPILER);
  benchmark::AddCustomContext("flags", LIGHTPROOF_FLAGS);
  const std::string_view commit = LIGHTPROOF_COMMIT;
  if (!commit.empty()) benchmark::AddCustomContext("commit", std::string(commit));
}

}  // namespace lightproof::bench
