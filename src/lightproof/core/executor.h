// Work as independent cells with stable keys. What a cell computes depends on its key alone, so
// that any share of the cells can be computed anywhere, in any order, and the results put together:
// they are folded in the order of their keys, with the same bits for any number of threads or
// processes.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lightproof/core/parallel.h"
#include "lightproof/core/progress.h"
#include "lightproof/core/serialise.h"

namespace lightproof {

/// A part of the work, "convergence/city/sphere/phong/uniform".
template <class Result>
struct WorkCell {
  std::string key;
  std::function<Result()> compute;
  bool one_at_a_time = false;  ///< see WorkGroup
};

/// Cells that share what is expensive to make, the exact side of a test for example. It is made
/// once by each process that computes any of them, and kept while it does.
template <class Shared, class Result>
struct WorkGroup {
  struct Cell {
    std::string key;
    std::function<Result(const Shared&)> compute;
  };
  std::function<Shared()> prepare;
  std::vector<Cell> cells;
  /// Whether its cells take so much memory that each is computed when no other is: the parallel
  /// loops inside of it have all threads then.
  bool one_at_a_time = false;
};

/// The part of all cells that one process computes. In the order of their keys they are cut into
/// `of` equal parts: neighbours, which are likely to share something, stay together.
struct WorkShare {
  std::size_t index = 0;
  std::size_t of = 1;  ///< at least 1

