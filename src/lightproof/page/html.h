// Building blocks of the page. Text goes in as plain text and comes out escaped; only functions
// whose parameter is called `html` take markup.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace lightproof {

/// & < > " ' as entities: safe between tags and inside quoted attributes, in HTML and in XML. What
/// XML cannot hold becomes U+FFFD.
std::string escaped(std::string_view text);

/// JSON for a <script type="application/json">: no "<" is left that could end the element.
std::string script_safe_json(std::string_view json);

/// JavaScript for a <script>: "</script" and "<!--" broken up inside strings, source maps dropped.
std::string script_safe_code(std::string_view code);

std::string base64(std::string_view bytes);
std::string data_uri(std::string_view media_type, std::string_view bytes);

/// <p class=…>text</p>
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

Cell text_cell(std::string text);
Cell number_cell(double value, int digits = 3);

/// A table inside its own scrolling frame.
class Table {
 public:
  /// `caption` names the table for those who cannot see what stands around it.
  Table(std::string caption, std::vector<std::string> columns, std::string css_class = "");
  /// The first cell is the row's heading.
  void add(const std::vector<Cell>& row);
  std::string html() const;

 private:
  std::string caption_;
  std::vector<std::string> columns_;
  std::string css_class_;
  std::vector<std::string> column_classes_;  ///< of the first row
  std::string body_;
};

/// A chart that the page's script draws from its specification.
struct Chart {
  std::string id;           ///< letters, digits and '-'; also the name of a saved picture
  std::string title;        ///< the finding
  std::string description;  ///< for those who cannot see it
  std::string note;         ///< how to read it; may be empty
  std::string spec;         ///< Vega-Lite JSON
};

/// `extra_html` (tables, downloads) stands below the chart inside the figure.
std::string chart_figure(const Chart& chart, std::string_view extra_html, bool small = false);

}  // namespace lightproof
