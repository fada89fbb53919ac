// Options that name plug-ins, and what these may take.
#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "lightproof/gate/sampler_under_test.h"
#include "lightproof/plugin/plugin_library.h"
#include "lightproof/results/gate_result.h"

namespace lightproof::cli {

/// Plug-ins by the names of their files.
struct ChosenPlugins {
  std::vector<std::string> files;
  double batch_seconds = 10.0;
  std::uint64_t memory_bytes = 0;  ///< 0: as PluginLimits has it
};

/// Adds --plugin, --plugin-seconds and --plugin-memory.
void add_plugin_options(CLI::App& command, ChosenPlugins& plugins);

using PluginLibraries = std::vector<std::shared_ptr<const PluginLibrary>>;

/// The plug-ins, in the order of their files. Throws InputError if a file is none.
PluginLibraries load_plugins(const ChosenPlugins& plugins, std::uint64_t seed);

/// The samplers of plug-ins, in their order; notes on what they print go to `notes`.
std::vector<SamplerUnderTest> samplers_of(const PluginLibraries& libraries,
                                          const std::shared_ptr<PluginNotes>& notes);

/// Adds samplers of plug-ins to others. Throws InputError if two have one name: records tell
/// samplers by their names.
void add_plugins(const std::vector<SamplerUnderTest>& plugins,
                 std::vector<SamplerUnderTest>& samplers);

/// Prints notes on samplers as lines on stderr.
void print_notes(const std::vector<std::string>& notes);

/// How a command line that repeats a run names each plug-in.
std::vector<ThirdPartySampler> third_party_samplers(const PluginLibraries& libraries,
                                                    const ChosenPlugins& plugins);

}  // namespace lightproof::cli
