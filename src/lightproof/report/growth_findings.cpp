// The findings on growth: exponents, caches, breakpoints, and the time to build.
#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "lightproof/page/numbers.h"
#include "lightproof/report/findings.h"

namespace lightproof {
namespace {

struct NamedExponent {
  std::string_view sampler;
  double value;
};

/// "0.10 (alias) to 1.0 (linear_scan)". There is at least one.
std::string exponent_range(const std::vector<NamedExponent>& exponents) {
  const auto [least, most] = std::ranges::minmax_element(exponents, {}, &NamedExponent::value);
  const auto text = [](const NamedExponent& e) {
    return fmt::format("{} ({})", format_number(e.value, 2), e.sampler);
  };
  return exponents.size() == 1 ? text(*least) : text(*least) + " to " + text(*most);
}

/// "L2 (1 MiB) at 512×256 (alias) to 1024×512 (binary_search)"; empty if no table outgrows it.
std::string outgrown(const std::vector<GrowthFit>& growth, std::optional<Extent> GrowthFit::*extent,
                     std::string_view cache, const std::optional<double>& bytes) {
  std::vector<const GrowthFit*> fits;
  for (const GrowthFit& fit : growth) {
    if (fit.*extent) fits.push_back(&fit);
  }
  if (fits.empty()) return "";
  const auto size = [&](const GrowthFit* fit) { return (fit->*extent)->count(); };
  const auto [first, last] = std::ranges::minmax_element(fits, {}, size);
  const auto text = [&](const GrowthFit* fit) {
    return fmt::format("{} ({})", extent_text(*(fit->*extent)), fit->sampler);
  };
  const std::string cache_text = fmt::format("{} ({}) at ", cache, bytes_text(bytes.value_or(0.0)));
  if (size(*first) < size(*last)) return cache_text + text(*first) + " to " + text(*last);
  return cache_text + (fits.size() == 1 ? text(*first) : extent_text(*((*first)->*extent)));
}

/// "350 ms", "1.20 s".
std::string duration_text(double ms) {
  return ms < 1000.0 ? format_number(ms) + " ms" : format_number(1e-3 * ms) + " s";
}

}  // namespace

StepRange step_range(const GrowthFit& fit) {
  const auto [fastest, slowest] =
      std::minmax_element(fit.steps.begin(), fit.steps.end(),
                          [](const StepTime& a, const StepTime& b) { return a.ns < b.ns; });
  return {*fastest, *slowest};
}

std::string growth_finding(const std::vector<GrowthFit>& growth) {
  if (growth.empty()) return "";
  std::vector<NamedExponent> exponents;
  for (const GrowthFit& fit : growth) exponents.push_back({fit.sampler, fit.exponent});
  return "The time per sample grows like S + T to the power of " + exponent_range(exponents);
}

std::string caches_finding(const std::vector<GrowthFit>& growth, const CacheSizes& caches) {
  if (!caches.l2 && !caches.l3) return "The sizes of the caches are not known. ";
  const std::string l2 = outgrown(growth, &GrowthFit::leaves_l2, "L2", caches.l2);
  const std::string l3 = outgrown(growth, &GrowthFit::leaves_l3, "L3", caches.l3);
  if (l2.empty() && l3.empty()) return "All tables fit into the caches. ";
  return "Tables outgrow " + (l2.empty() || l3.empty() ? l2 + l3 : l2 + ", " + l3) + ". ";
}

std::string breakpoints_finding(const std::vector<GrowthFit>& growth) {
  std::string all;
  for (const GrowthFit& fit : growth) {
    if (!fit.segmented) continue;
    std::string sizes;
    for (const GrowthBreakpoint& breakpoint : fit.segmented->breakpoints) {
      sizes += (sizes.empty() ? "" : " and ") + extent_text(breakpoint.extent);
    }
    all += fmt::format("{}{} at {}", all.empty() ? "" : ", ", fit.sampler, sizes);
  }
  return all.empty() ? "The time of a step has no measured breakpoint."
                     : "The time of a step has measured breakpoints: " + all + ".";
}

std::string build_finding(const StudyResult& study) {
  const ThroughputRecord* slowest = nullptr;
  for (const ThroughputRecord& r : study.throughput) {
    const auto rank = [](const ThroughputRecord& x) {
      return std::pair(x.extent.count(), x.build_ms);
    };
    if (slowest == nullptr || rank(*slowest) < rank(r)) slowest = &r;
  }
  if (slowest == nullptr) return "";
  const std::string longest =
      fmt::format("{} takes longest at {}, {}", slowest->sampler, extent_text(slowest->extent),
                  duration_text(slowest->build_ms));
  std::vector<NamedExponent> exponents;
  for (const GrowthFit& fit : study.growth) {
    if (fit.build_exponent) exponents.push_back({fit.sampler, fit.build_exponent->value});
  }
  if (exponents.empty()) return "Of the builds " + longest;
  return fmt::format("The time to build grows like S \u00d7 T to the power of {}; {}",
                     exponent_range(exponents), longest);
}

}  // namespace lightproof
