#include "lightproof/systems/comparisons.h"

#include <algorithm>
#include <cstddef>
#include <string_view>

#include "lightproof/points/float_decay.h"
#include "lightproof/points/registry.h"
#include "lightproof/prefilter/diffuse_comparisons.h"
#include "lightproof/prefilter/specular_comparisons.h"
#include "lightproof/shading/shaded_pictures.h"
#include "lightproof/shading/shading_comparisons.h"
#include "lightproof/systems/registry.h"

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

/// The system's place in their list.
std::ptrdiff_t place_of(std::string_view id) {
  const auto all = systems();
  return std::find_if(all.begin(), all.end(),
                      [&](const SystemInfo& info) { return info.id == id; }) -
         all.begin();
}

}  // namespace

std::vector<PublishedComparison> system_comparisons() {
  std::vector<PublishedComparison> all = diffuse_comparisons();
  for (const PublishedComparison& specular : specular_comparisons()) all.push_back(specular);
  for (const PublishedComparison& shading : shading_comparisons()) all.push_back(shading);
  all.push_back(distinct_points_comparison());
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
    return place_of(a.system) < place_of(b.system);
  });
  return all;
}

std::vector<PublishedPicture> system_pictures(const Progress& progress) {
  return shaded_pictures({}, progress);
}

PublishedForms kept_published_forms(const MeasurementCache& cache, const Progress& progress) {
  return MeasurementKeeper(cache)
      .get<PublishedForms>("published-forms", "",
                           [&] {
                             return PublishedForms{system_comparisons(), system_pictures(progress)};
                           })
      .value;
}

}  // namespace lightproof
