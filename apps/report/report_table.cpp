#include <array>
#include <cmath>
#include <cstdio>
#include <map>

#include <glissade/apps/report/report_table.h>

namespace glissade::apps {

namespace {

std::string cell_html(const ReportCell& cell) {
  if (!cell.number) return "<td>" + html_escaped(cell.text) + "</td>";
  std::array<char, 32> number{};
  std::snprintf(number.data(), number.size(), "%.9g", *cell.number);
  const std::string key = std::isfinite(*cell.number) ? " data-number=\"" + std::string(number.data()) + "\"" : "";
  return "<td class=\"number\"" + key + ">" + html_escaped(cell.text) + "</td>";
}

}  // namespace

std::string html_escaped(const std::string& text) {
  const std::map<char, std::string> escapes{
      {'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}, {'\'', "&#39;"}};
  std::string result;
  for (const char character : text) {
    const auto escape = escapes.find(character);
    result += escape == escapes.end() ? std::string(1, character) : escape->second;
  }
  return result;
}

std::string to_html(const ReportTable& table) {
  if (table.rows.empty()) return "";
  std::string html =
      "<section>\n<h2>" + html_escaped(table.title) + "</h2>\n<div class=\"wide\"><table class=\"rows\">\n<thead><tr>";
  for (const std::string& column : table.columns)
    html += "<th scope=\"col\"><button>" + html_escaped(column) + "</button></th>";
  html += "</tr></thead>\n<tbody>\n";
  for (const std::vector<ReportCell>& row : table.rows) {
    html += "<tr>";
    for (const ReportCell& cell : row)
      html += cell_html(cell);
    html += "</tr>\n";
  }
  return html + "</tbody>\n</table></div>\n</section>\n";
}

}  // namespace glissade::apps
