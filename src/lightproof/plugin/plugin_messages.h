// What the libraries and lightproof-plugin-host say to each other over a socket: requests and
// replies of fixed size, as they lie in memory (both are one build on one machine). Numbers of
// samples stand in memory that both share. A plug-in sees none of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <tuple>

#include "lightproof/plugin/lightproof_plugin.h"

namespace lightproof {

/// Samples, or densities, of one batch.
inline constexpr std::size_t kPluginBatch = LIGHTPROOF_PLUGIN_BATCH;
/// Samples of one call of draw().
inline constexpr std::size_t kPluginDrawn = LIGHTPROOF_PLUGIN_DRAWN;
/// The most columns that rows of samples have, and numbers that a position has.
inline constexpr std::size_t kMostPluginColumns = 8;
inline constexpr std::size_t kMostPositionNumbers = 3;

/// Shared memory of a batch, in numbers: first what goes in (random numbers or positions), then
/// what comes out (rows or densities).
inline constexpr std::size_t kPluginInputs = kPluginBatch * kMostPositionNumbers;
inline constexpr std::size_t kPluginOutputs = kPluginBatch * kMostPluginColumns;

/// Bytes of what a plug-in prints that are kept.
inline constexpr std::size_t kPluginLogBytes = std::size_t{64} << 10U;

/// Descriptors of the host, beside the socket at its standard input.
inline constexpr int kPluginBatchFile = 3;
inline constexpr int kPluginLogFile = 4;
inline constexpr int kPluginPrintsEnd = 5;  ///< of the pipe for what is printed: for reading
inline constexpr int kPluginPrintEnd = 6;   ///< for writing
inline constexpr int kPluginMapFile = 7;    ///< not there before there is a map

/// Exit statuses of the host once nobody asks any more; any other is the plug-in's own.
enum PluginEnd : int {
  kPluginDestroyed = 0,  ///< destroy() has returned
  kPluginStuck = 124,    ///< it did not return in time
  kPluginThrew = 125,    ///< it threw an exception
};

/// What the host is asked to do.
enum class PluginCall : std::uint32_t {
  describe,  ///< answered by a PluginDescription
  create,
  sample,
  draw,
  pdf,
};

struct PluginRequest {
  PluginCall call = PluginCall::describe;
  /// Whether items are asked for one by one, and each reported by a byte before the next one.
  std::uint32_t one_by_one = 0;
  std::uint64_t count = 0;
  std::uint64_t first = 0;  ///< of draw
  std::uint64_t seed = 0;   ///< of draw
  /// Of describe and create: the memory that the process may hold beside what it shares.
  std::uint64_t memory_bytes = 0;
  // Of create:
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t columns = 0;           ///< numbers of a row
  std::uint32_t position_numbers = 0;  ///< numbers of a position
  double luminance[3] = {};
  char map_name[256] = {};
};

enum class PluginStatus : std::uint32_t { done, failed };

/// A byte in front of every reply to a request that goes item by item: how that item went.
enum class PluginItem : char { done = 1, failed = 2 };

struct PluginReply {
  PluginStatus status = PluginStatus::failed;
  std::uint32_t unused = 0;
  double cpu_seconds = 0.0;      ///< processor time in the plug-in's function
  double wall_seconds = 0.0;     ///< time that passed meanwhile
  std::uint64_t held_bytes = 0;  ///< memory that the process holds beside what it shares
  std::uint64_t text_bytes = 0;  ///< of the text that follows: a reason, or a description
};

/// The longest text of a reply.
inline constexpr std::uint64_t kLongestPluginText = std::uint64_t{1} << 16U;

/// What a plug-in says of itself; empty texts stand for defaults.
struct PluginDescription {
  std::string name = {};
  std::string columns = {};
  std::string axes = {};
  std::string preset = {};
  std::string measure = {};
  std::string density = {};
  std::string luminance = {};
  double rounding = 0.0;
  bool has_sample = false;
  bool has_draw = false;
  bool has_pdf = false;

  static auto fields(auto& d) {
    return std::tie(d.name, d.columns, d.axes, d.preset, d.measure, d.density, d.luminance,
                    d.rounding, d.has_sample, d.has_draw, d.has_pdf);
  }
};

}  // namespace lightproof
