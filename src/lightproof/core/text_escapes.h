// Text that others chose (names of files and of benchmarks), made safe for the languages that our
// outputs are written in. HTML and XML have theirs in report/html.h.
#pragma once

#include <string>
#include <string_view>

namespace lightproof {

/// A text for a terminal or a log: control characters, marks that turn the direction of writing,
/// and bytes that are no UTF-8 become `\x1b`. Everything else stays, so that no name can move the
/// cursor, change colours or start a line of its own.
std::string terminal_text(std::string_view text);

/// terminal_text() of every line of a text; its line breaks stay.
std::string terminal_lines(std::string_view text);

/// A text for XML and HTML, before markup is escaped: bytes that are no UTF-8 and the control
/// characters that XML cannot hold become U+FFFD.
std::string well_formed_text(std::string_view text);

/// A text for GitHub's Markdown, inside a paragraph or a cell of a table: the reader sees it as it
/// is, and none of it is markup, an HTML tag, a mention or a reference to an issue. Line breaks
/// become spaces; other control characters become what terminal_text() makes of them.
std::string markdown_text(std::string_view text);

/// A text for the message of a workflow command of GitHub Actions, which ends at a line break: line
/// breaks and '%' are encoded. Other control characters become what terminal_text() makes of them.
std::string workflow_message(std::string_view text);

/// A text for the value of a property of a workflow command of GitHub Actions (`title=…`): line
/// breaks, '%', ':' and ',' are encoded. Other control characters become what terminal_text() makes
/// of them.
std::string workflow_property(std::string_view text);

/// A text as one word for a shell, whatever is in it. Text with control characters or bytes that
/// are no UTF-8 comes as $'…', which bash, zsh and ksh read.
std::string shell_word(std::string_view text);

}  // namespace lightproof
