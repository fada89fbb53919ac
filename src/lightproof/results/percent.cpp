#include "lightproof/results/percent.h"

#include <fmt/format.h>

namespace lightproof {

std::string plain_percent(double share) {
  if (share >= 0.0 && share < 1e-5) return "below 0.001 %";
  // 9.95 % is written as 9.9 or 10, never as 1e+01.
  return share < 0.0995 ? fmt::format("{:.2g} %", 100.0 * share)
                        : fmt::format("{:.0f} %", 100.0 * share);
}

}  // namespace lightproof
