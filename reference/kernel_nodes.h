// The nodes of a quadrature at which a kernel is not 0.
#pragma once

#include "reference/estimator_moments.h"
#include "reference/quadrature.h"

namespace lightproof::reference {

/// Calls add(node, value) for every node of cell (x, y) at which k is positive. Where no edge
/// crosses the cell, one look tells whether light arrives in it.
template <class Add>
void visit_kernel(const Kernel& kernel, const SphereQuadrature& quadrature, int x, int y,
                  const Add& add) {
  const Direction centre = quadrature.centre(x, y);
  const bool split = kernel.straddles(centre, quadrature.radius());
  if (!split && kernel.is_lit && !kernel.is_lit(centre)) return;
  quadrature.visit(x, y, split, [&](const Node& node) {
    if (split && kernel.is_lit && !kernel.is_lit(node.direction)) return;
    const KernelValue value = kernel.at(node.direction);
    if (value.k > 0.0) add(node, value);
  });
}

}  // namespace lightproof::reference
