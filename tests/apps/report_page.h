#pragma once

/// What a report adds to the viewer's page.

#include <map>
#include <regex>
#include <stdexcept>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace glissade::test_support {

/// The text between two others.
inline std::string text_between(const std::string& text, const std::string& begin, const std::string& end) {
  const std::size_t place = text.find(begin);
  if (place == std::string::npos) throw std::runtime_error("no " + begin);
  const std::size_t from = place + begin.size();
  return text.substr(from, text.find(end, from) - from);
}

/// Its elements: summary and data, without the scripts of the page.
inline std::string content_of(const std::string& page) {
  return text_between(page, "<div class=\"paper\">", "<noscript>");
}

/// The rows of its table, each with its texts by the name of the column.
inline std::vector<std::map<std::string, std::string>> table_of(const std::string& page) {
  const std::string table = text_between(page, "<table class=\"rows\">", "</table>");
  const auto texts = [](const std::string& html, const std::string& cell) {
    std::vector<std::string> found;
    const std::regex pattern(cell);
    for (std::sregex_iterator i(html.begin(), html.end(), pattern); i != std::sregex_iterator(); ++i)
      found.push_back((*i)[1]);
    return found;
  };
  const std::vector<std::string> columns = texts(table, "<button>(.*?)</button>");
  std::vector<std::map<std::string, std::string>> rows;
  for (const std::string& row : texts(text_between(table, "<tbody>", "</tbody>"), "<tr>(.*?)</tr>")) {
    const std::vector<std::string> cells = texts(row, "<td[^>]*>(.*?)</td>");
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (i == 0) rows.emplace_back();
      rows.back()[columns.at(i)] = cells[i];
    }
  }
  return rows;
}

/// The data of its plots, in their order.
inline nlohmann::json plots_of(const std::string& page) {
  return nlohmann::json::parse(text_between(page, "id=\"report-plots\">", "</script>"));
}

inline std::vector<std::string> titles_of(const std::string& page) {
  std::vector<std::string> titles;
  for (const nlohmann::json& plot : plots_of(page))
    titles.push_back(plot.at("title"));
  return titles;
}

/// The plot with this title.
inline nlohmann::json plot_of(const std::string& page, const std::string& title) {
  for (const nlohmann::json& plot : plots_of(page)) {
    if (plot.at("title") == title) return plot;
  }
  throw std::runtime_error("no plot " + title);
}

}  // namespace glissade::test_support
