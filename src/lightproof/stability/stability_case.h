// Hard inputs as rows of a table, each with what it does to every kind of method.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "lightproof/results/stability_result.h"
#include "lightproof/stability/method.h"

namespace lightproof {

/// What came out of one method.
struct Finding {
  StabilityOutcome outcome = StabilityOutcome::right;
  double amount = 0.0;  ///< how far off; 0 where nothing is measured
  double bound = 0.0;   ///< how far off it may be
  std::string put_in = {};
  std::string came_out = {};
};

/// How inputs are made.
struct TrialOptions {
  std::uint64_t seed = 1;  ///< of what is drawn at random: points, texels
  bool thorough = false;   ///< whether inputs may be so large that each takes seconds
};

/// Puts an input into a method. What it throws as InputError is a refusal.
template <class Method>
using MethodTrial = Finding (*)(const Method& method, const TrialOptions& options);

/// A method that cannot pass by its nature, and why.
struct StabilityLimit {
  std::string_view method;  ///< its name; of a sampler of maps without the density
  std::string_view reason;
};

/// A hard input. It applies to the kinds of methods that it has a trial for.
struct StabilityCase {
  int number;
  std::string_view name;
  std::string_view input;
  std::string_view required;
  std::string_view source;
  bool may_refuse = false;  ///< whether an error that says why is what is required
  std::span<const StabilityLimit> limits = {};
  MethodTrial<SamplerUnderTest> sampler = nullptr;
  MethodTrial<DirectionSamplerInfo> warp = nullptr;
  MethodTrial<LobeMethod> lobe = nullptr;
  MethodTrial<FrameMethod> frame = nullptr;
  MethodTrial<PrefilterMethodInfo> prefilter = nullptr;
  MethodTrial<ReflectivityMethod> reflectivity = nullptr;
  MethodTrial<BrdfTableMethod> brdf_table = nullptr;
  MethodTrial<MeanMethod> mean = nullptr;
  MethodTrial<EstimatorInfo> estimator = nullptr;
  MethodTrial<PointSetInfo> point_set = nullptr;
  MethodTrial<MapFormatInfo> format = nullptr;
};

/// All cases, by their numbers.
std::span<const StabilityCase> stability_cases();

/// Calls visit(kind, methods, trial of a case for them) for every kind of method, in the order in
/// which they are shown; `trial` is a pointer to the member.
template <class Visit>
void for_kinds(const StabilityMethods& methods, const Visit& visit) {
  visit("sampler", methods.samplers, &StabilityCase::sampler);
  visit("warp", methods.warps, &StabilityCase::warp);
  visit("lobe", methods.lobes, &StabilityCase::lobe);
  visit("frame", methods.frames, &StabilityCase::frame);
  visit("prefilter", methods.prefilters, &StabilityCase::prefilter);
  visit("reflectivity", methods.reflectivities, &StabilityCase::reflectivity);
  visit("BRDF table", methods.brdf_tables, &StabilityCase::brdf_table);
  visit("mean", methods.means, &StabilityCase::mean);
  visit("estimator", methods.estimators, &StabilityCase::estimator);
  visit("point set", methods.point_sets, &StabilityCase::point_set);
  visit("format", methods.formats, &StabilityCase::format);
}

}  // namespace lightproof
