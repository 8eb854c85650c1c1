#pragma once

/// A page of figures and plots in one file: no scripts, no network, legible on light and dark screens and on paper.

#include <string>
#include <utility>
#include <vector>

#include <glissade/apps/svg_plot.h>

namespace glissade::apps {

/// What the page shows, from top to bottom.
struct Report {
  std::string title;
  std::vector<std::pair<std::string, std::string>> summary;  ///< rows of a table: what, and its value with unit
  std::vector<Plot> plots;
};

/// The page as HTML; texts are plain text and escaped here.
std::string html_report(const Report& report);

/// Makes `folder` where needed, so that a run need not end before it turns out that its report has no place.
/// Throws std::invalid_argument, naming the folder, when it cannot be made or nothing can be written there.
void prepare_report_folder(const std::string& folder);

/// Writes the page to `folder`/index.html, making the folder where needed, and returns that path.
/// Throws std::invalid_argument when the folder or the file cannot be made, std::runtime_error when writing fails.
std::string write_html_report(const Report& report, const std::string& folder);

}  // namespace glissade::apps
