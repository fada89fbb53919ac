#include "lightproof/accuracy/lit_receiver.h"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <span>
#include <utility>

#include "lightproof/accuracy/exact_light.h"
#include "lightproof/core/error.h"
#include "lightproof/core/parallel.h"
#include "lightproof/estimators/registry.h"
#include "reference/combined_moments.h"

namespace lightproof {
namespace {

using reference::MeanAndVariance;

/// The moments at one point, by estimator.
using MomentsAtPoint = std::map<std::string_view, MeanAndVariance>;

void add_densities(std::span<const EstimatorInfo* const> asked,
                   const reference::LightMoments& light, MomentsAtPoint& moments) {
  for (const EstimatorInfo* info : asked) {
    if (!info->density) continue;
    const reference::EstimatorMoments& of = light[*info->density];
    moments[info->name] = {of.mean(), of.variance(), of.largest, of.fourth_central()};
  }
}

/// Densities of directions, per steradian, by estimator.
struct Densities {
  std::vector<std::string_view> names;
  std::vector<reference::DensityAtNode> pdfs;

  void add(std::string_view name, reference::DensityAtNode pdf) {
    names.push_back(name);
    pdfs.push_back(std::move(pdf));
  }
};

/// Those that depend on the map and not on the point.
Densities map_densities(std::span<const EstimatorInfo* const> asked, const EnvironmentMap& map) {
  Densities densities;
  for (const EstimatorInfo* info : asked) {
    if (info->map_pdf == nullptr) continue;
    densities.add(info->name, [pdf = info->map_pdf(map)](const reference::Node& node) {
      return pdf(node.at).value;
    });
  }
  return densities;
}

/// All of them at a point.
Densities densities_at(std::span<const EstimatorInfo* const> asked, const Densities& of_map,
                       const Material& material, const ShadingPoint& at) {
  Densities densities = of_map;
  for (const EstimatorInfo* info : asked) {
    if (info->pdf == nullptr || !info->serves(material)) continue;
    densities.add(info->name, [pdf = info->pdf, &material, &at](const reference::Node& node) {
      return pdf(material, at, node.direction);
    });
  }
  return densities;
}

/// The combinations of two densities that estimators make.
struct Combinations {
  std::vector<std::string_view> names;
  std::vector<reference::CombinedSampling> samplings;
};

Combinations combinations_of(std::span<const EstimatorInfo* const> asked) {
  Combinations combinations;
  for (const EstimatorInfo* info : asked) {
    if (!info->combined) continue;
    combinations.names.push_back(info->name);
    combinations.samplings.push_back(*info->combined);
  }
  return combinations;
}

/// Adds the moments of combinations and of all other densities, in one pass over the sphere.
void add_others(const Combinations& combinations, const Densities& densities,
                const reference::Kernel& kernel, const Grid<double>& luminance,
                MomentsAtPoint& moments) {
  if (combinations.names.empty() && densities.names.empty()) return;
  const auto found = reference::sampling_moments(kernel, {&luminance, 1}, combinations.samplings,
                                                 densities.pdfs, reference::CellRule::midpoint);
  for (std::size_t i = 0; i < combinations.names.size(); ++i) {
    moments[combinations.names[i]] = found.combined[i][0];
  }
  for (std::size_t i = 0; i < densities.names.size(); ++i) {
    moments[densities.names[i]] = found.densities[i][0];
  }
}

/// Estimators that are asked for.
std::vector<const EstimatorInfo*> asked_for(const EstimatorFilter& filter) {
  std::vector<const EstimatorInfo*> asked;
  for (const EstimatorInfo& info : estimators()) {
    if (!filter || filter(info)) asked.push_back(&info);
  }
  return asked;
}

}  // namespace

std::vector<Pixel> receiver_points(const ReceiverInfo& receiver, const Scene& scene, int least) {
  std::vector<Pixel> pixels;
  const bool is_point = !receiver.content.sphere && !receiver.content.plane;
  for (int scale = 1; pixels.size() < static_cast<std::size_t>(is_point ? 1 : least); ++scale) {
    pixels = visible_pixels(receiver, scene, {4 * scale, 3 * scale});
  }
  return pixels;
}

LitReceiver::LitReceiver(const EnvironmentMap& map, const ReceiverInfo& receiver,
                         NamedMaterial material, int points, const EstimatorFilter& filter)
    : map_(&map),
      receiver_(&receiver),
      material_(std::move(material)),
      scene_(receiver.content),
      pixels_(receiver_points(receiver, scene_, points)) {
  const Grid<double> luminance = luminance_of(map);
  const auto light = exact_light({&luminance, 1}, receiver, scene_, material_.material, pixels_)[0];
  const auto count = static_cast<double>(pixels_.size());
  for (const reference::LightMoments& at_point : light) {
    exact_.push_back(at_point[reference::SampledDensity::uniform].mean());
    mean_ += exact_.back() / count;
  }
  if (!(mean_ > 0.0)) {
    throw InputError(
        fmt::format("{}: no light of this map reaches the receiver '{}'", map.name, receiver.name));
  }
  const std::vector<const EstimatorInfo*> asked = asked_for(filter);
  const Densities of_map = asked.empty() ? Densities() : map_densities(asked, map);
  const Combinations combinations = combinations_of(asked);
  std::vector<MomentsAtPoint> moments(pixels_.size());
  parallel_for(pixels_.size(), [&](std::size_t i) {
    const ShadingPoint& at = pixels_[i].point;
    const auto kernel = kernel_at(receiver, scene_, material_.material, at);
    add_densities(asked, light[i], moments[i]);
    add_others(combinations, densities_at(asked, of_map, material_.material, at), kernel, luminance,
               moments[i]);
  });
  for (const MomentsAtPoint& at_point : moments) {
    for (const auto& [name, exact] : at_point) {
      Spread& spread = spreads_[name];
      spread.variance += exact.variance / count / (mean_ * mean_);
      spread.fourth_central += exact.fourth_central / count / std::pow(mean_, 4);
    }
  }
}

std::optional<Spread> LitReceiver::spread(const EstimatorInfo& info) const {
  const auto found = spreads_.find(info.name);
  if (found == spreads_.end()) return std::nullopt;
  return found->second;
}

}  // namespace lightproof
