// A process that has loaded a plug-in, and is asked to call its functions.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "lightproof/core/child_conversation.h"
#include "lightproof/core/pipe.h"
#include "lightproof/core/shared_memory.h"
#include "lightproof/plugin/plugin_messages.h"

namespace lightproof {

/// What a plug-in may take.
struct PluginLimits {
  /// For one batch of at most kPluginBatch samples; making a sampler may take ten times as long.
  std::chrono::milliseconds batch_time{10'000};
  /// Private memory of its process. 0: 1 GiB, and 64 bytes a texel; and then, once it is made, no
  /// more for every sample or density: growth beyond 16 MiB, 64 bytes a texel, and 8 bytes for each
  /// that was asked for is a leak.
  std::uint64_t memory_bytes = 0;

  /// The memory that is allowed for a map of so many texels.
  std::uint64_t memory_for(std::size_t texels) const;
};

/// How a call of a plug-in went.
struct PluginAnswer {
  /// What became of a call that was not answered: "crashed (signal 11, Segmentation fault)"; empty
  /// if it was.
  std::string failure = {};
  double cpu_seconds = 0.0;      ///< processor time in the plug-in's function, of all its threads
  double wall_seconds = 0.0;     ///< time that passed meanwhile
  std::uint64_t held_bytes = 0;  ///< private memory of the process afterwards
  bool is_over_memory = false;   ///< it was answered, but by a process that holds too much by now
  /// Of a call item by item: how many were done before the one that failed, or before there was no
  /// more time.
  std::size_t items_done = 0;

  bool is_done() const { return failure.empty(); }
};

/// A process of lightproof-plugin-host. After a failure it is of no more use.
class PluginProcess {
 public:
  /// Starts it; `map`, the texels of a map, may be null where only a description is wanted. Throws
  /// InputError if it cannot be started, std::bad_alloc if there is no memory.
  PluginProcess(const std::filesystem::path& library, const PluginLimits& limits,
                const SharedMemory* map);
  ~PluginProcess();
  PluginProcess(const PluginProcess&) = delete;
  PluginProcess& operator=(const PluginProcess&) = delete;

  /// What the plug-in says of itself. Throws InputError, which names the library, if it says
  /// nothing.
  PluginDescription describe();

  /// Has a sampler made of the map. The size of the map, its name and weights, and the numbers of
  /// rows and positions are in the request.
  PluginAnswer create(PluginRequest request, std::size_t texels);

  /// Has sample, draw or pdf called. Item by item, each may take the time of a batch, and all
  /// together ten times as long; then those that were done are counted, and the rest is left.
  PluginAnswer call(const PluginRequest& request);

  /// What goes into a batch, and what comes out of it.
  std::span<double> inputs() const;
  std::span<const double> outputs() const;

  /// What the plug-in had printed when its process ended, in one line, shortened; empty if nothing.
  std::string printed() const;

  /// Has the sampler destroyed and ends the process. Returns what was wrong with that, in words;
  /// nothing after a failure, which has said what was wrong.
  std::string end();

 private:
  PluginAnswer ask(const PluginRequest& request, std::chrono::milliseconds patience,
                   std::string* text = nullptr);
  std::string words_of(Exchange exchange, std::chrono::milliseconds patience);
  std::string words_of_end();
  /// Whether what the process holds has grown with what it was asked for.
  bool leaks(std::uint64_t held_bytes) const;
  /// Makes a failure of an answer by a process that holds too much.
  void judge_memory(PluginAnswer& answer) const;
  /// Ends the process and whatever it may have started.
  void end_group();

  std::filesystem::path library_;
  PluginLimits limits_;
  std::uint64_t shared_bytes_ = 0;
  std::uint64_t allowed_bytes_ = 0;
  std::uint64_t held_at_first_ = 0;  ///< once the sampler was made
  std::uint64_t held_before_ = 0;    ///< by the last call
  std::uint64_t kept_ = 0;      ///< growth since the sampler was made, without that of single calls
  std::uint64_t may_keep_ = 0;  ///< of kept_; 0: anything
  std::uint64_t items_ = 0;     ///< that were asked for since then
  bool is_killed_ = false;      ///< by end_group()
  SharedMemory batch_;
  SharedMemory log_;  ///< what the process has taken out of the pipe
  Pipe prints_;
  std::optional<ChildConversation> child_;
};

}  // namespace lightproof
