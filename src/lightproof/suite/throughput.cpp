#include "lightproof/suite/throughput.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>

#include "lightproof/core/error.h"
#include "lightproof/samplers/registry.h"
#include "lightproof/suite/power_law.h"

extern char** environ;

namespace lightproof {
namespace fs = std::filesystem;
namespace {

void run(const fs::path& program, std::vector<std::string> arguments) {
  std::vector<char*> argv;
  std::string name = program.string();
  argv.push_back(name.data());
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  const int error = posix_spawn(&child, name.c_str(), &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) {
    throw InputError(
        fmt::format("{}: cannot be started: {}", name, std::generic_category().message(error)));
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGINT) throw Interrupted();
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    throw InputError(fmt::format("{}: failed (status {})", name, status));
  }
}

/// A folder that goes away with what is in it.
class TemporaryFolder {
 public:
  TemporaryFolder() : path_((fs::temp_directory_path() / "lightproof-XXXXXX").string()) {
    if (mkdtemp(path_.data()) == nullptr) {
      throw InputError(fmt::format("{}: cannot make a temporary folder", path_));
    }
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  fs::path file(std::string_view name) const { return fs::path(path_) / name; }

 private:
  std::string path_;
};

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

ThroughputRecord summarise(const std::smatch& name, const std::vector<nlohmann::json>& runs) {
  std::vector<double> times;
  for (const auto& run : runs) times.push_back(run.at("ns_per_sample").get<double>());
  const auto [low, high] = std::minmax_element(times.begin(), times.end());
  return {name[1],
          name[2],
          {std::stoi(name[3]), std::stoi(name[4])},
          median(times),
          *low,
          *high,
          runs.front().at("table_bytes").get<double>(),
          runs.front().at("build_ms").get<double>()};
}

}  // namespace

std::vector<ThroughputRecord> measure_throughput(const fs::path& program) {
  const TemporaryFolder folder;
  const fs::path file = folder.file("throughput.json");
  run(program,
      {"--benchmark_filter=^sample/", "--benchmark_out=" + file.string(),
       "--benchmark_out_format=json", "--benchmark_repetitions=3", "--benchmark_min_time=0.1"});
  return read_throughput(file);
}

std::vector<ThroughputRecord> read_throughput(const fs::path& file) {
  std::ifstream in(file);
  if (!in) throw InputError(fmt::format("{}: cannot be read", file.string()));
  static const std::regex name_pattern("sample/([^/]+)/([^/]+)/(\\d+)x(\\d+)/random");
  std::vector<std::pair<std::string, std::vector<nlohmann::json>>> groups;
  std::vector<ThroughputRecord> records;
  try {
    const nlohmann::json document = nlohmann::json::parse(in);
    for (const auto& run : document.at("benchmarks")) {
      if (run.value("run_type", "") != "iteration" || run.contains("error_occurred")) continue;
      const std::string name = run.at("run_name");
      if (groups.empty() || groups.back().first != name) groups.push_back({name, {}});
      groups.back().second.push_back(run);
    }
    for (const auto& [name, runs] : groups) {
      std::smatch match;
      if (std::regex_match(name, match, name_pattern)) records.push_back(summarise(match, runs));
    }
  } catch (const nlohmann::json::exception& error) {
    throw InputError(fmt::format("{}: not a result of Google Benchmark (--benchmark_out): {}",
                                 file.string(), error.what()));
  }
  return records;
}

std::vector<GrowthFit> growth_of(std::span<const ThroughputRecord> records) {
  std::vector<GrowthFit> fits;
  for (const SamplerInfo& sampler : samplers()) {
    std::vector<PowerLawPoint> points;
    for (const ThroughputRecord& record : records) {
      if (record.sampler != sampler.name) continue;
      points.push_back({static_cast<double>(record.extent.width + record.extent.height),
                        record.ns_per_sample, 1.0});
    }
    if (points.size() < 3) continue;
    const PowerLaw fit = fit_power_law(points);
    // The scatter about the line, not the repetitions, is what the exponent is uncertain by.
    double residual = 0.0;
    for (const PowerLawPoint& point : points) {
      const double r = std::log(point.y / (fit.constant * std::pow(point.x, fit.exponent)));
      residual += r * r / static_cast<double>(points.size() - 2);
    }
    fits.push_back({std::string(sampler.name), std::string(sampler.growth), fit.exponent,
                    fit.exponent_error * std::sqrt(residual)});
  }
  return fits;
}

}  // namespace lightproof
