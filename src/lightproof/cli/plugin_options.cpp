#include "plugin_options.h"

#include <fmt/format.h>

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>

#include "common.h"
#include "lightproof/core/error.h"
#include "lightproof/core/text_escapes.h"
#include "messages.h"
#include "whole_number.h"

namespace lightproof::cli {
namespace {

constexpr double kLeastSeconds = 1e-3;
constexpr double kMostSeconds = 86400.0;
constexpr std::uint64_t kMostMemory = std::uint64_t{1} << 50U;

}  // namespace

void add_plugin_options(CLI::App& command, ChosenPlugins& plugins) {
  command
      .add_option("--plugin", plugins.files,
                  "test the sampler in this shared library (may be repeated; see `lightproof "
                  "new-plugin`); it runs in processes of its own")
      ->type_name("PATH")
      ->allow_extra_args(false);
  command
      .add_option("--plugin-seconds", plugins.batch_seconds,
                  "time that a plug-in may take for a batch of at most 4096 samples, and a tenth "
                  "of what it may take for a map")
      ->check(CLI::Range(kLeastSeconds, kMostSeconds))
      ->type_name("S")
      ->capture_default_str();
  add_number(
      command, "--plugin-memory", plugins.memory_bytes, 0, kMostMemory,
      fmt::format("bytes of memory that a plug-in may hold beside the map; 0: 2^30, and 64 a "
                  "texel, and no leak; {}",
                  kWholeNumberForms));
}

PluginLibraries load_plugins(const ChosenPlugins& plugins, std::uint64_t seed) {
  PluginOptions options;
  options.limits.batch_time = std::chrono::milliseconds(std::llround(1e3 * plugins.batch_seconds));
  options.limits.memory_bytes = plugins.memory_bytes;
  options.seed = seed;
  PluginLibraries libraries;
  for (const std::string& file : plugins.files) {
    libraries.push_back(std::make_shared<const PluginLibrary>(file, options));
  }
  return libraries;
}

std::vector<SamplerUnderTest> samplers_of(const PluginLibraries& libraries,
                                          const std::shared_ptr<PluginNotes>& notes) {
  std::vector<SamplerUnderTest> samplers;
  for (const auto& library : libraries) samplers.push_back(sampler_under_test(library, notes));
  return samplers;
}

void add_plugins(const std::vector<SamplerUnderTest>& plugins,
                 std::vector<SamplerUnderTest>& samplers) {
  for (const SamplerUnderTest& plugin : plugins) {
    if (std::ranges::find(samplers, plugin.name, &SamplerUnderTest::name) != samplers.end()) {
      throw InputError(fmt::format(
          "--plugin: two samplers of this run are called {}: give the plug-in another name",
          plugin.name));
    }
    samplers.push_back(plugin);
  }
}

void print_notes(const std::vector<std::string>& notes) {
  for (const std::string& note : notes) tell("{}\n", terminal_text(note));
}

std::vector<ThirdPartySampler> third_party_samplers(const PluginLibraries& libraries,
                                                    const ChosenPlugins& plugins) {
  const ChosenPlugins usual;
  std::string limits;
  if (plugins.batch_seconds != usual.batch_seconds) {
    limits += fmt::format(" --plugin-seconds {}", plugins.batch_seconds);
  }
  if (plugins.memory_bytes != usual.memory_bytes) {
    limits += fmt::format(" --plugin-memory {}", plugins.memory_bytes);
  }
  std::vector<ThirdPartySampler> samplers;
  for (const auto& library : libraries) {
    samplers.push_back(
        {library->name(),
         fmt::format("--plugin {}{}", shell_word(library->file().string()), limits)});
  }
  return samplers;
}

}  // namespace lightproof::cli
