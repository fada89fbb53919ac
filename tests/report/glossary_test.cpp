#include "lightproof/report/glossary.h"

#include <gtest/gtest.h>

#include "fixture.h"
#include "lightproof/report/warp_figures.h"

namespace lightproof {
namespace {

TEST(Glossary, ExplainsAWordOnceAndAsItStands) {
  const std::string html = with_words_explained("<p>A Receiver, and a receiver.</p>");
  EXPECT_TRUE(html.starts_with("<p>A <abbr tabindex=\"0\" title=\"the surface")) << html;
  EXPECT_TRUE(html.ends_with("\">Receiver</abbr>, and a receiver.</p>")) << html;
}

TEST(Glossary, LeavesTagsScriptsAndPartsOfWordsAlone) {
  const std::string html =
      "<script>let receiver;</script><i title=\"receiver\">receivership</i><svg>receiver</svg>";
  EXPECT_EQ(with_words_explained(html), html);
}

TEST(Glossary, ExplainsOfSingularAndPluralTheFirst) {
  const std::string html = with_words_explained("<p>Effects, effect.</p>");
  EXPECT_NE(html.find("\">Effects</abbr>, effect."), std::string::npos) << html;
}

TEST(WarpFigures, SayHowMuchFartherTheAliasTableTakesNeighbours) {
  const std::vector<WarpGrid> grids = testing::synthetic_study().warps;
  EXPECT_EQ(warp_finding(grids),
            "An alias table takes neighbouring points 4 to 15 times as far apart as a monotone "
            "table");
  EXPECT_EQ(warp_figures({}), "");
}

}  // namespace
}  // namespace lightproof
