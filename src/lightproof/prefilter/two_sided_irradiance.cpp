#include "lightproof/prefilter/two_sided_irradiance.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <optional>
#include <utility>

#include "lightproof/core/parallel.h"

namespace lightproof {
namespace {

/// Chunks of rows have sums of their own. So many that few threads share them evenly.
constexpr int kChunks = 16;

/// What the rows of one chunk add to all combs.
struct ChunkSums {
  std::vector<double> horizon;    ///< rows that the horizon crosses: combs x teeth x rgb
  std::vector<LightVector> rows;  ///< of each row, of the folded map
  LightVector lower;              ///< of the map itself, from below
};

void add_scaled(double weight, std::span<const double> values, std::span<double> sums) {
  for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += weight * values[i];
}

/// A column as one in [0, columns), and how often the seam was passed on the way.
struct Wrapped {
  int column;
  int turns;
};
Wrapped wrap(int column, int columns) {
  const int turns = column >= 0 ? column / columns : -((columns - 1 - column) / columns);
  return {column - turns * columns, turns};
}

/// The components of the comb's normals, for red, green and blue of each tooth.
struct NormalComponents {
  std::vector<double> cosine;
  std::vector<double> sine;
  double height;

  explicit NormalComponents(const NormalComb& comb) : height(comb.tilt.cosine) {
    for (int tooth = 0; tooth < comb.teeth; ++tooth) {
      const double longitude = comb.first + 2.0 * kPi * tooth / comb.teeth;
      cosine.insert(cosine.end(), 3, comb.tilt.sine * std::cos(longitude));
      sine.insert(sine.end(), 3, comb.tilt.sine * std::sin(longitude));
    }
  }
};

class CombIntegrator {
 public:
  CombIntegrator(const NormalComb& comb, const FoldedLattice& lattice)
      : view_(comb, lattice), components_(comb), columns_(lattice.columns) {}

  const NormalCombView& view() const { return view_; }

  /// What row `k` adds to (n·w)+ of the folded map, if the horizon crosses it.
  void add_row(const FoldedRow& row, int k, std::span<double> sums) const {
    if (k < view_.rows_seen()) return;
    const CosineBand band = view_.band(k);
    const RowView seen = view_.view(band);
    add_crossed(row, band, seen.leaving, sums);
    add_crossed(row, band, seen.returning, sums);
    add_seen(row, seen.seen, sums);
  }

  /// The normal's product with a light vector.
  glm::dvec3 along(const LightVector& vector, int tooth) const {
    const auto at = 3 * static_cast<std::size_t>(tooth);
    return components_.cosine[at] * vector.cosine + components_.sine[at] * vector.sine +
           components_.height * vector.height;
  }

 private:
  void add_crossed(const FoldedRow& row, const CosineBand& band, ColumnRun run,
                   std::span<double> sums) const {
    for (int column = run.begin; column < run.end; ++column) {
      add_scaled(view_.weight(band, column), row.light(wrap(column, columns_).column), sums);
    }
  }

  void add_seen(const FoldedRow& row, ColumnRun run, std::span<double> sums) const {
    const auto [begin, begin_turns] = wrap(run.begin, columns_);
    const auto [end, end_turns] = wrap(run.end, columns_);
    const double* const cosine[] = {row.cosine_before(begin).data(), row.cosine_before(end).data()};
    const double* const sine[] = {row.sine_before(begin).data(), row.sine_before(end).data()};
    const double* const height[] = {row.height_before(begin).data(), row.height_before(end).data()};
    for (std::size_t i = 0; i < sums.size(); ++i) {
      sums[i] += components_.cosine[i] * (cosine[1][i] - cosine[0][i]) +
                 components_.sine[i] * (sine[1][i] - sine[0][i]) +
                 components_.height * (height[1][i] - height[0][i]);
    }
    if (end_turns != begin_turns) add_whole_row(row, end_turns - begin_turns, sums);
  }

  void add_whole_row(const FoldedRow& row, int times, std::span<double> sums) const {
    for (int tooth = 0; tooth < view_.comb().teeth; ++tooth) {
      const glm::dvec3 whole = static_cast<double>(times) * along(row.folded_sum(), tooth);
      for (int channel = 0; channel < 3; ++channel) {
        sums[3 * static_cast<std::size_t>(tooth) + static_cast<std::size_t>(channel)] +=
            whole[channel];
      }
    }
  }

  NormalCombView view_;
  NormalComponents components_;
  int columns_;
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
  const std::size_t comb = 3 * static_cast<std::size_t>(integrators[0].view().comb().teeth);
  ChunkSums sums{std::vector<double>(integrators.size() * comb), {}, {}};
  FoldedRow row(lattice, integrators[0].view().comb().teeth);
  for (std::size_t k = first; k < last; ++k) {
    row.fold(source, static_cast<int>(k));
    sums.rows.push_back(row.folded_sum());
    sums.lower += row.lower_sum();
    for (std::size_t i = 0; i < integrators.size(); ++i) {
      integrators[i].add_row(row, static_cast<int>(k),
                             std::span(sums.horizon).subspan(i * comb, comb));
    }
  }
  return sums;
}

/// Of all chunks, in their order.
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
    add_scaled(1.0, chunks[i].horizon, all.horizon);
    all.rows.insert(all.rows.end(), chunks[i].rows.begin(), chunks[i].rows.end());
    all.lower += chunks[i].lower;
  }
  return all;
}

/// The components along the light of a comb's integrals: V of the map and of what lies above each
/// row of the folded one.
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
    for (int tooth = 0; tooth < combs[0].teeth; ++tooth) {
      const double* horizon = sums.horizon.data() + 3 * result.size();
      const glm::dvec3 upper =
          glm::dvec3(horizon[0], horizon[1], horizon[2]) + integrator.along(seen, tooth);
      const glm::dvec3 lower = upper - integrator.along(vectors.whole, tooth);
      result.push_back({glm::max(upper, 0.0), glm::max(lower, 0.0)});
    }
  }
  return result;
}

/// As many combs at a time as keep tables and sums below this.
constexpr std::size_t kBytesOfBatch = std::size_t{1} << 26U;

std::size_t batch_size(const FoldedLattice& lattice, int teeth) {
  const std::size_t tables = static_cast<std::size_t>(lattice.columns) / 2 * sizeof(Meridian) +
                             lattice.parallels.size() * sizeof(Parallel);
  const std::size_t sums = (kChunks + 1) * 3 * static_cast<std::size_t>(teeth) * sizeof(double);
  return std::max<std::size_t>(1, kBytesOfBatch / (tables + sums));
}

}  // namespace

std::vector<TwoSidedIrradiance> two_sided_irradiance(const EnvironmentMap& source,
                                                     const FoldedLattice& lattice,
                                                     std::span<const NormalComb> combs) {
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
