// Gauss-Legendre rules of few nodes, whose nodes and weights are Boost's. Boost's own integrate()
// asks for its tables and looks for infinite ends at every integral, which takes as long as half a
// sine; here both stand in an array, for integrals over every texel and up to every sample.
#pragma once

#include <array>
#include <cstddef>

namespace lightproof {

/// A node of a Gauss-Legendre rule over [0,1].
struct GaussNode {
  double at;      ///< position in (0,1)
  double weight;  ///< share of the interval; the weights of a rule sum to 1
};

/// The Gauss-Legendre rule of `kNodes` nodes, 2 or 3, which integrates polynomials up to degree
/// 2 kNodes - 1 exactly.
template <std::size_t kNodes>
class GaussRule {
 public:
  GaussRule();

  /// The nodes over [0,1] in ascending order.
  const std::array<GaussNode, kNodes>& nodes() const { return nodes_; }

  /// ∫ of a function of one number over [low, high], which is evaluated at the kNodes nodes.
  template <class Function>
  double integrate(double low, double high, const Function& f) const {
    double mean = 0.0;
    for (const GaussNode& node : nodes_) mean += node.weight * f(low + node.at * (high - low));
    return (high - low) * mean;
  }

 private:
  std::array<GaussNode, kNodes> nodes_ = {};
};

extern template class GaussRule<2>;
extern template class GaussRule<3>;

}  // namespace lightproof
