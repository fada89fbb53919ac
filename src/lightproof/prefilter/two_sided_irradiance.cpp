#include "lightproof/prefilter/two_sided_irradiance.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <optional>
#include <utility>

#include "lightproof/core/parallel.h"
#include "lightproof/image/lat_long_texels.h"

namespace lightproof {
namespace {

/// Chunks of rows have sums of their own. So many that few threads share them evenly.
constexpr int kChunks = 16;

/// What the rows of one chunk add to all combs.
struct ChunkSums {
  std::vector<PaddedRgb> crossed;  ///< from rows that the horizon crosses, comb by comb
  std::vector<LightVector> rows;   ///< of each row, of the folded map
  LightVector lower;               ///< of the map itself, from below
};

/// A column as one in [0, columns), and how often the seam was passed on the way.
struct Wrapped {
  int column;
  int turns;
};
Wrapped wrap(int column, int columns) {
  const int turns = column >= 0 ? column / columns : -((columns - 1 - column) / columns);
  return {column - turns * columns, turns};
}

/// Adds up one comb's light.
class CombIntegrator {
 public:
  CombIntegrator(const NormalComb& comb, const FoldedLattice& lattice)
      : view_(comb, lattice), columns_(lattice.columns), stride_(lattice.columns / comb.teeth) {
    for (int tooth = 0; tooth < comb.teeth; ++tooth) {
      const double longitude = comb.first + 2.0 * kPi * tooth / comb.teeth;
      cosine_.push_back(comb.tilt.sine * std::cos(longitude));
      sine_.push_back(comb.tilt.sine * std::sin(longitude));
    }
  }

  const NormalCombView& view() const { return view_; }

  /// n·vector, of one of the comb's normals.
  PaddedRgb along(const LightVector& vector, std::size_t tooth) const {
    return cosine_[tooth] * vector.cosine + sine_[tooth] * vector.sine +
           view_.comb().tilt.cosine * vector.height;
  }

  /// Adds ∫ L (n·w)+ d(omega) over row `k`, if the horizon crosses it. `weights` is for the work.
  void add_row(const FoldedRow& row, int k, std::vector<double>& weights,
               std::span<PaddedRgb> sums) const {
    if (k < view_.rows_seen()) return;
    const CosineBand band = view_.band(k);
    const RowView seen = view_.view(band);
    for (const ColumnRun run : {seen.leaving, seen.returning}) {
      weights.clear();
      for (int column = run.begin; column < run.end; ++column) {
        weights.push_back(view_.weight(band, column));
      }
      add_crossed(row, run.begin, weights, sums);
    }
    add_seen(row, seen.seen, sums);
  }

 private:
  void add_crossed(const FoldedRow& row, int begin, std::span<const double> weights,
                   std::span<PaddedRgb> sums) const {
    const PaddedRgb* const light = row.light().data();
    int column = wrap(begin, columns_).column;
    for (PaddedRgb& sum : sums) {
      PaddedRgb crossed(0.0);
      for (std::size_t i = 0; i < weights.size(); ++i) {
        crossed += weights[i] * light[static_cast<std::size_t>(column) + i];
      }
      sum += crossed;
      column += stride_;
      if (column >= columns_) column -= columns_;
    }
  }

  void add_seen(const FoldedRow& row, ColumnRun run, std::span<PaddedRgb> sums) const {
    const LightVector* const before = row.before().data();
    const double height = row.height_factor() * view_.comb().tilt.cosine;
    auto [begin, begin_turns] = wrap(run.begin, columns_);
    auto [end, end_turns] = wrap(run.end, columns_);
    int turns = end_turns - begin_turns;
    for (std::size_t tooth = 0; tooth < sums.size(); ++tooth) {
      const double cosine = row.level_factor() * cosine_[tooth];
      const double sine = row.level_factor() * sine_[tooth];
      const LightVector& to = before[end];
      const LightVector& from = before[begin];
      sums[tooth] += cosine * (to.cosine - from.cosine) + sine * (to.sine - from.sine) +
                     height * (to.height - from.height);
      if (turns > 0) {
        const LightVector& whole = row.before().back();
        sums[tooth] += cosine * whole.cosine + sine * whole.sine + height * whole.height;
      }
      begin += stride_;
      end += stride_;
      if (begin >= columns_) begin -= columns_, --turns;
      if (end >= columns_) end -= columns_, ++turns;
    }
  }

