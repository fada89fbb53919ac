#include "lightproof/samplers/cell_angles.h"

namespace lightproof {

CellAngles::CellAngles(int count, double turns, int kept)
    : cell_turns_(turns / count),
      cell_radians_(2.0 * kPi * cell_turns_),
      are_narrow_(cell_radians_ <= kSmallAngle) {
  if (!are_narrow_) return;
  edges_.reserve(static_cast<std::size_t>(kept));
  for (int cell = 0; cell < kept; ++cell) edges_.push_back(sin_cos_of_turns(cell * cell_turns_));
}

}  // namespace lightproof
