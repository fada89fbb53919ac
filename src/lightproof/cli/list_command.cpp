// lightproof list: the registries.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "common.h"
#include "describe_run.h"
#include "known_names.h"
#include "lightproof/check/direction_target.h"
#include "lightproof/estimators/registry.h"
#include "lightproof/gate/direction_sampler.h"
#include "lightproof/image/synthetic.h"
#include "lightproof/image/target_density.h"
#include "lightproof/materials/material.h"
#include "lightproof/points/registry.h"
#include "lightproof/render/receiver.h"
#include "lightproof/samplers/registry.h"
#include "lightproof/self_test/direction_mutant.h"
#include "lightproof/self_test/mutant.h"
#include "lightproof/systems/registry.h"
#include "lightproof/warp/preset.h"

namespace lightproof::cli {
namespace {

using Json = nlohmann::ordered_json;

struct Entry {
  std::string name;
  std::string description;
  Json more = {};  ///< what JSON says beside: an object, or null
};

template <class Range>
std::vector<Entry> described(const Range& range) {
  std::vector<Entry> entries;
  for (const auto& item : range) {
    entries.push_back({std::string(item.name), std::string(item.description)});
  }
  return entries;
}

std::vector<Entry> sampler_entries() {
  std::vector<Entry> entries;
  for (const SamplerInfo& sampler : samplers()) {
    entries.push_back({std::string(sampler.name),
                       fmt::format("{}; O({}) a sample{}{}", sampler.source, sampler.growth,
                                   sampler.monotone ? "; monotone" : "",
                                   sampler.known_defects ? "; with known defects" : "")});
  }
  for (const DirectionSamplerInfo& sampler : all_direction_samplers()) {
    entries.push_back({sampler.name, "directions: " + sampler.description});
  }
  return entries;
}

/// The names of the materials that an estimator serves.
Json served_by(const EstimatorInfo& info) {
  Json names = Json::array();
  for (const MaterialInfo& material : materials()) {
    if (info.serves(material.material)) names.push_back(material.name);
  }
  return names;
}

std::vector<Entry> estimator_entries() {
  std::vector<Entry> entries;
  for (const EstimatorInfo& info : estimators()) {
    entries.push_back({std::string(info.name),
                       fmt::format("{}; {}, {} ({})", info.description, to_string(info.kind),
                                   info.is_biased ? "biased" : "unbiased", info.source),
                       {{"kind", to_string(info.kind)},
                        {"biased", info.is_biased},
                        {"source", info.source},
                        {"ignores_occlusion", info.ignores_occlusion},
                        {"materials", served_by(info)}}});
  }
  return entries;
}

std::vector<Entry> mutant_entries() {
  std::vector<Entry> entries;
  for (const Mutant& mutant : mutants()) {
    const std::string needs =
        mutant.needs.empty() ? "" : fmt::format(" (shows on maps with {})", mutant.needs);
    entries.push_back({std::string(mutant.name),
                       std::string(mutant.defect) + needs,
                       {{"over", "map"}, {"diagnosis", mutant.diagnosis}}});
  }
  for (const DirectionMutant& mutant : direction_mutants()) {
    entries.push_back({mutant.sampler.name,
                       mutant.sampler.description,
                       {{"over", "directions"}, {"diagnosis", mutant.diagnosis}}});
  }
  return entries;
}

std::vector<Entry> point_set_entries() {
  std::vector<Entry> entries;
  for (const PointSetInfo& set : point_sets()) {
    entries.push_back(
        {std::string(set.name),
         fmt::format("{}; {}, {}{}{} ({})", set.description, to_string(set.kind),
                     set.is_finite ? "finite" : "infinite",
                     set.is_float ? ", in float as shaders have it" : "",
                     set.defect.empty() ? "" : fmt::format("; defect: {}", set.defect), set.source),
         {{"kind", to_string(set.kind)},
          {"finite", set.is_finite},
          {"float", set.is_float},
          {"defect", set.defect.empty() ? Json(nullptr) : Json(set.defect)}}});
  }
  return entries;
}

std::vector<Entry> system_entries() {
  std::vector<Entry> entries;
  for (const SystemInfo& system : systems()) {
    const std::string_view document = document_of(system);
    entries.push_back(
        {std::string(system.id),
         fmt::format("{}; {}{}; test {}", system.name, document,
                     system.is_inferred ? " (inferred)" : "", system.test),
         {{"document", document}, {"inferred", system.is_inferred}, {"test", system.test}}});
  }
  return entries;
}

std::vector<Entry> density_entries() {
  std::vector<Entry> entries;
  for (const DensityInfo& density : kDensities) {
    entries.push_back(
        {std::string(density.label), fmt::format("{}: {}", density.name, density.words)});
  }
  return entries;
}

std::vector<Entry> target_entries() {
  std::vector<Entry> entries;
  for (const DirectionTargetInfo& target : direction_targets()) {
    entries.push_back({std::string(target.form), std::string(target.description)});
  }
  return entries;
}

std::vector<Entry> entries_of(const std::string& registry) {
  if (registry == "samplers") return sampler_entries();
  if (registry == "densities") return density_entries();
  if (registry == "mutants") return mutant_entries();
  if (registry == "maps") return described(synthetic_maps());
  if (registry == "presets") return described(presets());
  if (registry == "materials") return described(materials());
  if (registry == "receivers") return described(receivers());
  if (registry == "points") return point_set_entries();
  if (registry == "targets") return target_entries();
  if (registry == "systems") return system_entries();
  return estimator_entries();
}

const std::vector<std::string> kRegistries = {"samplers", "densities", "mutants",   "maps",
                                              "presets",  "materials", "receivers", "estimators",
                                              "points",   "systems",   "targets"};

/// Version of the format of `list --json` (docs/schema/list.schema.json).
constexpr int kListFormatVersion = 1;

struct Options {
  CommandLine command_line;
  std::string registry;
  bool json = false;
};

int run(const Options& options) {
  const std::vector<Entry> entries = entries_of(options.registry);
  if (options.json) {
    Json list = Json::array();
    for (const Entry& entry : entries) {
      list.push_back({{"name", entry.name}, {"description", entry.description}});
      if (!entry.more.is_null()) list.back().update(entry.more);
    }
    const RunDescription run = describe_run(options.command_line);
    const Json document = {{"format_version", kListFormatVersion},
                           {"version", run.version},
                           {"commit", run.commit.empty() ? Json(nullptr) : Json(run.commit)},
                           {"command", run.command},
                           {"registry", options.registry},
                           {"entries", list}};
    fmt::print("{}\n", document.dump(2, ' ', false, Json::error_handler_t::replace));
    return kPassed;
  }
  std::size_t width = 0;
  for (const Entry& entry : entries) width = std::max(width, entry.name.size());
  for (const Entry& entry : entries) {
    fmt::print("{:<{}}  {}\n", entry.name, width, entry.description);
  }
  return kPassed;
}

}  // namespace

void add_list(CLI::App& app, const CommandLine& line, int& exit_code) {
  auto options = std::make_shared<Options>();
  options->command_line = line;
  CLI::App* command = app.add_subcommand("list", "Print a registry");
  command->add_option("WHAT", options->registry, "which registry")
      ->required()
      ->check(one_of("registry", kRegistries))
      ->type_name(fmt::format("{}", fmt::join(kRegistries, "|")));
  command->add_flag("--json", options->json, "as JSON");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace lightproof::cli
