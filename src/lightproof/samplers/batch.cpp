#include "lightproof/samplers/batch.h"

#include "lightproof/core/random_batch.h"

namespace lightproof {

void BatchPoints::fill(std::size_t from, std::span<double> s, std::span<double> t) const {
  if (is_stream_) {
    fill_points(stream_, first_ + from, s, t);
    return;
  }
  for (std::size_t i = 0; i < s.size(); ++i) {
    s[i] = given_[from + i].s;
    t[i] = given_[from + i].t;
  }
}

}  // namespace lightproof