  bool holds(std::size_t rank, std::size_t count) const {
    return index * count / of <= rank && rank < (index + 1) * count / of;
  }
};

/// What cells have given before, as bytes by their keys. Empty functions keep nothing.
struct KeptCells {
  std::function<std::optional<std::string>(const std::string& key)> find = {};
  /// Called from any thread.
  std::function<void(const std::string& key, std::string_view bytes)> keep = {};
};

/// The processes among which cells are shared out, as one of them sees it. By default it is alone.
struct Communicator {
  WorkShare share = {};
  /// Gives these bytes to all processes and returns those of each, its own among them. All
  /// processes call it equally often and outside of parallel loops. Empty for one that is alone.
  std::function<std::vector<std::string>(std::string bytes)> all_gather = {};
  /// The cells of this process's share that an earlier, unfinished run has kept.
  KeptCells kept = {};
};

/// Results of cells by key, which is the order in which they are folded.
template <class Result>
using CellResults = std::map<std::string, Result>;

/// The keys that fall into a share. Throws std::logic_error if two are the same.
inline std::set<std::string_view> keys_of_share(std::vector<std::string_view> keys,
                                                WorkShare share) {
  std::sort(keys.begin(), keys.end());
  const auto twice = std::adjacent_find(keys.begin(), keys.end());
  if (twice != keys.end()) {
    throw std::logic_error("two cells of work have the key " + std::string(*twice));
  }
  std::set<std::string_view> mine;
  for (std::size_t rank = 0; rank < keys.size(); ++rank) {
    if (share.holds(rank, keys.size())) mine.insert(mine.end(), keys[rank]);
  }
  return mine;
}

/// What is kept of a cell; none if nothing is, or nothing that is a Result.
template <class Result>
std::optional<Result> kept_result(const KeptCells& kept, const std::string& key) {
  const std::optional<std::string> bytes = kept.find ? kept.find(key) : std::nullopt;
  if (!bytes) return std::nullopt;
  try {
    ValueReader reader(*bytes);
    auto result = reader.value<Result>();
    return reader.is_at_end() ? std::optional(std::move(result)) : std::nullopt;
  } catch (const std::out_of_range&) {
    return std::nullopt;
  }
}

/// Computes a share of the cells of all groups, in parallel, but for those that are kept; the
/// others are kept as they end. Throws std::logic_error if two have one key. `progress` is told the
/// step and the fraction of the share that is done.
template <class Shared, class Result>
CellResults<Result> compute_groups(std::span<const WorkGroup<Shared, Result>> groups,
                                   WorkShare share = {}, const Progress& progress = {},
                                   std::string_view step = {}, const KeptCells& kept = {}) {
  std::vector<std::string_view> keys;
  for (const auto& group : groups) {
    for (const auto& cell : group.cells) keys.emplace_back(cell.key);
  }
  const std::set<std::string_view> mine = keys_of_share(std::move(keys), share);
  CellResults<Result> results;
  std::mutex mutex;
  const auto compute_group = [&](const WorkGroup<Shared, Result>& group) {
    std::vector<const typename WorkGroup<Shared, Result>::Cell*> cells;
    for (const auto& cell : group.cells) {
      if (!mine.contains(cell.key)) continue;
      if (std::optional<Result> known = kept_result<Result>(kept, cell.key)) {
        const std::lock_guard lock(mutex);
        results.emplace(cell.key, *std::move(known));
      } else {
        cells.push_back(&cell);
      }
    }
    if (cells.empty()) return;
    const Shared shared = group.prepare();
    const auto compute_cell = [&](std::size_t i) {
      throw_if_interrupted();
      Result result = cells[i]->compute(shared);
      if (kept.keep) {
        ValueWriter writer;
        writer.add(result);
        kept.keep(cells[i]->key, writer.take());
      }
      const std::lock_guard lock(mutex);
      results.emplace(cells[i]->key, std::move(result));
      if (progress) {
        progress(step, static_cast<double>(results.size()) / static_cast<double>(mine.size()));
      }
    };
    if (!group.one_at_a_time) return parallel_for(cells.size(), compute_cell);
    for (std::size_t i = 0; i < cells.size(); ++i) compute_cell(i);
  };
  std::vector<const WorkGroup<Shared, Result>*> together;
  for (const auto& group : groups) {
    if (!group.one_at_a_time) together.push_back(&group);
  }
  parallel_for(together.size(), [&](std::size_t g) { compute_group(*together[g]); });
  for (const auto& group : groups) {
    if (group.one_at_a_time) compute_group(group);
  }
  return results;
}

/// compute_groups() of cells that share nothing.
template <class Result>
CellResults<Result> compute_cells(std::span<const WorkCell<Result>> cells, WorkShare share = {},
                                  const Progress& progress = {}, std::string_view step = {},
                                  const KeptCells& kept = {}) {
  struct Nothing {};
  std::vector<WorkGroup<Nothing, Result>> groups;
  for (const WorkCell<Result>& cell : cells) {
    groups.push_back({[] { return Nothing(); },
                      {{cell.key, [&cell](const Nothing&) { return cell.compute(); }}},
                      cell.one_at_a_time});
  }
  return compute_groups<Nothing, Result>(groups, share, progress, step, kept);
}

/// Adds the results of another share. Throws std::logic_error if a key is in both.
template <class Result>
void join(CellResults<Result>& results, CellResults<Result> more) {
  results.merge(more);
  if (!more.empty()) {
    throw std::logic_error("the cell of work " + more.begin()->first + " was computed twice");
  }
}

/// Results as bytes, for another process. A Result is what ValueWriter and ValueReader know.
template <class Result>
std::string bytes_of(const CellResults<Result>& results) {
  ValueWriter writer;
  writer.add(results);
  return writer.take();
}

/// What bytes_of() wrote. Throws std::out_of_range if bytes are missing or a key is there twice,
/// std::logic_error if some are left.
template <class Result>
CellResults<Result> results_of(std::string_view bytes) {
  ValueReader reader(bytes);
  auto results = reader.value<CellResults<Result>>();
  if (!reader.is_at_end()) throw std::logic_error("bytes are left behind the last cell of work");
  return results;
}

/// The results of the shares of all processes, at each of them.
template <class Result>
CellResults<Result> gather(CellResults<Result> own, const Communicator& communicator) {
  if (!communicator.all_gather) return own;
  CellResults<Result> all;
  for (const std::string& bytes : communicator.all_gather(bytes_of(own))) {
    join(all, results_of<Result>(bytes));
  }
  return all;
}

}  // namespace lightproof
