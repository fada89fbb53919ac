// A receiver in the light of a map: the points at which light is gathered, and the exact light
// there.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lightproof/estimators/estimator.h"
#include "lightproof/image/environment_map.h"
#include "lightproof/materials/material.h"
#include "lightproof/render/receiver.h"

namespace lightproof {

/// A material and what it is called: "lambert", "phong:50", "ggx:0.3".
struct NamedMaterial {
  std::string name;
  Material material;
};

/// How far the estimates of an estimator are off, averaged over all points of a receiver.
struct Spread {
  double variance = 0.0;  ///< of one sample, over the square of the mean light
  /// The fourth central moment of an independent estimate, over the mean light's fourth power.
  double fourth_central = 0.0;
};

/// Points of a receiver that stand for all of it, at the least. Errors over half as many differ by
/// tens of percent where a sun or a lobe is small.
inline constexpr int kReceiverPoints = 48;

/// The points of a receiver: the visible pixels of the smallest picture, 4 by 3, that shows `least`
/// of them or more; the point receiver has its one.
std::vector<Pixel> receiver_points(const ReceiverInfo& receiver, const Scene& scene, int least);

/// Whether an estimator is asked for.
using EstimatorFilter = std::function<bool(const EstimatorInfo&)>;

/// The visible points of a receiver, of one material, and by quadrature the luminance that each
/// reflects, with the variances of all estimators whose moments are known. Refers to the map, which
/// must outlive it.
class LitReceiver {
 public:
  /// The points are receiver_points(). Variances are computed of the estimators that the filter
  /// asks for, of all if it is empty. Throws InputError if no light reaches any point.
  LitReceiver(const EnvironmentMap& map, const ReceiverInfo& receiver, NamedMaterial material,
              int points, const EstimatorFilter& filter = {});

  const EnvironmentMap& map() const { return *map_; }
  const ReceiverInfo& receiver() const { return *receiver_; }
  const NamedMaterial& material() const { return material_; }
  const Scene& scene() const { return scene_; }
  const std::vector<Pixel>& pixels() const { return pixels_; }
  /// The exact luminance that a point reflects.
  double exact(std::size_t pixel) const { return exact_[pixel]; }
  /// The mean of exact() over the points.
  double mean() const { return mean_; }
  /// What is exact of an estimator's single estimates, over the receiver; none if nothing is.
  std::optional<Spread> spread(const EstimatorInfo& info) const;

 private:
  const EnvironmentMap* map_;
  const ReceiverInfo* receiver_;
  NamedMaterial material_;
  Scene scene_;
  std::vector<Pixel> pixels_;
  std::vector<double> exact_;                   ///< a point each
  std::map<std::string_view, Spread> spreads_;  ///< by estimator
  double mean_ = 0.0;
};

}  // namespace lightproof
