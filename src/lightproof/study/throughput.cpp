#include "lightproof/study/throughput.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <optional>

#include "lightproof/core/child_process.h"
#include "lightproof/core/error.h"
#include "lightproof/core/file_content.h"
#include "lightproof/core/json_text.h"
#include "lightproof/core/kept_file.h"
#include "lightproof/core/machine.h"
#include "lightproof/core/random.h"
#include "lightproof/core/temporary_folder.h"
#include "lightproof/stats/median.h"

namespace lightproof {
namespace fs = std::filesystem;
namespace {

constexpr std::uint64_t kSmallestWidth = 256;
/// Where bytes and errors of tables are compared.
constexpr std::string_view kTableSize = "2048x1024";
/// Where directions are timed: a table that caches hold in part, and one that they do not.
constexpr std::string_view kDirectionSizes = "2048x1024|8192x4096";
/// Samplers whose directions are timed: those that take the same few steps on any map, the usual
/// way and the limit.
constexpr std::string_view kDirectionRows =
    "alias|packed_alias|alias_lines|guide_table|guide_lines|upper_bound_baseline|bare_gather_2B";

/// The repetitions of one benchmark.
struct Group {
  std::string name;
  std::vector<nlohmann::json> runs;
};

std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts;
  for (std::size_t at = text.find(separator); at != std::string_view::npos;
       at = text.find(separator)) {
    parts.emplace_back(text.substr(0, at));
    text.remove_prefix(at + 1);
  }
  parts.emplace_back(text);
  return parts;
}

bool is_digits(const std::string& text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
}

int side_of(const std::string& digits) {
  int side = 0;
  const char* end = digits.data() + digits.size();
  const auto [stop, error] = std::from_chars(digits.data(), end, side);
  if (error != std::errc() || stop != end || side < 1) {
    throw InputError(fmt::format("{} is no size of a map", digits));
  }
  return side;
}

/// The parts of sample/<sampler>/<map>/<W>x<H>/<order>.
struct SampleName {
  std::string sampler;
  std::string map;
  Extent extent;
  std::string order;
};

/// The parts of a benchmark's name; none for benchmarks of other things.
std::optional<SampleName> sample_name(const std::string& name) {
  const std::vector<std::string> parts = split(name, '/');
  if (parts.size() != 5 || parts[0] != "sample") return std::nullopt;
  const std::vector<std::string> sides = split(parts[3], 'x');
  if (sides.size() != 2 || !is_digits(sides[0]) || !is_digits(sides[1])) return std::nullopt;
  return SampleName{parts[1], parts[2], {side_of(sides[0]), side_of(sides[1])}, parts[4]};
}

/// Wall time over processor time, the median over repetitions; 1 if the file does not tell.
double wall_per_cpu(const std::vector<nlohmann::json>& runs) {
  std::vector<double> ratios;
  for (const nlohmann::json& run : runs) {
    const double cpu = run.value("cpu_time", 0.0);
    // What is timed in another process says so itself.
    if (run.contains("wall_per_cpu")) {
      ratios.push_back(run.at("wall_per_cpu").get<double>());
    } else if (cpu > 0.0) {
      ratios.push_back(run.value("real_time", 0.0) / cpu);
    }
  }
  return ratios.empty() ? 1.0 : median(std::move(ratios));
}

double median_of(const std::vector<nlohmann::json>& runs, const char* counter) {
  std::vector<double> values;
  for (const auto& run : runs) values.push_back(run.at(counter).get<double>());
  return median(std::move(values));
}

ThroughputRecord summarise(const SampleName& name, const std::vector<nlohmann::json>& runs) {
  std::vector<double> times;
  for (const auto& run : runs) times.push_back(run.at("ns_per_sample").get<double>());
  const auto [low, high] = std::minmax_element(times.begin(), times.end());
  return {name.sampler,
          name.map,
          name.extent,
          median(times),
          *low,
          *high,
          runs.front().at("table_bytes").get<double>(),
          runs.front().at("build_ms").get<double>(),
          wall_per_cpu(runs)};
}

TableRecord table_of(const SampleName& name, const std::vector<nlohmann::json>& runs) {
  const bool has_ratios = runs.front().contains("times_baseline");
  return {name.sampler,
          name.map,
          name.extent,
          median_of(runs, "ns_per_sample"),
          median_of(runs, "bytes_per_texel"),
          median_of(runs, "worst_texel_error"),
          has_ratios ? median_of(runs, "times_baseline") : 0.0,
          has_ratios ? median_of(runs, "share_of_limit") : 0.0,
          wall_per_cpu(runs)};
}

/// The order of this name; none if it is another kind of benchmark.
std::optional<DrawOrder> draw_order(const std::string& name) {
  const auto* const found = std::ranges::find_if(
      kDrawOrders, [&](const DrawOrderInfo& info) { return info.name == name; });
  if (found == kDrawOrders.end()) return std::nullopt;
  return static_cast<DrawOrder>(found - kDrawOrders.begin());
}

/// The parts of directions/<sampler>/<map>/<W>x<H>/<density>/<order> as a record; none for
/// benchmarks of other things, as of positions instead of directions. Those of plug-ins, which are
/// timed in their own process, have /manual_time behind it.
std::optional<DirectionRecord> directions_of(const std::string& name,
                                             const std::vector<nlohmann::json>& runs) {
  std::vector<std::string> parts = split(name, '/');
  if (parts.back() == "manual_time") parts.pop_back();
  if (parts.size() != 6 || parts[0] != "directions") return std::nullopt;
  const std::vector<std::string> sides = split(parts[3], 'x');
  if (sides.size() != 2 || !is_digits(sides[0]) || !is_digits(sides[1])) return std::nullopt;
  const std::optional<DrawOrder> order = draw_order(parts[5]);
  if (!order) return std::nullopt;
  const auto ratio = [&](const char* counter) {
    return runs.front().contains(counter) ? median_of(runs, counter) : 0.0;
  };
  return DirectionRecord{parts[1],
                         parts[2],
                         {side_of(sides[0]), side_of(sides[1])},
                         parts[4],
                         *order,
                         median_of(runs, "ns_per_sample"),
                         ratio("times_baseline"),
                         ratio("share_of_limit"),
                         wall_per_cpu(runs)};
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

/// Bytes of the data or unified cache of this level.
std::optional<double> cache_size(const nlohmann::json& context, int level) {
  for (const auto& cache : context.value("caches", nlohmann::json::array())) {
    if (cache.at("level") != level || cache.at("type") == "Instruction") continue;
    const auto size = cache.at("size").get<double>();
    if (size > 0.0) return size;
  }
  return std::nullopt;
}

/// "2026-11-28T13:41:08+00:00, 2 x processor, GNU 12.2.0, commit 1a2b3c…", as far as it is known.
std::string origin_of(const nlohmann::json& context) {
  std::vector<std::string> parts;
  for (const char* key : {"date", "machine", "compiler"}) {
    if (const std::string text = context.value(key, ""); !text.empty()) parts.push_back(text);
  }
  if (const std::string commit = context.value("commit", ""); !commit.empty()) {
    parts.push_back("commit " + commit.substr(0, 12));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

Throughput records_of(const std::string& text) {
  if (json_depth(text) > kDeepestJson) throw InputError("its values lie too deep in each other");
  const nlohmann::json document = nlohmann::json::parse(text);
  Throughput records;
  const std::vector<Group> groups = groups_of(document);
  for (const auto& [benchmark, runs] : groups) {
    if (const auto directions = directions_of(benchmark, runs)) {
      records.directions.push_back(*directions);
      continue;
    }
    const std::optional<SampleName> name = sample_name(benchmark);
    if (!name) continue;
    if (name->order == "random") {
      records.samplers.push_back(summarise(*name, runs));
    } else if (name->order == "fused" && runs.front().contains("worst_texel_error")) {
      records.tables.push_back(table_of(*name, runs));
    }
  }
  const nlohmann::json context = document.value("context", nlohmann::json::object());
  records.caches = {cache_size(context, 2), cache_size(context, 3)};
  records.origin = origin_of(context);
  for (const Group& group : groups) {
    const double ratio = wall_per_cpu(group.runs);
    records.busy_rows += ratio > kBusyRatio;
    records.wall_per_cpu = std::max(records.wall_per_cpu, ratio);
  }
  if (records.busy_rows > 0) {
    records.origin += fmt::format(
        "{}the machine was busy during {} of {} benchmarks: their wall time exceeds "
        "their processor time by more than a tenth, and is up to {:.2g} times it",
        records.origin.empty() ? "" : "; ", records.busy_rows, groups.size(), records.wall_per_cpu);
  }
  return records;
}

/// Of a whole file, which has samplers in it.
Throughput throughput_of(const std::string& text) {
  Throughput records = records_of(text);
  if (records.samplers.empty()) throw InputError("no benchmark is called sample/…/random");
  return records;
}

/// The same, with the name of the file, or of the program that wrote it, in errors.
Throughput from_text(const fs::path& source, const std::string& text) {
  try {
    return throughput_of(text);
  } catch (const nlohmann::json::exception& error) {
    throw InputError(fmt::format("{}: not a result of Google Benchmark (--benchmark_out): {}",
                                 source.string(), error.what()));
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", source.string(), error.what()));
  }
}

/// Where the throughput is kept: nowhere if the program cannot be read.
KeptFile kept_file(const ThroughputSource& source, const std::string& filter) {
  const std::optional<std::uint64_t> program = hash_of_file(source.program);
  if (!program) return {};
  return {source.cache, "throughput", fmt::format("{:x}/{}/{}", *program, machine_name(), filter)};
}

/// What is kept, as a file of Google Benchmark; none if it is damaged, or not there.
std::optional<Throughput> kept_throughput(const KeptFile& kept) {
  const std::optional<std::string> text = read_kept(kept);
  if (!text) return std::nullopt;
  try {
    return throughput_of(*text);
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  } catch (const InputError&) {
    return std::nullopt;
  }
}

std::string_view direction_sizes(std::uint64_t largest_width) {
  return largest_width >= 8192 ? kDirectionSizes : kTableSize;
}

/// Runs the benchmarks that the filter names, and returns the content of the file of results.
std::string run_benchmarks(const ThroughputSource& source, const std::string& filter,
                           std::vector<std::string> arguments = {}) {
  const TemporaryFolder folder;
  const fs::path file = folder / "throughput.json";
  for (std::string argument :
       {"--benchmark_filter=" + filter, "--benchmark_out=" + file.string(),
        std::string("--benchmark_out_format=json"), std::string("--benchmark_repetitions=3"),
        std::string("--benchmark_min_time=0.1")}) {
    arguments.push_back(std::move(argument));
  }
  run_child(source.program, arguments);
  return content_of(file).value_or("");
}

/// Adds the directions of a plug-in, or why there are none.
void add_plugin(const ThroughputSource& source, const fs::path& plugin, Throughput& measured) {
  const std::string filter = fmt::format("^directions/[^/]*/[^/]*/({})/[ABC]/batch/manual_time$",
                                         direction_sizes(source.largest_width));
  try {
    const Throughput own =
        records_of(run_benchmarks(source, filter, {"--plugin", plugin.string()}));
    measured.directions.insert(measured.directions.end(), own.directions.begin(),
                               own.directions.end());
    measured.busy_rows += own.busy_rows;
    measured.wall_per_cpu = std::max(measured.wall_per_cpu, own.wall_per_cpu);
  } catch (const InputError& error) {
    measured.origin +=
        fmt::format("{}plug-in {} is not timed: {}", measured.origin.empty() ? "" : "; ",
                    plugin.filename().string(), error.what());
  }
}

/// What is kept of the study's own samplers, or what is measured now.
Throughput own_throughput(const ThroughputSource& source) {
  const std::string filter = throughput_filter(source.largest_width);
  const KeptFile kept = kept_file(source, filter);
  std::optional<Throughput> before;
  if (!source.measure_again) before = kept_throughput(kept);
  if (before && before->busy_rows == 0) return *std::move(before);
  const std::string text = run_benchmarks(source, filter);
  Throughput measured = from_text(source.program, text);
  if (before && before->busy_rows <= measured.busy_rows) return *std::move(before);
  keep(kept, text);
  return measured;
}

}  // namespace

std::string throughput_filter(std::uint64_t largest_width) {
  std::vector<std::uint64_t> widths;
  for (std::uint64_t width = kSmallestWidth; width <= largest_width; width *= 2) {
    widths.push_back(width);
    if (width / 2 * 3 <= largest_width) widths.push_back(width / 2 * 3);
  }
  return fmt::format(
      "^(sample/[^/]*/[^/]*/(({0})x[0-9]*/random|{1}/fused)|"
      "directions/({2})/[^/]*/({3})/[ABC]/(scalar|ahead|fused))$",
      fmt::join(widths, "|"), kTableSize, kDirectionRows, direction_sizes(largest_width));
}

Throughput measure_throughput(const ThroughputSource& source) {
  Throughput measured = own_throughput(source);
  for (const fs::path& plugin : source.plugins) add_plugin(source, plugin, measured);
  return measured;
}

Throughput read_throughput(const fs::path& file) {
  const std::optional<std::string> text = content_of(file);
  if (!text) throw InputError(fmt::format("{}: cannot be read", file.string()));
  return from_text(file, *text);
}

}  // namespace lightproof
