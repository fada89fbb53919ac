#include "lightproof/page/html.h"

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>

#include "lightproof/core/text_escapes.h"
#include "lightproof/page/numbers.h"

namespace lightproof {
namespace {

std::string class_attribute(std::string_view css_class) {
  return css_class.empty() ? "" : fmt::format(" class=\"{}\"", escaped(css_class));
}

std::string replaced(std::string text, std::string_view from, std::string_view to) {
  for (std::size_t at = text.find(from); at != std::string::npos;
       at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
  return text;
}

std::string without_source_map(std::string code) {
  const std::size_t at = code.rfind("//# sourceMappingURL=");
  return at == std::string::npos ? code : code.substr(0, at);
}

/// Titles by what is chosen, for the page's script.
std::string titles_html(const std::vector<ChartTitle>& titles) {
  nlohmann::ordered_json by_key;
  for (const auto& [key, title] : titles) by_key[well_formed_text(key)] = well_formed_text(title);
  return fmt::format("<script type=\"application/json\" class=\"titles\">{}</script>\n",
                     script_safe_json(by_key.dump()));
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string html;
  for (const char c : well_formed_text(text)) {
    switch (c) {
      case '&':
        html += "&amp;";
        break;
      case '<':
        html += "&lt;";
        break;
      case '>':
        html += "&gt;";
        break;
      case '"':
        html += "&quot;";
        break;
      case '\'':
        html += "&#39;";
        break;
      default:
        html += c;
    }
  }
  return html;
}

std::string script_safe_json(std::string_view json) {
  return replaced(std::string(json), "<", "\\u003c");
}

std::string script_safe_code(std::string_view code) {
  std::string safe = without_source_map(std::string(code));
  safe = replaced(std::move(safe), "</script", "<\\/script");
  return replaced(std::move(safe), "<!--", "<\\!--");
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t have = std::min<std::size_t>(3, bytes.size() - i);
    std::array<unsigned, 3> b = {};
    for (std::size_t k = 0; k < have; ++k) b[k] = static_cast<unsigned char>(bytes[i + k]);
    const unsigned bits = (b[0] << 16U) | (b[1] << 8U) | b[2];
    text += kDigits[(bits >> 18U) & 63U];
    text += kDigits[(bits >> 12U) & 63U];
    text += have > 1 ? kDigits[(bits >> 6U) & 63U] : '=';
    text += have > 2 ? kDigits[bits & 63U] : '=';
  }
  return text;
}

std::string data_uri(std::string_view media_type, std::string_view bytes) {
  return fmt::format("data:{};base64,{}", media_type, base64(bytes));
}

std::string paragraph(std::string_view text, std::string_view css_class) {
  return fmt::format("<p{}>{}</p>\n", class_attribute(css_class), escaped(text));
}

std::string collapsible(std::string_view summary, std::string_view html) {
  return fmt::format("<details>\n<summary>{}</summary>\n{}</details>\n", escaped(summary), html);
}

std::string download_link(std::string_view file_name, std::string_view content) {
  return fmt::format("<p class=\"download\"><a download=\"{0}\" href=\"{1}\">Save {0}</a></p>\n",
                     escaped(file_name), data_uri("text/csv;charset=utf-8", content));
}

Cell text_cell(std::string text) { return {std::move(text), "", ""}; }

Cell number_cell(double value, int digits) { return {format_number(value, digits), "number", ""}; }

Table::Table(std::string caption, std::vector<std::string> columns, std::string css_class)
    : caption_(std::move(caption)),
      columns_(std::move(columns)),
      css_class_(std::move(css_class)) {}

void Table::add(const std::vector<Cell>& row) {
  if (body_.empty()) {
    for (const Cell& cell : row) column_classes_.push_back(cell.css_class);
  }
  body_ += "<tr>";
  for (std::size_t i = 0; i < row.size(); ++i) {
    const std::string title =
        row[i].tooltip.empty() ? "" : fmt::format(" title=\"{}\"", escaped(row[i].tooltip));
    body_ += fmt::format("<{0}{1}{2}>{3}</{4}>", i == 0 ? "th scope=\"row\"" : "td",
                         class_attribute(row[i].css_class), title, escaped(row[i].text),
                         i == 0 ? "th" : "td");
  }
  body_ += "</tr>\n";
}

std::string Table::html() const {
  std::string head;
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const bool number = i < column_classes_.size() && column_classes_[i] == "number";
    head += fmt::format("<th scope=\"col\"{}>{}</th>", number ? " class=\"number\"" : "",
                        escaped(columns_[i]));
  }
  return fmt::format(
      "<div class=\"table-frame\" tabindex=\"0\" role=\"region\" aria-label=\"{0}\">\n"
      "<table{1}>\n<caption>{0}</caption>\n<thead><tr>{2}</tr></thead>\n<tbody>\n{3}</tbody>\n"
      "</table>\n</div>\n",
      escaped(caption_), class_attribute(css_class_), head, body_);
}

std::string choice_block(std::string_view key, std::string_view html) {
  return fmt::format("<div data-choice=\"{}\">\n{}</div>\n", escaped(key), html);
}

std::string chart_figure(const Chart& chart, std::string_view extra_html, bool small) {
  const std::string_view heading = small ? "h4" : "h3";
  std::string html = fmt::format(
      "<figure class=\"chart{0}\" id=\"{1}\">\n<figcaption><{2}>{3}</{2}></figcaption>\n"
      "<div class=\"controls\"></div>\n<div class=\"drawing\" role=\"group\" "
      "aria-label=\"{4}\"></div>\n"
      "<script type=\"application/json\">{5}</script>\n",
      small           ? " small"
      : chart.is_wide ? " wide"
                      : "",
      escaped(chart.id), heading, escaped(chart.title), escaped(chart.description),
      script_safe_json(chart.spec));
  if (!chart.titles.empty()) html += titles_html(chart.titles);
  if (!chart.note.empty()) html += paragraph(chart.note, "note");
  return html + std::string(extra_html) + "</figure>\n";
}

}  // namespace lightproof
