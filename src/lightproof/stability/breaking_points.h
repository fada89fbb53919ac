// Where methods first fail as an input is made harder and harder: searched, not listed.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "lightproof/core/executor.h"
#include "lightproof/results/stability_result.h"
#include "lightproof/stability/stability.h"

namespace lightproof {

/// What is made harder: a positive number that is multiplied, from an easy value to a hard one,
/// which may be the smaller.
struct SearchRange {
  double easiest = 1.0;
  double hardest = 1.0;
  /// The search ends once the two ends of the interval differ by this factor, or, of whole numbers,
  /// by 1.
  double resolution = 1.05;
  bool is_whole = false;
};

/// The ends of an interval that a breaking point lies in, see BreakingPoint.
struct Bracket {
  std::optional<double> passed;
  std::optional<double> failed;
};

/// Where `passes` is first false: from the easiest value on the step is doubled or halved, so that
/// each value is twice as hard, until one fails; between it and the one before the search goes on
/// by bisection (of logarithms). A failure that is over before the next step is not seen.
Bracket find_breaking_point(const SearchRange& range,
                            const std::function<bool(double value)>& passes);

/// A search for every method and quantity that can be made harder for it; the keys begin with
/// "breaking/". All tests are without statistics, or at the same points every time. The methods
/// must outlive the cells.
std::vector<WorkCell<BreakingPoint>> breaking_point_cells(const StabilityMethods& methods,
                                                          const StabilityOptions& options);

}  // namespace lightproof
