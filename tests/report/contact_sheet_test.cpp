#include "lightproof/report/contact_sheet.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>

#include "precomputation_fixture.h"

namespace lightproof {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::size_t occurrences(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++count;
  }
  return count;
}

TEST(ContactSheet, ShowsEveryLevelAtThreeExposures) {
  const std::string page = contact_sheet(testing::synthetic_precomputation());
  // 8 levels of a cube, 9 and 1 of latitude-longitude maps, A, B and both of the BRDF map.
  EXPECT_EQ(occurrences(page, "<img "), 3U * (8 + 9 + 1) + 3U);
  for (const char* stops : {"specular, level 7 exposed at \u22123 EV", "level 8 exposed at 0 EV",
                            "irradiance exposed at +3 EV"}) {
    EXPECT_THAT(page, HasSubstr(stops));
  }
}

TEST(ContactSheet, SaysSizeRoughnessAndErrorOfEveryLevel) {
  const std::string page = contact_sheet(testing::synthetic_precomputation());
  EXPECT_THAT(page, HasSubstr("<h4>Level 1: 256\u00d7128</h4>"));
  EXPECT_THAT(page,
              HasSubstr("roughness 0.125, error 0.040\u00a0% (0.036\u00a0% to 0.048\u00a0%)"));
  EXPECT_THAT(page,
              HasSubstr("<h3>A cube of eight levels from 128\u00d7128 to 1\u00d71, with errors "
                        "from 0.020\u00a0% to 2.6\u00a0%</h3>"));
  EXPECT_THAT(page, HasSubstr("<h3>Latitude-longitude, one level of 64\u00d732</h3>"));
  EXPECT_THAT(page, HasSubstr("<h4>Level 0: 64\u00d732</h4>"));
  EXPECT_THAT(page, HasSubstr("<figcaption>error not measured</figcaption>"));
}

TEST(ContactSheet, HeadsWithTheLargestError) {
  Precomputation made = testing::synthetic_precomputation();
  EXPECT_THAT(contact_sheet(made),
              HasSubstr("<h1>Maps of city &lt;b&gt;2&lt;/b&gt;.exr: the largest error is "
                        "5.1\u00a0% (reflectivity, level 8)</h1>"));
  for (PrecomputedMap& map : made.maps) map.errors.clear();
  made.brdf_map.reset();
  EXPECT_THAT(contact_sheet(made), HasSubstr(".exr: errors were not measured</h1>"));
}

TEST(ContactSheet, SaysHowTheMapsWereMadeAndWhereTheyAre) {
  const std::string page = contact_sheet(testing::synthetic_precomputation());
  EXPECT_THAT(page, HasSubstr("<dt>method</dt><dd>means of four texels</dd>"));
  EXPECT_THAT(page, HasSubstr("<dt>levels</dt><dd>9</dd>"));
  EXPECT_THAT(page, HasSubstr("File: specular.ktx2"));
  EXPECT_THAT(page, HasSubstr("12 values are above 65504"));
}

TEST(ContactSheet, NeverContainsTheMarkupOfANameAsMarkup) {
  const std::string page = contact_sheet(testing::synthetic_precomputation());
  EXPECT_THAT(page, Not(HasSubstr("<script>alert")));
  EXPECT_THAT(page, Not(HasSubstr("<b>2</b>")));
}

TEST(ContactSheet, NeedsNothingFromOutsideAndNoChartLibraries) {
  const std::string page = contact_sheet(testing::synthetic_precomputation());
  static const std::regex reference_mark(R"((src|href)="(?!data:|#))");
  EXPECT_FALSE(std::regex_search(page, reference_mark));
  EXPECT_THAT(page, Not(HasSubstr("Vega")));
  EXPECT_LT(page.size(), std::size_t{3} << 20U);
}

TEST(ContactSheet, ShowsCubesOnlyWhereThereAreSome) {
  Precomputation made = testing::synthetic_precomputation();
  EXPECT_THAT(contact_sheet(made), HasSubstr("Cubes are unfolded"));
  made.maps.erase(made.maps.begin());
  EXPECT_THAT(contact_sheet(made), Not(HasSubstr("Cubes are unfolded")));
}

}  // namespace
}  // namespace lightproof
