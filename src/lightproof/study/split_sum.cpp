#include "lightproof/study/split_sum.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "lightproof/core/measure.h"
#include "lightproof/shading/split_sum_error.h"

namespace lightproof {
namespace {

std::vector<double> angles_of(const SplitSumOptions& options) {
  if (!options.view_angles.empty()) return options.view_angles;
  std::vector<double> angles;
  for (int degrees = 0; degrees <= 80; degrees += 10) angles.push_back(degrees * kPi / 180.0);
  return angles;
}

std::string kernel_key(double roughness, double angle) {
  return fmt::format("split-sum/kernel/{}/{}", roughness, angle);
}

std::string map_key(const EnvironmentMap& map) { return "split-sum/map/" + map.name; }

using Kernels = std::vector<SplitSumKernel>;

/// A cell of work for every surface and view, whatever the map.
CellResults<Kernels> kernels_of(const SplitSumOptions& options, std::span<const double> angles,
                                const Progress& progress, const Communicator& communicator) {
  std::vector<WorkCell<Kernels>> cells;
  for (const double roughness : options.roughness) {
    for (const double angle : angles) {
      cells.push_back({kernel_key(roughness, angle), [&options, roughness, angle] {
                         return split_sum_kernels(roughness, std::cos(angle),
                                                  options.normal_reflectances);
                       }});
    }
  }
  return gather(
      compute_cells<Kernels>(cells, communicator.share, progress, "split sum", communicator.kept),
      communicator);
}

/// A cell of work for every map.
CellResults<AngularPower> powers_of(std::span<const EnvironmentMap> maps, const Progress& progress,
                                    const Communicator& communicator) {
  std::vector<WorkCell<AngularPower>> cells;
  for (const EnvironmentMap& map : maps) {
    cells.push_back({map_key(map), [&map] { return luminance_power(map); }});
  }
  return gather(compute_cells<AngularPower>(cells, communicator.share, progress, "split sum",
                                            communicator.kept),
                communicator);
}

/// Every combination, in the order of the records; what is computed is left at 0.
std::vector<SplitSumRecord> cases_of(const std::string& map, double normal_reflectance,
                                     std::span<const double> roughnesses,
                                     std::span<const double> angles) {
  std::vector<SplitSumRecord> cases;
  for (const double roughness : roughnesses) {
    for (const double angle : angles) {
      cases.push_back({map, roughness, angle, normal_reflectance, 0.0, 0.0});
    }
  }
  return cases;
}

}  // namespace

std::vector<SplitSumRecord> study_split_sum(std::span<const EnvironmentMap> maps,
                                            const SplitSumOptions& options,
                                            const Progress& progress,
                                            const Communicator& communicator) {
  if (maps.empty()) return {};
  const std::vector<double> angles = angles_of(options);
  const auto powers = powers_of(maps, part_of(progress, 0.0, 0.3), communicator);
  const auto kernels = kernels_of(options, angles, part_of(progress, 0.3, 1.0), communicator);
  std::vector<SplitSumRecord> records;
  for (const EnvironmentMap& map : maps) {
    const AngularPower& power = powers.at(map_key(map));
    for (std::size_t i = 0; i < options.normal_reflectances.size(); ++i) {
      for (SplitSumRecord record :
           cases_of(map.name, options.normal_reflectances[i], options.roughness, angles)) {
        const std::string key = kernel_key(record.roughness, record.view_angle);
        const SplitSumError error = split_sum_error(kernels.at(key)[i], power);
        record.rmse = error.rmse;
        record.left_out = error.left_out;
        records.push_back(std::move(record));
      }
    }
  }
  return records;
}

}  // namespace lightproof
