#include "lightproof/history/google_benchmark.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <tuple>

#include "lightproof/core/error.h"
#include "lightproof/core/file_content.h"
#include "lightproof/core/json_text.h"
#include "lightproof/core/random.h"

namespace lightproof {

const char* to_string(Metric metric) {
  switch (metric) {
    case Metric::nanoseconds:
      return "ns";
    case Metric::instructions:
      return "instructions";
    case Metric::error:
      return "error";
  }
  return "";
}

namespace {
using Json = nlohmann::json;

std::string text_of(const std::filesystem::path& file) {
  const std::optional<std::string> text = content_of(file);
  if (!text || text->empty()) {
    throw InputError(fmt::format("{}: {}", file.string(), text ? "is empty" : "cannot be read"));
  }
  return *text;
}

constexpr std::size_t kShownCharacters = 60;

[[noreturn]] void refuse_value(const Json& value, const std::string& location) {
  const std::string text = value.dump();
  throw InputError(fmt::format("{}: {}{} is not of the right type", location,
                               text.substr(0, kShownCharacters),
                               text.size() > kShownCharacters ? "…" : ""));
}

/// `value` as a T. Throws InputError, which names the place.
template <class T>
T as(const Json& value, const std::string& location) {
  try {
    return value.get<T>();
  } catch (const Json::exception&) {
    refuse_value(value, location);
  }
}

/// `value` as a number from 0 on. Throws InputError, which names the place.
template <>
int as<int>(const Json& value, const std::string& location) {
  if (!value.is_number_integer() || value < 0 || value > std::numeric_limits<int>::max()) {
    refuse_value(value, location);
  }
  return value.get<int>();
}

template <class T>
T member(const Json& object, const char* key, const std::string& location) {
  const auto found = object.find(key);
  if (found == object.end()) throw InputError(fmt::format("{}: \"{}\" is missing", location, key));
  return as<T>(*found, fmt::format("{}.{}", location, key));
}

/// Seconds since 1970 of "2026-01-31T12:00:00+01:00".
std::int64_t seconds_of(const std::string& date) {
  std::tm parts{};
  const char* end = ::strptime(date.c_str(), "%Y-%m-%dT%H:%M:%S%z", &parts);
  if (end == nullptr || *end != '\0') {
    throw InputError(
        fmt::format("context.date: \"{}\" is no date like 2026-01-31T12:00:00+00:00", date));
  }
  const long offset = parts.tm_gmtoff;
  return static_cast<std::int64_t>(::timegm(&parts)) - offset;
}

std::string machine_of(const Json& context) {
  if (context.contains("machine")) return member<std::string>(context, "machine", "context");
  return fmt::format("{}, {} CPUs", member<std::string>(context, "host_name", "context"),
                     member<int>(context, "num_cpus", "context"));
}

std::string optional_text(const Json& context, const char* key) {
  return context.contains(key) ? member<std::string>(context, key, "context") : "unknown";
}

std::string commit_of(const Json& context, const std::string& given) {
  if (!given.empty()) return given;
  const std::string commit = optional_text(context, "commit");
  if (commit != "unknown" && !commit.empty()) return commit;
  throw InputError("context.commit is missing: say which commit was measured, with --commit");
}

double nanoseconds_per(const std::string& unit, const std::string& location) {
  if (unit == "ns") return 1.0;
  if (unit == "us") return 1e3;
  if (unit == "ms") return 1e6;
  if (unit == "s") return 1e9;
  throw InputError(fmt::format("{}.time_unit: \"{}\" is none of ns, us, ms, s", location, unit));
}

double positive(double value, const std::string& location) {
  if (value > 0.0 && std::isfinite(value)) return value;
  throw InputError(fmt::format("{}: {} is not a positive number", location, value));
}

Measurement measurement_of(const Json& entry, const std::string& location) {
  const std::string name = member<std::string>(entry, "run_name", location);
  if (name.empty()) throw InputError(fmt::format("{}.run_name: is empty", location));
  if (entry.value("error_occurred", false)) {
    throw InputError(fmt::format("{}: {} failed: {}", location, name,
                                 entry.value("error_message", "no reason is given")));
  }
  const int repetition =
      entry.contains("repetition_index") ? member<int>(entry, "repetition_index", location) : 0;
  Measurement measurement{name, Metric::nanoseconds, repetition, 0.0};
  for (const Metric metric : {Metric::instructions, Metric::error}) {
    const char* counter = to_string(metric);
    if (!entry.contains(counter)) continue;
    measurement.metric = metric;
    measurement.value =
        positive(member<double>(entry, counter, location), fmt::format("{}.{}", location, counter));
    return measurement;
  }
  const bool wall = name.ends_with("/real_time") || name.ends_with("/manual_time");
  const char* key = wall ? "real_time" : "cpu_time";
  const double unit = nanoseconds_per(member<std::string>(entry, "time_unit", location), location);
  measurement.value =
      positive(unit * member<double>(entry, key, location), fmt::format("{}.{}", location, key));
  return measurement;
}

/// Counters whose names end in "_error" are errors of what was measured, beside its time: of
/// "build/table", "build/table:worst_error". What is exact, 0, cannot become worse by a ratio, and
/// is left out.
std::vector<Measurement> errors_beside(const Json& entry, const Measurement& time,
                                       const std::string& location) {
  std::vector<Measurement> errors;
  for (const auto& [key, value] : entry.items()) {
    if (!key.ends_with("_error")) continue;
    const std::string at = fmt::format("{}.{}", location, key);
    const double error = as<double>(value, at);
    if (error == 0.0) continue;
    errors.push_back({fmt::format("{}:{}", time.benchmark, key), Metric::error, time.repetition,
                      positive(error, at)});
  }
  return errors;
}

std::vector<Measurement> measurements_of(const Json& benchmarks) {
  std::vector<Measurement> all;
  std::set<std::tuple<std::string, Metric, int>> seen;
  for (std::size_t i = 0; i < benchmarks.size(); ++i) {
    const std::string location = fmt::format("benchmarks[{}]", i);
    if (!benchmarks[i].is_object()) throw InputError(location + ": is no object");
    if (benchmarks[i].value("run_type", "iteration") != "iteration") continue;
    Measurement one = measurement_of(benchmarks[i], location);
    if (!seen.emplace(one.benchmark, one.metric, one.repetition).second) {
      throw InputError(fmt::format("{}: repetition {} of {} is there twice", location,
                                   one.repetition, one.benchmark));
    }
    for (Measurement& error : errors_beside(benchmarks[i], one, location))
      all.push_back(std::move(error));
    all.push_back(std::move(one));
  }
  if (all.empty()) throw InputError("benchmarks: holds no measurement");
  return all;
}

BenchmarkRun run_of(const Json& document, const std::string& commit) {
  if (!document.is_object()) throw InputError("is no JSON object");
  const auto context = member<Json>(document, "context", "the file");
  const auto benchmarks = member<Json>(document, "benchmarks", "the file");
  if (!context.is_object()) throw InputError("context: is no object");
  if (!benchmarks.is_array()) throw InputError("benchmarks: is no array");
  return {"",
          seconds_of(member<std::string>(context, "date", "context")),
          machine_of(context),
          optional_text(context, "compiler"),
          optional_text(context, "flags"),
          commit_of(context, commit),
          0,
          measurements_of(benchmarks)};
}

}  // namespace

BenchmarkRun read_google_benchmark(const std::filesystem::path& file, const std::string& commit) {
  const std::string text = text_of(file);
  try {
    if (json_depth(text) > kDeepestJson) {
      throw InputError("no result of Google Benchmark: its values lie too deep in each other");
    }
    BenchmarkRun run = run_of(Json::parse(text), commit);
    run.digest = hash_text(text);
    return run;
  } catch (const Json::exception& error) {
    // The library's message has line and column of what it could not read.
    throw InputError(fmt::format("{}: not a result of Google Benchmark (--benchmark_out): {}",
                                 file.string(), error.what()));
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", file.string(), error.what()));
  }
}

}  // namespace lightproof
