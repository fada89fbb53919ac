#include "lightproof/gate/detectable_effect.h"

#include "lightproof/stats/goodness_of_fit.h"
#include "lightproof/stats/uniformity.h"

namespace lightproof {
namespace {

/// The arguments of minimum_detectable(), for each kind of effect.
struct LeastEffect {
  double level;
  double power;
  double samples;

  double operator()(const EffectOnCells& effect) const {
    return minimum_detectable_w(effect.dof, level, power, samples * effect.share);
  }
  double operator()(const KuiperDistance& /*effect*/) const {
    return minimum_detectable_kuiper_distance(level, power, samples);
  }
  double operator()(const AndersonDarlingDistance& /*effect*/) const {
    return minimum_detectable_anderson_darling_distance(level, power, samples);
  }
  double operator()(const ExcessOfWorstCell& effect) const {
    const WorstCell cell = {.cells = effect.cells, .likeliest = effect.likeliest};
    return minimum_detectable_excess(cell, level, power, samples);
  }
  double operator()(const ErrorOfMean& effect) const {
    return minimum_detectable_factor(level, power, samples, effect.moments, effect.exact) - 1.0;
  }
};

}  // namespace

double minimum_detectable(const DetectableEffect& effect, double level, double power,
                          double samples) {
  return std::visit(LeastEffect{level, power, samples}, effect);
}

}  // namespace lightproof