  NormalCombView view_;
  int columns_;
  int stride_;
  std::vector<double> cosine_;
  std::vector<double> sine_;
};

std::vector<CombIntegrator> integrators_of(std::span<const NormalComb> combs,
                                           const FoldedLattice& lattice) {
  std::vector<std::optional<CombIntegrator>> made(combs.size());
  parallel_for(combs.size(), [&](std::size_t i) { made[i].emplace(combs[i], lattice); });
  std::vector<CombIntegrator> integrators;
  for (auto& integrator : made) integrators.push_back(std::move(*integrator));
  return integrators;
}

ChunkSums sums_of_rows(const EnvironmentMap& source, const FoldedLattice& lattice,
                       std::span<const CombIntegrator> integrators, std::size_t first,
                       std::size_t last) {
  const auto teeth = static_cast<std::size_t>(integrators[0].view().comb().teeth);
  ChunkSums sums{std::vector<PaddedRgb>(integrators.size() * teeth, PaddedRgb(0.0)), {}, {}};
  FoldedRow row(lattice);
  std::vector<double> weights;
  for (std::size_t k = first; k < last; ++k) {
    throw_if_interrupted();  // a chunk of a large map takes seconds
    row.fold(source, static_cast<int>(k));
    sums.rows.push_back(row.folded());
    sums.lower += row.lower();
    for (std::size_t i = 0; i < integrators.size(); ++i) {
      const auto comb = std::span(sums.crossed).subspan(i * teeth, teeth);
      integrators[i].add_row(row, static_cast<int>(k), weights, comb);
    }
  }
  return sums;
}

/// The sums of all chunks, added in their order.
ChunkSums sums_of_all(const EnvironmentMap& source, const FoldedLattice& lattice,
                      std::span<const CombIntegrator> integrators) {
  const auto rows = static_cast<std::size_t>(lattice.rows());
  const std::size_t size = chunks_of(rows, kChunks);
  std::vector<ChunkSums> chunks(chunks_of(rows, size));
  parallel_chunks(rows, size, [&](std::size_t chunk, std::size_t first, std::size_t last) {
    chunks[chunk] = sums_of_rows(source, lattice, integrators, first, last);
  });
  ChunkSums all = std::move(chunks[0]);
  for (std::size_t i = 1; i < chunks.size(); ++i) {
    std::ranges::transform(all.crossed, chunks[i].crossed, all.crossed.begin(), std::plus());
    all.rows.insert(all.rows.end(), chunks[i].rows.begin(), chunks[i].rows.end());
    all.lower += chunks[i].lower;
  }
  return all;
}

/// The vector ∫ L w d(omega) of the map, and that of the folded map above each of its rows.
struct LightVectors {
  explicit LightVectors(const ChunkSums& sums) : above(sums.rows.size() + 1), whole(sums.lower) {
    for (std::size_t k = 0; k < sums.rows.size(); ++k) {
      above[k + 1] = above[k];
      above[k + 1] += sums.rows[k];
    }
    whole += sums.lower;
    whole += above.back();
  }

  std::vector<LightVector> above;
  LightVector whole;  ///< folding has turned the lower part around, so it counts twice
};

/// Combs that are worked on together.
std::vector<TwoSidedIrradiance> irradiance_of_batch(const EnvironmentMap& source,
                                                    const FoldedLattice& lattice,
                                                    std::span<const NormalComb> combs) {
  const std::vector<CombIntegrator> integrators = integrators_of(combs, lattice);
  const ChunkSums sums = sums_of_all(source, lattice, integrators);
  const LightVectors vectors(sums);
  std::vector<TwoSidedIrradiance> result;
  for (const CombIntegrator& integrator : integrators) {
    LightVector seen = vectors.above[static_cast<std::size_t>(integrator.view().rows_seen())];
    seen += sums.lower;
    for (std::size_t tooth = 0; tooth < static_cast<std::size_t>(combs[0].teeth); ++tooth) {
      const PaddedRgb upper = sums.crossed[result.size()] + integrator.along(seen, tooth);
      const PaddedRgb lower = upper - integrator.along(vectors.whole, tooth);
      result.push_back({glm::max(glm::dvec3(upper), 0.0), glm::max(glm::dvec3(lower), 0.0)});
    }
  }
  return result;
}

/// As many combs at a time as keep tables and sums below this.
constexpr std::size_t kBytesOfBatch = std::size_t{1} << 26U;

std::size_t batch_size(const FoldedLattice& lattice, int teeth) {
  const std::size_t tables = static_cast<std::size_t>(lattice.columns) / 2 * sizeof(Meridian) +
                             lattice.parallels.size() * sizeof(Parallel);
  const std::size_t sums = (kChunks + 1) * static_cast<std::size_t>(teeth) * sizeof(PaddedRgb);
  return std::max<std::size_t>(1, kBytesOfBatch / (tables + sums));
}

}  // namespace

std::vector<TwoSidedIrradiance> two_sided_irradiance(const EnvironmentMap& source,
                                                     const FoldedLattice& lattice,
                                                     std::span<const NormalComb> combs) {
  require_lat_long(source, "irradiance");
  std::vector<TwoSidedIrradiance> result;
  if (combs.empty()) return result;
  const std::size_t size = batch_size(lattice, combs[0].teeth);
  for (std::size_t first = 0; first < combs.size(); first += size) {
    const auto part = combs.subspan(first, std::min(size, combs.size() - first));
    const auto batch = irradiance_of_batch(source, lattice, part);
    result.insert(result.end(), batch.begin(), batch.end());
  }
  return result;
}

}  // namespace lightproof
