#pragma once

/// A table of a report, whose rows a click on the head of a column sorts.

#include <optional>
#include <string>
#include <vector>

namespace glissade::apps {

/// Cells with numbers are sorted by these, those that are not finite last; all others by their text.
struct ReportCell {
  std::string text;
  std::optional<double> number{};
};

/// Without rows, the page has no table.
struct ReportTable {
  std::string title;
  std::vector<std::string> columns{};           ///< with units
  std::vector<std::vector<ReportCell>> rows{};  ///< each with one cell for each column
};

/// The table as HTML. Texts are plain text and escaped here.
std::string to_html(const ReportTable& table);

/// Text in which no character is one of HTML's own.
std::string html_escaped(const std::string& text);

}  // namespace glissade::apps
