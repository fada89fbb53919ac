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
#include <span>
#include <stdexcept>
#include <string>
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
};

/// The part of all cells that one process computes: those whose rank among all keys leaves `index`
/// when divided by `of`.
struct WorkShare {
  std::size_t index = 0;
  std::size_t of = 1;  ///< at least 1
};

/// By key, and so in the order in which they are folded.
template <class Result>
using CellResults = std::map<std::string, Result>;

/// Computes a share of the cells, in parallel. Throws std::logic_error if two have one key.
/// `progress` is told the step and the fraction of the share that is done.
template <class Result>
CellResults<Result> compute_cells(std::span<const WorkCell<Result>> cells, WorkShare share = {},
                                  const Progress& progress = {}, std::string_view step = {}) {
  std::vector<const WorkCell<Result>*> sorted;
  for (const WorkCell<Result>& cell : cells) sorted.push_back(&cell);
  std::sort(sorted.begin(), sorted.end(), [](auto* a, auto* b) { return a->key < b->key; });
  std::vector<const WorkCell<Result>*> mine;
  for (std::size_t rank = 0; rank < sorted.size(); ++rank) {
    if (rank > 0 && sorted[rank]->key == sorted[rank - 1]->key) {
      throw std::logic_error("two cells of work have the key " + sorted[rank]->key);
    }
    if (rank % share.of == share.index) mine.push_back(sorted[rank]);
  }
  std::vector<Result> results(mine.size());
  std::mutex mutex;
  std::size_t done = 0;
  parallel_for(mine.size(), [&](std::size_t i) {
    results[i] = mine[i]->compute();
    const std::lock_guard lock(mutex);
    ++done;
    if (progress) progress(step, static_cast<double>(done) / static_cast<double>(mine.size()));
  });
  CellResults<Result> by_key;
  for (std::size_t i = 0; i < mine.size(); ++i) by_key.emplace(mine[i]->key, std::move(results[i]));
  return by_key;
}

/// Adds the results of another share. Throws std::logic_error if a key is in both.
template <class Result>
void join(CellResults<Result>& results, CellResults<Result> more) {
  results.merge(more);
  if (!more.empty()) {
    throw std::logic_error("the cell of work " + more.begin()->first + " was computed twice");
  }
}

/// Results as bytes, for another process. A Result has a default constructor, write(ByteWriter&)
/// and a static read(ByteReader&).
template <class Result>
std::string bytes_of(const CellResults<Result>& results) {
  ByteWriter writer;
  writer.add(std::uint64_t{results.size()});
  for (const auto& [key, result] : results) {
    writer.add(std::string_view(key));
    writer.add(result);
  }
  return writer.take();
}

/// What bytes_of() wrote. Throws std::out_of_range if bytes are missing, std::logic_error if some
/// are left or a key is there twice.
template <class Result>
CellResults<Result> results_of(std::string_view bytes) {
  ByteReader reader(bytes);
  CellResults<Result> results;
  for (std::uint64_t left = reader.number(); left > 0; --left) {
    std::string key = reader.text();
    const auto [at, is_new] = results.emplace(std::move(key), Result::read(reader));
    if (!is_new) throw std::logic_error("the cell of work " + at->first + " is there twice");
  }
  if (!reader.is_at_end()) throw std::logic_error("bytes are left behind the last cell of work");
  return results;
}

}  // namespace lightproof
