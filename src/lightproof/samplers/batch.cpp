#include "lightproof/samplers/batch.h"

#include "lightproof/core/random_batch.h"

namespace lightproof {

void BatchPoints::fill(std::size_t from, std::span<double> s, std::span<double> t) const {
  if (is_stream_) {
    fill_points(stream_, first_ + from, s, t);
    return;
  }
  for (std::size_t i = 0; i < s.size(); ++i) {
    const SquarePoint u = below_one(given_[from + i]);
    s[i] = u.s;
    t[i] = u.t;
  }
}

}  // namespace lightproof
