// The nodes of a quadrature at which a kernel is not 0.
#pragma once

#include "reference/estimator_moments.h"
#include "reference/quadrature.h"

namespace lightproof::reference {

/// Calls add(x, node, value) for every node of row y at which k is positive, in columns x for which
/// is_wanted(x). Where no edge crosses a cell, or a run of cells, one look tells whether light
/// arrives in it.
template <class IsWanted, class Add>
void visit_kernel_row(const Kernel& kernel, const SphereQuadrature& quadrature, CellRule rule,
                      int y, const IsWanted& is_wanted, const Add& add) {
  // How many times as far as a cell reaches there must be no edge if its middle is to do alone.
  // Lobes are then at least w = 34 cells h wide. Of k ~ r^-n in a lobe's tails, h^2/24 times the
  // Laplacian is n^2/24 (h/r)^2 of k: 6e-4 for GGX, whose n is 4, and less at the peak.
  constexpr double kMiddleReach = 8.0;
  const double radius = quadrature.radius(0);
  const auto is_dark = [&](Direction centre) { return kernel.is_lit && !kernel.is_lit(centre); };
  const auto visit_cell = [&](int x, const QuadratureCell& cell, CellNodes nodes, bool looks_each) {
    quadrature.visit(cell, nodes, [&](const Node& node) {
      if (looks_each && kernel.is_lit && !kernel.is_lit(node.direction)) return;
      const KernelValue value = kernel.at(node.direction);
      if (value.k > 0.0) add(x, node, value);
    });
  };
  // The parts of a cell that an edge may cross, down to the smallest.
  const auto visit_parts = [&](const auto& self, int x, const QuadratureCell& cell) -> void {
    if (cell.depth == quadrature.depth()) return visit_cell(x, cell, CellNodes::gauss, true);
    quadrature.visit_parts(cell, [&](const QuadratureCell& part) {
      const Direction centre = quadrature.centre(part);
      if (kernel.straddles(centre, quadrature.radius(part.depth))) return self(self, x, part);
      if (is_dark(centre)) return;
      visit_cell(x, part, CellNodes::gauss, false);
    });
  };
  const double margin = rule == CellRule::adaptive ? kMiddleReach * radius : 0.0;
  const CellNodes smooth = rule == CellRule::gauss ? CellNodes::gauss : CellNodes::middle;
  for (int index = 0; index < quadrature.runs(); ++index) {
    const CellRun run = quadrature.run(index, y);
    const bool run_may_have_edge = kernel.straddles(run.centre, run.radius + margin);
    if (!run_may_have_edge && is_dark(run.centre)) continue;
    for (int x = run.begin; x < run.end; ++x) {
      if (!is_wanted(x)) continue;
      const QuadratureCell cell = {x, y, 0};
      if (!run_may_have_edge) {
        visit_cell(x, cell, smooth, false);
        continue;
      }
      const Direction centre = quadrature.centre(cell);
      if (kernel.straddles(centre, radius)) {
        visit_parts(visit_parts, x, cell);
        continue;
      }
      if (is_dark(centre)) continue;
      const bool is_smooth = margin <= radius || !kernel.straddles(centre, margin);
      visit_cell(x, cell, is_smooth ? smooth : CellNodes::gauss, false);
    }
  }
}

}  // namespace lightproof::reference
