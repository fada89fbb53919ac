#include "lightproof/systems/comparisons.h"

#include <algorithm>
#include <charconv>
#include <utility>

#include "lightproof/points/float_decay.h"
#include "lightproof/points/registry.h"
#include "lightproof/prefilter/diffuse_comparisons.h"
#include "lightproof/prefilter/specular_comparisons.h"

namespace lightproof {
namespace {

PublishedComparison distinct_points_comparison() {
  constexpr std::uint64_t kWindow = 65536;
  constexpr std::uint64_t kFirst = 1000000;
  const auto distinct = [](std::string_view name) {
    return static_cast<double>(float_decay_at(point_set_by_name(name), kFirst, kWindow).distinct);
  };
  return {"004-12", "distinct points among 65536 of R2 from index 1,000,000 on, in float",
          static_cast<double>(kWindow), distinct("R2 float"), distinct("R2")};
}

/// "004-12" as (4, 12): in the order of numbers.
std::pair<int, int> order_of(std::string_view id) {
  std::pair<int, int> order;
  std::from_chars(id.data(), id.data() + 3, order.first);
  std::from_chars(id.data() + 4, id.data() + id.size(), order.second);
  return order;
}

}  // namespace

std::vector<PublishedComparison> system_comparisons() {
  std::vector<PublishedComparison> all = diffuse_comparisons();
  for (const PublishedComparison& specular : specular_comparisons()) all.push_back(specular);
  all.push_back(distinct_points_comparison());
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
    return order_of(a.system) < order_of(b.system);
  });
  return all;
}

}  // namespace lightproof
