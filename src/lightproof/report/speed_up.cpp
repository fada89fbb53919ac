// The findings on throughput: the fastest sampler against the baseline, size by size.
#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <tuple>

#include "lightproof/page/chart_parts.h"
#include "lightproof/page/numbers.h"
#include "lightproof/report/findings.h"
#include "lightproof/report/gate_summary.h"

namespace lightproof {
namespace {

struct SpeedUp {
  const ThroughputRecord* fastest;
  double factor;
};

std::vector<std::string> samplers_of(const std::vector<ThroughputRecord>& records) {
  std::vector<std::string> names;
  for (const ThroughputRecord& r : records) names.push_back(r.sampler);
  return unique_names(names);
}

const ThroughputRecord* slowest(const std::vector<ThroughputRecord>& records) {
  return &*std::max_element(records.begin(), records.end(), [](const auto& a, const auto& b) {
    return a.ns_per_sample < b.ns_per_sample;
  });
}

const ThroughputRecord* fastest_of(const std::vector<ThroughputRecord>& records) {
  return &*std::min_element(records.begin(), records.end(), [](const auto& a, const auto& b) {
    return a.ns_per_sample < b.ns_per_sample;
  });
}

/// Whether nothing is known against a sampler.
bool is_correct(const GateResult& gate, const std::string& sampler) {
  return std::none_of(gate.tests.begin(), gate.tests.end(), [&](const TestRecord& test) {
    return test.sampler == sampler && (test.known_defect || test.outcome == Outcome::reject);
  });
}

/// The fastest sampler on the largest map, of the correct ones if there are any.
std::string sampler_name(const StudyResult& study) {
  const auto rank = [&](const ThroughputRecord& r) {
    return std::tuple(is_correct(study.gate, r.sampler), r.extent.count(), -r.ns_per_sample);
  };
  const std::vector<ThroughputRecord>& records = study.throughput;
  return std::max_element(records.begin(), records.end(),
                          [&](const ThroughputRecord& a, const ThroughputRecord& b) {
                            return rank(a) < rank(b);
                          })
      ->sampler;
}

/// The name itself if it is there, else the first one that contains it, else nothing.
std::string containing(const std::vector<std::string>& names, std::string_view part) {
  if (std::find(names.begin(), names.end(), part) != names.end()) return std::string(part);
  const auto found = std::find_if(names.begin(), names.end(), [&](const std::string& name) {
    return name.find(part) != std::string::npos;
  });
  return found == names.end() ? "" : *found;
}

std::string baseline_name(const StudyResult& study) {
  const std::vector<std::string> names = samplers_of(study.throughput);
  for (const std::string_view part : {"published", "linear_scan", "linear"}) {
    if (const std::string found = containing(names, part); !found.empty()) return found;
  }
  return slowest(study.throughput)->sampler;
}

/// The speed-ups, ascending by size.
std::vector<SpeedUp> speed_ups(const std::vector<ThroughputRecord>& records,
                               const std::string& fastest, const std::string& baseline) {
  std::vector<SpeedUp> factors;
  for (const ThroughputRecord& a : records) {
    for (const ThroughputRecord& b : records) {
      if (a.sampler != fastest || b.sampler != baseline) continue;
      if (a.map != b.map || !(a.extent == b.extent) || !(a.ns_per_sample > 0.0)) continue;
      factors.push_back({&a, b.ns_per_sample / a.ns_per_sample});
    }
  }
  std::stable_sort(factors.begin(), factors.end(), [](const SpeedUp& a, const SpeedUp& b) {
    return a.fastest->extent.count() < b.fastest->extent.count();
  });
  return factors;
}

/// The factor rises from every size to the next (over all maps).
bool grows(const std::vector<SpeedUp>& factors) {
  double last = 0.0;
  for (std::size_t i = 0; i < factors.size();) {
    const std::size_t size = factors[i].fastest->extent.count();
    double low = factors[i].factor;
    double high = low;
    for (; i < factors.size() && factors[i].fastest->extent.count() == size; ++i) {
      low = std::min(low, factors[i].factor);
      high = std::max(high, factors[i].factor);
    }
    if (low <= last) return false;
    last = high;
  }
  return true;
}

std::string times(double factor) { return format_number(factor, 2); }

std::string range_text(double low, double high) {
  return times(low) == times(high) ? times(low) + " times"
                                   : times(low) + " to " + times(high) + " times";
}

}  // namespace

std::string throughput_finding(const StudyResult& study) {
  if (study.throughput.empty()) return "Throughput was not measured";
  const std::string fastest = sampler_name(study);
  const std::string baseline = baseline_name(study);
  const std::vector<SpeedUp> all = speed_ups(study.throughput, fastest, baseline);
  if (fastest == baseline || all.empty()) {
    const ThroughputRecord& best = *fastest_of(study.throughput);
    return fmt::format("{} takes {} ns per sample on {}", best.sampler,
                       format_number(best.ns_per_sample), extent_text(best.extent));
  }
  const auto [low, high] = std::minmax_element(
      all.begin(), all.end(), [](const auto& a, const auto& b) { return a.factor < b.factor; });
  const std::string sizes = fmt::format("from {} to {}", extent_text(all.front().fastest->extent),
                                        extent_text(all.back().fastest->extent));
  const bool one_size = all.front().fastest->extent == all.back().fastest->extent;
  const std::string where = one_size ? "at " + extent_text(all.front().fastest->extent) : sizes;
  return fmt::format("{} is {} as fast as {}, {}{}", fastest, range_text(low->factor, high->factor),
                     baseline, where,
                     !one_size && grows(all) ? ", and the gap grows with the map" : "");
}

std::string tables_finding(const std::vector<TableRecord>& records) {
  const std::vector<TableRecord> unbeaten = unbeaten_tables(of_largest_map(records));
  const TableRecord& fastest = unbeaten.front();
  std::string others;
  for (std::size_t i = 1; i < unbeaten.size(); ++i) {
    others += (i == 1 ? "" : ", ") + unbeaten[i].sampler;
  }
  return fmt::format(
      "At {}, {} is the fastest table, {} ns a sample; {}", extent_text(fastest.extent),
      fastest.sampler, format_number(fastest.ns_per_sample),
      others.empty() ? "none is smaller or more accurate"
                     : "smaller or more accurate, and not beaten in all three: " + others);
}

}  // namespace lightproof
