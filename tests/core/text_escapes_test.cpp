#include "lightproof/core/text_escapes.h"

#include <gtest/gtest.h>

namespace lightproof {
namespace {

TEST(TerminalText, ShowsWhatWouldControlTheTerminal) {
  EXPECT_EQ(terminal_text("\x1b[2Jsky\r\n\t\x7f"), "\\x1b[2Jsky\\x0d\\x0a\\x09\\x7f");
  EXPECT_EQ(terminal_text("\xc2\x9b"
                          "31m"),
            "\\xc2\\x9b31m")
      << "CSI as one C1 character";
  EXPECT_EQ(terminal_text("\u202Egnp.exr"), "\\xe2\\x80\\xaegnp.exr") << "right to left";
}

TEST(TerminalText, ShowsBytesThatAreNoUtf8) {
  EXPECT_EQ(terminal_text("a\xff"
                          "b\xc3"),
            "a\\xffb\\xc3");
  EXPECT_EQ(terminal_text("\xc0\xaf"), "\\xc0\\xaf") << "too long a form";
  EXPECT_EQ(terminal_text("\xed\xa0\x80"), "\\xed\\xa0\\x80") << "half a surrogate pair";
}

TEST(TerminalText, LeavesTheLettersOfAllLanguages) {
  EXPECT_EQ(terminal_text("caf\u00e9 \u7a7a \U0001F305 \u2713"),
            "caf\u00e9 \u7a7a \U0001F305 \u2713");
}

TEST(TerminalLines, KeepLineBreaksAlone) {
  EXPECT_EQ(terminal_lines("a\nb\rc\x1b[2J\n"), "a\nb\\x0dc\\x1b[2J\n");
}

TEST(MarkdownText, LeavesNoMarkup) {
  EXPECT_EQ(markdown_text("<b>a|b</b> & `c`"), "&lt;b&gt;a&#124;b&lt;/b&gt; &amp; \\`c\\`");
  EXPECT_EQ(markdown_text("![x](y)*z*~"), "!\\[x\\](y)\\*z\\*\\~");
  EXPECT_EQ(markdown_text("a\nb"), "a b");
}

// GitHub would tell a person, or link an issue.
TEST(MarkdownText, MentionsNobody) {
  EXPECT_EQ(markdown_text("@user #12"), "@<!-- -->user #<!-- -->12");
}

TEST(MarkdownText, LeavesPlainNamesAlone) {
  EXPECT_EQ(markdown_text("linear_scan_published B"), "linear_scan_published B");
  EXPECT_EQ(markdown_text("_a_"), "\\_a\\_");
}

TEST(WorkflowCommand, EndsWhereItShould) {
  EXPECT_EQ(workflow_message("100 %\r\n::error::x"), "100 %25%0D%0A::error::x");
  EXPECT_EQ(workflow_property("a,b::c\n"), "a%2Cb%3A%3Ac%0A");
  EXPECT_EQ(workflow_message("\x1b["), "\\x1b[");
}

TEST(ShellWord, IsOneWordForAShell) {
  EXPECT_EQ(shell_word("maps/a-b_c.exr"), "maps/a-b_c.exr");
  EXPECT_EQ(shell_word("it's mine"), "'it'\\''s mine'");
  EXPECT_EQ(shell_word(""), "''");
  EXPECT_EQ(shell_word("a\n'\xff"), "$'a\\x0a\\'\\xff'");
}

}  // namespace
}  // namespace lightproof
