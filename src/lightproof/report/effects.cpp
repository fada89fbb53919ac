#include "lightproof/report/effects.h"

#include <fmt/format.h>

#include <cmath>

#include "lightproof/page/numbers.h"

namespace lightproof {
namespace {

std::string times_expected(double excess) { return significant(1.0 + excess) + "x expected"; }

}  // namespace

bool is_of_worst_cell(const TestRecord& test) {
  return describe(test.test).effect == EffectMeasure::worst_cell;
}

std::string effect_text(const TestRecord& test) {
  if (!is_of_worst_cell(test)) return significant(test.effect);
  return test.effect <= -1.0 ? "never drawn" : times_expected(test.effect);
}

std::string minimum_detectable_text(const TestRecord& test) {
  if (!test.minimum_detectable_effect) return "-";
  return is_of_worst_cell(test) ? times_expected(*test.minimum_detectable_effect)
                                : significant(*test.minimum_detectable_effect);
}

std::string p_text(double log10_p) {
  constexpr double kSmallestDouble = -300.0;
  if (std::isnan(log10_p)) return "nan";
  if (log10_p >= kSmallestDouble) return significant(std::pow(10.0, log10_p), 4);
  if (std::isinf(log10_p)) return "0";
  const double exponent = std::floor(log10_p);
  return fmt::format("{:.3g}e{:.0f}", std::pow(10.0, log10_p - exponent), exponent);
}

}  // namespace lightproof
