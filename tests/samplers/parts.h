// Where along a line a sampler goes from one texel to another.
#pragma once

#include <cmath>

namespace lightproof::test {

/// A part of a line that leads to one place.
struct Part {
  double first;
  double last;
  double end;  ///< the number behind the last
};

/// Calls visit(Part) for the parts of [first, end) in their order, found by bisection: what leads
/// to where(first), then what follows. A part between two that lead to one place may be overlooked.
template <class Where, class Visit>
void for_parts(double first, double end, const Where& where, const Visit& visit) {
  while (first < end) {
    const auto here = where(first);
    double inside = first;
    double outside = end;
    while (std::nextafter(inside, end) < outside) {
      const double middle = 0.5 * (inside + outside);
      (where(middle) == here ? inside : outside) = middle;
    }
    visit(Part{first, inside, outside});
    first = outside;
  }
}

}  // namespace lightproof::test
