// A plug-in, somebody else's sampler in a shared library, as a sampler that the gate tests.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "lightproof/dump/sample_row.h"
#include "lightproof/gate/sampler_under_test.h"
#include "lightproof/image/environment_map.h"
#include "lightproof/image/target_density.h"
#include "lightproof/plugin/plugin_messages.h"
#include "lightproof/plugin/plugin_process.h"

namespace lightproof {

/// How plug-ins are run.
struct PluginOptions {
  PluginLimits limits = {};
  std::uint64_t seed = 1;  ///< of those that draw with random numbers of their own
};

/// A plug-in that said what it is. Its library is only ever loaded by processes of its own.
class PluginLibrary {
 public:
  /// Loads the library in another process, and takes its description. Throws InputError that names
  /// the library if it is none, has another version, or says what makes no sense.
  PluginLibrary(std::filesystem::path file, const PluginOptions& options);

  const std::filesystem::path& file() const { return file_; }
  const PluginOptions& options() const { return options_; }
  const std::string& name() const { return name_; }
  /// What it claims to draw.
  TargetDensity target() const { return target_; }
  /// What its rows and positions are.
  const SampleRows& rows() const { return rows_; }
  /// By how much, in radians, rounding may move its directions.
  double rounding() const { return rounding_; }
  const PluginDescription& description() const { return description_; }

 private:
  std::filesystem::path file_;
  PluginOptions options_;
  PluginDescription description_;
  std::string name_;
  TargetDensity target_;
  SampleRows rows_;
  double rounding_;
};

/// What plug-ins printed, and what went wrong at their end: one sentence each. Many threads may
/// add.
class PluginNotes {
 public:
  PluginNotes();
  ~PluginNotes();
  PluginNotes(const PluginNotes&) = delete;
  PluginNotes& operator=(const PluginNotes&) = delete;

  /// Adds what is not there yet.
  void add(const std::string& note);
  std::vector<std::string> all() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// The sampler that a plug-in makes of a map, which must outlive it. Processes of the plug-in are
/// started as they are needed, one for each thread that asks, and end with it. Its functions throw
/// SamplerFailure where the plug-in does not answer, with the input at fault, which is looked for
/// by asking for each item of a batch alone, in a new process. Throws InputError if a picture of
/// the map cannot be had in the plug-in's convention, SamplerFailure if no sampler is made of it.
BoundSampler bound_plugin(std::shared_ptr<const PluginLibrary> library, const EnvironmentMap& map,
                          std::shared_ptr<PluginNotes> notes);

/// A plug-in as a sampler under test.
SamplerUnderTest sampler_under_test(std::shared_ptr<const PluginLibrary> library,
                                    std::shared_ptr<PluginNotes> notes);

/// What a plug-in's sample() costs in its own process, without the way there and back.
struct PluginTime {
  double cpu_nanoseconds = 0.0;   ///< processor time of a sample, of all its threads together
  double wall_nanoseconds = 0.0;  ///< time that passes for a sample
};

/// A process of a plug-in with the sampler of a map, for timing it.
class TimedPlugin {
 public:
  /// Starts a process with the sampler of a map. Throws what bound_plugin() throws.
  TimedPlugin(const PluginLibrary& library, const EnvironmentMap& map);
  ~TimedPlugin();
  TimedPlugin(const TimedPlugin&) = delete;
  TimedPlugin& operator=(const TimedPlugin&) = delete;

  /// Has a batch drawn at these points, at most kPluginBatch of them. Throws SamplerFailure.
  PluginTime draw(std::span<const SquarePoint> points) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace lightproof
