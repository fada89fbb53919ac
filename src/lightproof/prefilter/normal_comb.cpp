#include "lightproof/prefilter/normal_comb.h"

#include <algorithm>
#include <cmath>

namespace lightproof {

NormalCombView::NormalCombView(const NormalComb& comb, const FoldedLattice& lattice)
    : comb_(comb), columns_(lattice.columns), first_edge_(edge_before(0.5 * kPi)) {
  const int last_edge = edge_before(1.5 * kPi) + 1;
  for (int e = first_edge_; e <= last_edge; ++e) {
    edges_.emplace_back(comb.tilt, 2.0 * kPi * e / columns_ - comb.first);
  }
  for (const double theta : lattice.parallels) parallels_.emplace_back(comb.tilt, theta);
  while (rows_seen_ < lattice.rows() && parallels_[rows_seen_ + 1].horizon >= kPi) ++rows_seen_;
}

CosineBand NormalCombView::band(int row) const {
  const auto inner = static_cast<std::size_t>(row);
  return {comb_.tilt, parallels_[inner], parallels_[inner + 1]};
}

int NormalCombView::edge_before(double azimuth) const {
  return static_cast<int>(std::floor((azimuth + comb_.first) * columns_ / (2.0 * kPi)));
}

RowView NormalCombView::view(const CosineBand& band) const {
  const int last = first_edge_ + static_cast<int>(edges_.size()) - 1;
  const auto clamped = [&](int edge) { return std::clamp(edge, first_edge_, last); };
  RowView view;
  view.leaving.begin = clamped(edge_before(band.visible_until()));
  view.leaving.end = clamped(edge_before(band.hidden_from()) + 1);
  view.returning.begin = clamped(edge_before(2.0 * kPi - band.hidden_from()));
  view.returning.end = clamped(edge_before(2.0 * kPi - band.visible_until()) + 1);
  // Where one texel holds the opposite meridian, it is crossed from both sides, but once.
  if (view.returning.begin < view.leaving.end) view.returning.begin = view.leaving.end;
  view.seen = {view.returning.end - columns_, view.leaving.begin};
  return view;
}

}  // namespace lightproof
