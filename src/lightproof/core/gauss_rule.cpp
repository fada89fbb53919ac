#include "lightproof/core/gauss_rule.h"

#include <boost/math/quadrature/gauss.hpp>

namespace lightproof {

template <std::size_t kNodes>
GaussRule<kNodes>::GaussRule() {
  // Boost's rule is that of [-1,1], of which it gives the half from 0 on, in ascending order.
  using Rule = boost::math::quadrature::gauss<double, kNodes>;
  constexpr std::size_t kHalf = kNodes / 2;
  for (std::size_t i = 0; i < kNodes - kHalf; ++i) {
    const double from_middle = 0.5 * Rule::abscissa()[i];
    const double weight = 0.5 * Rule::weights()[i];
    nodes_[kHalf + i] = {0.5 + from_middle, weight};
    nodes_[kNodes - 1 - kHalf - i] = {0.5 - from_middle, weight};
  }
}

template class GaussRule<2>;
template class GaussRule<3>;

}  // namespace lightproof
