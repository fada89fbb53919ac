#include "lightproof/prefilter/lobe_quadrature.h"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>

namespace lightproof {
namespace {

/// The angle to the horizon over which the lobe changes there.
double horizon_scale(const Lobe& lobe) {
  const auto* ggx = std::get_if<GgxLobe>(&lobe);
  return ggx != nullptr && ggx->weight == GgxWeight::masking ? ggx->alpha : 1.0;
}

using Gauss = boost::math::quadrature::gauss<double, 20>;

void add_panel(LobeNodes& nodes, const Lobe& lobe, double from, double to) {
  const double middle = 0.5 * (from + to);
  const double half = 0.5 * (to - from);
  const auto add = [&](double angle, double weight) {
    const double cosine = std::cos(angle);
    nodes.angles.push_back(angle);
    nodes.cosines.push_back(cosine);
    nodes.weights.push_back(2.0 * kPi * std::sin(angle) * half * weight *
                            relative_density(lobe, cosine));
  };
  for (std::size_t i = 0; i < Gauss::abscissa().size(); ++i) {
    add(middle - half * Gauss::abscissa()[i], Gauss::weights()[i]);
    add(middle + half * Gauss::abscissa()[i], Gauss::weights()[i]);
  }
}

}  // namespace

/// Panels of 20 Gauss-Legendre nodes in the angle to the axis. A panel is no wider than its
/// distance to where the lobe's analytic continuation ends, which lies beside the axis and, for
/// masking, beside the horizon; and spans no more than two waves of P_degree, which 20 nodes
/// integrate to rounding. The kink of the Cook-Torrance term, at 60 degrees, is an edge.
LobeNodes lobe_nodes(const Lobe& lobe, int degree) {
  constexpr double kWaves = 12.0;  // radians of phase
  const double horizon = 0.5 * kPi;
  const double peak = width(lobe).value;
  const double rim = horizon_scale(lobe);
  LobeNodes nodes;
  double from = 0.0;
  for (const double edge : {kPi / 3.0, horizon}) {
    while (from < edge) {
      const double smooth = std::min(std::max(peak, from), std::max(rim, horizon - from) * 0.5);
      const double step = std::min(smooth, kWaves / (degree + 1.0));
      const double to = edge - from < 1.5 * step ? edge : from + step;
      add_panel(nodes, lobe, from, to);
      from = to;
    }
  }
  return nodes;
}

}  // namespace lightproof
