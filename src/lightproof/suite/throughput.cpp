#include "lightproof/suite/throughput.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>

#include "lightproof/core/child_process.h"
#include "lightproof/core/error.h"
#include "lightproof/core/temporary_folder.h"
#include "lightproof/samplers/registry.h"
#include "lightproof/suite/power_law.h"

namespace lightproof {
namespace fs = std::filesystem;
namespace {

/// One sample at a time on maps of all but the largest size, which take minutes to prepare; tables
/// on one.
constexpr std::string_view kFilter = "^sample/[^/]*/[^/]*/(512|1024|2048|4096|8192)x[0-9]*/random$";

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

/// The repetitions of one benchmark.
struct Group {
  std::string name;
  std::vector<nlohmann::json> runs;
};

int side_of(const std::string& digits) {
  int side = 0;
  const char* end = digits.data() + digits.size();
  const auto [stop, error] = std::from_chars(digits.data(), end, side);
  if (error != std::errc() || stop != end || side < 1) {
    throw InputError(fmt::format("{} is no size of a map", digits));
  }
  return side;
}

double median_of(const std::vector<nlohmann::json>& runs, const char* counter) {
  std::vector<double> values;
  for (const auto& run : runs) values.push_back(run.at(counter).get<double>());
  return median(std::move(values));
}

ThroughputRecord summarise(const std::smatch& name, const std::vector<nlohmann::json>& runs) {
  std::vector<double> times;
  for (const auto& run : runs) times.push_back(run.at("ns_per_sample").get<double>());
  const auto [low, high] = std::minmax_element(times.begin(), times.end());
  return {name[1],
          name[2],
          {side_of(name[3]), side_of(name[4])},
          median(times),
          *low,
          *high,
          runs.front().at("table_bytes").get<double>(),
          runs.front().at("build_ms").get<double>()};
}

TableRecord table_of(const std::smatch& name, const std::vector<nlohmann::json>& runs) {
  const bool has_ratios = runs.front().contains("times_baseline");
  return {name[1],
          name[2],
          {side_of(name[3]), side_of(name[4])},
          median_of(runs, "ns_per_sample"),
          median_of(runs, "bytes_per_texel"),
          median_of(runs, "worst_texel_error"),
          has_ratios ? median_of(runs, "times_baseline") : 0.0,
          has_ratios ? median_of(runs, "share_of_limit") : 0.0};
}

/// Throws InputError for a benchmark that reports an error: a sampler that fails its check must
/// not drop out silently.
std::vector<Group> groups_of(const nlohmann::json& document) {
  std::vector<Group> groups;
  for (const auto& run : document.at("benchmarks")) {
    if (run.value("run_type", "") != "iteration") continue;
    const std::string name = run.at("run_name");
    if (run.value("error_occurred", false)) {
      throw InputError(fmt::format("{} failed: {}", name, run.value("error_message", "no reason")));
    }
    if (groups.empty() || groups.back().name != name) groups.push_back({name, {}});
    groups.back().runs.push_back(run);
  }
  return groups;
}

Throughput records_of(const nlohmann::json& document) {
  static const std::regex pattern("sample/([^/]+)/([^/]+)/(\\d+)x(\\d+)/(random|fused)");
  Throughput records;
  for (const auto& [name, runs] : groups_of(document)) {
    std::smatch match;
    if (!std::regex_match(name, match, pattern)) continue;
    if (match[5] == "random") {
      records.samplers.push_back(summarise(match, runs));
    } else if (runs.front().contains("worst_texel_error")) {
      records.tables.push_back(table_of(match, runs));
    }
  }
  if (records.samplers.empty()) throw InputError("no benchmark is called sample/…/random");
  return records;
}

}  // namespace

Throughput measure_throughput(const fs::path& program) {
  const TemporaryFolder folder;
  const fs::path file = folder / "throughput.json";
  run_child(program, {"--benchmark_filter=" + std::string(kFilter),
                      "--benchmark_out=" + file.string(), "--benchmark_out_format=json",
                      "--benchmark_repetitions=3", "--benchmark_min_time=0.1"});
  return read_throughput(file);
}

Throughput read_throughput(const fs::path& file) {
  std::ifstream in(file);
  if (!in) throw InputError(fmt::format("{}: cannot be read", file.string()));
  try {
    return records_of(nlohmann::json::parse(in));
  } catch (const nlohmann::json::exception& error) {
    throw InputError(fmt::format("{}: not a result of Google Benchmark (--benchmark_out): {}",
                                 file.string(), error.what()));
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", file.string(), error.what()));
  }
}

std::vector<GrowthFit> growth_of(std::span<const ThroughputRecord> records) {
  std::vector<GrowthFit> fits;
  for (const SamplerInfo& sampler : samplers()) {
    std::vector<PowerLawPoint> points;
    std::vector<StepTime> steps;
    for (const ThroughputRecord& record : records) {
      if (record.sampler != sampler.name) continue;
      points.push_back({static_cast<double>(record.extent.width + record.extent.height),
                        record.ns_per_sample, 1.0});
      steps.push_back({record.extent, record.ns_per_sample / sampler.steps(record.extent)});
    }
    if (points.size() < 3) continue;
    std::sort(steps.begin(), steps.end(), [](const StepTime& a, const StepTime& b) {
      return a.extent.count() < b.extent.count();
    });
    const PowerLaw fit = fit_power_law(points);
    // The scatter about the line, not the repetitions, is what the exponent is uncertain by.
    double residual = 0.0;
    for (const PowerLawPoint& point : points) {
      const double r = std::log(point.y / (fit.constant * std::pow(point.x, fit.exponent)));
      residual += r * r / static_cast<double>(points.size() - 2);
    }
    fits.push_back({std::string(sampler.name), std::string(sampler.growth), fit.exponent,
                    fit.exponent_error * std::sqrt(residual), std::move(steps)});
  }
  return fits;
}

}  // namespace lightproof
