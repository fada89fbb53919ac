// Building blocks of the page. Text goes in as plain text and comes out escaped; only functions
// whose parameter is called `html` take markup.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace lightproof {

/// A text with & < > " ' as entities: safe between tags and inside quoted attributes, in HTML and
/// in XML. What XML cannot hold becomes U+FFFD.
std::string escaped(std::string_view text);

/// JSON for a `<script type="application/json">`: no `<` is left that could end the element.
std::string script_safe_json(std::string_view json);

/// JavaScript for a `<script>`: `</script` and `<!--` broken up inside strings, source maps
/// dropped.
std::string script_safe_code(std::string_view code);

/// Bytes in base 64.
std::string base64(std::string_view bytes);
/// Bytes as a data: URI of this media type.
std::string data_uri(std::string_view media_type, std::string_view bytes);

/// A paragraph, `<p class=…>text</p>`.
std::string paragraph(std::string_view text, std::string_view css_class = "");

/// A closed block that opens on a click.
std::string collapsible(std::string_view summary, std::string_view html);

/// A link that saves `content` under `file_name`; works without a network.
std::string download_link(std::string_view file_name, std::string_view content);

/// A cell's text with its class: "number", "accept", "reject", "inconclusive" or nothing.
struct Cell {
  std::string text;
  std::string css_class;
  std::string tooltip;
};

/// A cell of text without a class.
Cell text_cell(std::string text);
/// A cell of the class "number", whose text is format_number().
Cell number_cell(double value, int digits = 3);

/// A table inside its own scrolling frame.
class Table {
 public:
  /// `caption` names the table for those who cannot see what stands around it.
  Table(std::string caption, std::vector<std::string> columns, std::string css_class = "");
  /// Adds a row, whose first cell is its heading.
  void add(const std::vector<Cell>& row);
  std::string html() const;

 private:
  std::string caption_;
  std::vector<std::string> columns_;
  std::string css_class_;
  std::vector<std::string> column_classes_;  ///< classes of the first row's cells
  std::string body_;
};

/// What a chart is headed by when its lists have chosen `key`: their entries with " | " between.
struct ChartTitle {
  std::string key;
  std::string title;
};

/// A chart that the page's script draws from its specification.
struct Chart {
  std::string id;           ///< letters, digits and '-'; also the name of a saved picture
  std::string title;        ///< the finding
  std::string description;  ///< for those who cannot see it
  std::string note;         ///< how to read it; may be empty
  std::string spec;         ///< Vega-Lite JSON
  /// Titles that take the place of `title` as the reader chooses; may be empty.
  std::vector<ChartTitle> titles = {};
  /// Whether it has so many columns that a narrow window scrolls it sideways.
  bool is_wide = false;
};

/// A part of a chart's figure that is shown only while its lists have chosen `key`.
std::string choice_block(std::string_view key, std::string_view html);

/// A chart as a figure of the page; `extra_html` (tables, downloads) stands below the chart.
std::string chart_figure(const Chart& chart, std::string_view extra_html, bool small = false);

}  // namespace lightproof
