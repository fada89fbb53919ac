// Replicates of a measurement, some of which are a cell of work; what they find is added up.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "lightproof/core/executor.h"
#include "lightproof/core/progress.h"

namespace lightproof {

/// How many replicates did what they were asked for.
struct Count {
  std::uint64_t value = 0;

  void merge(const Count& other) { value += other.value; }
  static auto fields(auto& count) { return std::tie(count.value); }
};

/// Replicates 0 … count-1 of one measurement.
template <class Found>
struct Replicates {
  /// Adds what one replicate finds.
  using Add = std::function<void(std::uint64_t replicate, Found& found)>;

  std::string name;  ///< "calibration/p-values"
  std::uint64_t count;
  /// Makes what all of them share.
  std::function<Add()> prepare;
};

/// Of replicates that are one cell of work.
inline constexpr std::uint64_t kReplicatesOfCell = 20;

/// "calibration/p-values/00000000000000000020": in order of the replicates.
std::string key_of_replicate(const std::string& name, std::uint64_t replicate);

/// What the replicates of each measurement find together, folded in their order: a Found is merged
/// and goes through bytes. Progress is told as that of the self-test.
template <class Found>
std::vector<Found> compute_replicates(std::span<const Replicates<Found>> measurements,
                                      const Progress& progress, const Communicator& communicator) {
  using Add = typename Replicates<Found>::Add;
  std::vector<WorkGroup<Add, Found>> groups;
  for (const Replicates<Found>& replicates : measurements) {
    WorkGroup<Add, Found> group{replicates.prepare, {}};
    for (std::uint64_t first = 0; first < replicates.count; first += kReplicatesOfCell) {
      const std::uint64_t end = std::min(replicates.count, first + kReplicatesOfCell);
      group.cells.push_back(
          {key_of_replicate(replicates.name, first), [first, end](const Add& add) {
             Found found;
             for (std::uint64_t i = first; i < end; ++i) add(i, found);
             return found;
           }});
    }
    groups.push_back(std::move(group));
  }
  auto results = gather(
      compute_groups<Add, Found>(groups, communicator.share, progress, "self-test"), communicator);
  std::vector<Found> found(measurements.size());
  for (std::size_t i = 0; i < groups.size(); ++i) {
    for (const auto& cell : groups[i].cells) found[i].merge(results.at(cell.key));
  }
  return found;
}

}  // namespace lightproof
