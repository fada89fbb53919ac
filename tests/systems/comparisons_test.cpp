#include "lightproof/systems/comparisons.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "lightproof/core/serialise.h"
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

// What a later study reads of what an earlier one kept.
TEST(PublishedForms, AreReadBackAsTheyAreKept) {
  PublishedForms forms;
  forms.comparisons = {{"002-2", "a formula", 1.0, 2.0, 1.5}};
  PublishedPicture picture;
  picture.system = "002-6";
  picture.what = "a sphere";
  picture.published_form = "one";
  picture.corrected_form = "another";
  picture.exact_form = "by force";
  picture.exact = picture.published = picture.corrected = Grid<Rgb>({2, 1}, Rgb(0.5F));
  picture.published_error = picture.corrected_error = Grid<double>({2, 1}, 0.25);
  picture.published_rmse = 0.1;
  picture.corrected_rmse = 0.2;
  picture.noise = 0.3;
  forms.pictures = {picture};
  ValueWriter writer;
  writer.add(forms);
  const std::string bytes = writer.take();
  ValueReader reader(bytes);
  const auto read = reader.value<PublishedForms>();
  EXPECT_TRUE(reader.is_at_end());
  ASSERT_EQ(read.comparisons.size(), 1U);
  EXPECT_EQ(read.comparisons[0].system, "002-2");
  EXPECT_EQ(read.comparisons[0].corrected, 1.5);
  ASSERT_EQ(read.pictures.size(), 1U);
  EXPECT_EQ(read.pictures[0].exact_form, "by force");
  EXPECT_EQ(read.pictures[0].corrected.values()[1].g, 0.5F);
  EXPECT_EQ(read.pictures[0].published_error.values()[1], 0.25);
  EXPECT_EQ(read.pictures[0].noise, 0.3);
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
