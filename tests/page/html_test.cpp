#include "lightproof/page/html.h"

#include <gtest/gtest.h>

namespace lightproof {
namespace {

TEST(Escaped, LeavesNothingThatABrowserWouldRun) {
  EXPECT_EQ(escaped("<script>alert(\"x\")</script> & 'y'"),
            "&lt;script&gt;alert(&quot;x&quot;)&lt;/script&gt; &amp; &#39;y&#39;");
}

TEST(ScriptSafe, CannotEndItsElement) {
  EXPECT_EQ(script_safe_json(R"({"map":"</script><b>"})"), R"({"map":"\u003c/script>\u003cb>"})");
  EXPECT_EQ(script_safe_code("a('</script>');b('<!--');\n//# sourceMappingURL=a.map"),
            "a('<\\/script>');b('<\\!--');\n");
}

TEST(Base64, MatchesRfc4648) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xff\xfe\xfd"), "//79");
}

TEST(Table, EscapesItsCells) {
  Table table("a \"caption\"", {"<name>", "value"});
  table.add({text_cell("<b>"), number_cell(-1.5)});
  const std::string html = table.html();
  EXPECT_NE(html.find("<th scope=\"col\">&lt;name&gt;</th>"), std::string::npos) << html;
  EXPECT_NE(html.find("<th scope=\"col\" class=\"number\">value</th>"), std::string::npos) << html;
  EXPECT_NE(html.find("<th scope=\"row\">&lt;b&gt;</th>"), std::string::npos) << html;
  EXPECT_NE(html.find("<td class=\"number\">\u22121.50</td>"), std::string::npos) << html;
  EXPECT_NE(html.find("aria-label=\"a &quot;caption&quot;\""), std::string::npos) << html;
}

// XML 1.0 has no way to write these: one of them makes a whole file unreadable.
TEST(Escaped, HoldsNothingThatXmlCannot) {
  EXPECT_EQ(escaped("a\x01"
                    "b\x1b\xff"),
            "a\ufffdb\ufffd\ufffd");
  EXPECT_EQ(escaped("tab\t and line\n"), "tab\t and line\n");
}

TEST(ChartFigure, HoldsTitlesAndBlocksForTheScriptThatFollowsTheLists) {
  const std::string html =
      chart_figure({"id", "first", "", "", "{}", {{"a | </script>", "first"}, {"b", "<second>"}}},
                   choice_block("a | \"x\"", "<p>1</p>"));
  EXPECT_NE(
      html.find(R"(class="titles">{"a | \u003c/script>":"first","b":"\u003csecond>"}</script>)"),
      std::string::npos)
      << html;
  EXPECT_NE(html.find("<div data-choice=\"a | &quot;x&quot;\">\n<p>1</p></div>"), std::string::npos)
      << html;
}

}  // namespace
}  // namespace lightproof
