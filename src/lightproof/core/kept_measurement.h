// What was measured of a program on a machine, kept until program, machine or what else it depends
// on changes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include "lightproof/core/kept_file.h"
#include "lightproof/core/serialise.h"

namespace lightproof {

/// Where measurements are kept, and of which program.
struct MeasurementCache {
  std::filesystem::path folder;   ///< empty: nothing is kept
  std::filesystem::path program;  ///< the one that is measured; nothing is kept if it is unreadable
  std::string commit;             ///< that it was built from; empty if it is not known
  bool measure_again = false;     ///< whatever is kept
};

/// What was measured, and where and when: "2026-11-28T13:41:08+00:00, 2 x processor, GNU 12.2.0,
/// commit 1a2b3c…".
template <class Value>
struct KeptMeasurement {
  std::string origin;
  Value value;

  static auto fields(auto& kept) { return std::tie(kept.origin, kept.value); }
};

/// When and where something is measured, as an origin: now, on this machine, by this compiler, and
/// of a commit if it is not empty.
std::string origin_now(std::string_view commit);

/// The measurements that are kept of one program. Damaged files are replaced.
class MeasurementKeeper {
 public:
  explicit MeasurementKeeper(MeasurementCache cache);

  /// What is kept under this name of this program, to the last byte, on this machine, with this
  /// compiler and commit, and for `dependence`, which is all else that it depends on; or what
  /// `measure` returns, which is kept then. A Value is what ValueWriter and ValueReader know.
  template <class Value, class Measure>
  KeptMeasurement<Value> get(std::string name, std::string_view dependence,
                             const Measure& measure) const {
    const KeptFile file = file_of(std::move(name), dependence);
    if (!cache_.measure_again) {
      if (auto kept = read<Value>(file)) return *std::move(kept);
    }
    const KeptMeasurement<Value> measured = {origin_now(cache_.commit), measure()};
    ValueWriter writer;
    writer.add(measured);
    keep(file, writer.take());
    return measured;
  }

 private:
  template <class Value>
  static std::optional<KeptMeasurement<Value>> read(const KeptFile& file) {
    const std::optional<std::string> bytes = read_kept(file);
    if (!bytes) return std::nullopt;
    try {
      ValueReader reader(*bytes);
      auto kept = reader.value<KeptMeasurement<Value>>();
      return reader.is_at_end() ? std::optional(std::move(kept)) : std::nullopt;
    } catch (const std::out_of_range&) {
      return std::nullopt;
    }
  }

  KeptFile file_of(std::string name, std::string_view dependence) const;

  MeasurementCache cache_;
  std::optional<std::uint64_t> program_;  ///< a hash of it
};

}  // namespace lightproof
