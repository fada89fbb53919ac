#include "lightproof/systems/comparisons.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "lightproof/systems/registry.h"

namespace lightproof {
namespace {

TEST(SystemComparisons, AreOfSystemsWhoseFormIsPublished) {
  for (const PublishedComparison& comparison : system_comparisons()) {
    const auto systems_list = systems();
    const auto system =
        std::find_if(systems_list.begin(), systems_list.end(),
                     [&](const SystemInfo& info) { return info.id == comparison.system; });
    ASSERT_NE(system, systems_list.end()) << comparison.system;
    EXPECT_FALSE(system->is_inferred) << comparison.system << ": no form of it is published";
    EXPECT_FALSE(comparison.what.empty());
  }
}

TEST(SystemComparisons, StandInTheOrderOfTheSystems) {
  std::vector<std::string> ids;
  for (const SystemInfo& system : systems()) ids.emplace_back(system.id);
  std::ptrdiff_t last = 0;
  for (const PublishedComparison& comparison : system_comparisons()) {
    const auto place = std::find(ids.begin(), ids.end(), comparison.system) - ids.begin();
    EXPECT_GE(place, last) << comparison.system;
    last = place;
  }
}

TEST(SystemComparisons, CorrectWhatIsPublished) {
  for (const PublishedComparison& c : system_comparisons()) {
    ASSERT_TRUE(std::isfinite(c.exact)) << c.system << ": " << c.what;
    ASSERT_TRUE(std::isfinite(c.corrected)) << c.system << ": " << c.what;
    EXPECT_TRUE(std::abs(c.corrected - c.exact) < std::abs(c.published - c.exact) ||
                !std::isfinite(c.published))
        << c.system << ": " << c.what << ", published " << c.published << ", corrected "
        << c.corrected << ", exact " << c.exact;
  }
}

}  // namespace
}  // namespace lightproof
