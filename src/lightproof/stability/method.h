// What is held against hard inputs: the rows of every registry of methods, by kind.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "lightproof/estimators/estimator.h"
#include "lightproof/gate/direction_sampler.h"
#include "lightproof/gate/sampler_under_test.h"
#include "lightproof/image/map_format.h"
#include "lightproof/points/registry.h"
#include "lightproof/prefilter/brdf_map.h"
#include "lightproof/prefilter/prefilter.h"
#include "lightproof/prefilter/reflectivity.h"
#include "lightproof/warp/frame_errors.h"

namespace lightproof {

/// A way to draw directions from what a surface reflects, at any roughness in (0, 1].
struct LobeMethod {
  std::string name;
  std::function<Material(double roughness)> of_roughness;
  /// What the command line takes for it, before a number; empty if it takes none.
  std::string parameter = {};
};

/// A construction of frames in one precision.
struct FrameMethod {
  std::string name;
  bool known_defects = false;
  double rounding =
      0.0;  ///< the least error that the precision allows for, a unit in the last place
  /// Largest error of a frame around a unit vector, see orthonormality_error().
  std::function<double(Direction normal)> error;
};

/// A map that is prefiltered by half-vectors frame by frame: project 004, as published and mended.
struct ReflectivityMethod {
  std::string name;
  bool known_defects = false;
  ReflectivityForm form;
};

/// A mean of samples that arrive one by one.
struct MeanMethod {
  std::string name;
  bool known_defects = false;
  /// The mean of `count` samples, of which every thousandth is 1000 and all others are 0.
  std::function<double(std::uint64_t count)> mean_of_spikes;
};

/// A way to compute the table of what microfacets reflect.
struct BrdfTableMethod {
  std::string name;
  bool known_defects = false;
  std::function<ScaleBias(double cosine, double roughness)> at;
};

/// Everything that is held against hard inputs, by kind.
struct StabilityMethods {
  std::vector<SamplerUnderTest> samplers = {};   ///< of maps, under all densities
  std::vector<DirectionSamplerInfo> warps = {};  ///< of the hemisphere
  std::vector<LobeMethod> lobes = {};
  std::vector<FrameMethod> frames = {};
  std::vector<PrefilterMethodInfo> prefilters = {};
  std::vector<ReflectivityMethod> reflectivities = {};
  std::vector<BrdfTableMethod> brdf_tables = {};
  std::vector<MeanMethod> means = {};
  std::vector<EstimatorInfo> estimators = {};
  std::vector<PointSetInfo> point_sets = {};
  std::vector<MapFormatInfo> formats = {};
};

/// All of them; published samplers as they are listed, without checks of the map.
StabilityMethods all_stability_methods();

/// "alias/B", which no other sampler of maps is called.
std::string method_name(const SamplerUnderTest& sampler);
template <class Method>
std::string method_name(const Method& method) {
  return std::string(method.name);
}

/// Whether a method, by its full name, goes by this name: with or without the density.
bool is_method(std::string_view method, std::string_view name);
/// Whether it goes by one of these names, or there are none.
bool is_asked_for(std::string_view method, const std::vector<std::string>& names);

/// Whether a method is kept as published, to show what is wrong with it.
template <class Method>
bool has_known_defects(const Method& method) {
  if constexpr (requires { method.known_defects; }) {
    return method.known_defects;
  } else if constexpr (requires { method.defect; }) {
    return !method.defect.empty();
  } else {
    return false;
  }
}

}  // namespace lightproof
