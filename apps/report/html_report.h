#pragma once

/// The viewer's page with figures and plots in it, in one file: no network, legible on light and dark screens and on
/// paper. With a replay, it also shows the run in three dimensions; a click on a plot over time goes to that moment.

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <glissade/apps/report/plot.h>
#include <glissade/apps/report/report_table.h>

namespace glissade::apps {

/// A run to look at: `viewer::scene_model`, and frames of `viewer::FrameMaker`, each after its length in 4 bytes.
struct Replay {
  std::string model;
  std::string frames;
  std::string whole_model{};  ///< of more triangles, for pictures at rest; empty: `model` has all of the scene
};

/// The content of the page, from top to bottom.
struct Report {
  std::string title;
  std::vector<std::pair<std::string, std::string>> summary;  ///< rows of a table: name, and value with unit
  std::vector<Plot> plots;
  ReportTable table{};             ///< below the summary
  std::optional<Replay> replay{};  ///< above the summary
  std::string study{};             ///< data of a study as JSON, which the page draws in place of plots; may be empty
};

/// The page as HTML; texts are plain text and escaped here.
std::string html_report(const Report& report);

/// The page in this folder; empty without a folder.
std::string report_page(const std::string& folder);

/// Creates `folder` if necessary. Call it before a run, so that no run ends without a place for its report.
/// Throws std::invalid_argument, naming the folder, when it cannot be created or is not writable, or is no folder and
/// is named as a page (.html), and as `check_output` does for the page.
void prepare_report_folder(const std::string& folder);

/// Writes the page to `folder`/index.html, creates the folder if necessary, and returns that path.
/// Throws std::invalid_argument when the folder or the file cannot be created, std::runtime_error when writing fails.
std::string write_html_report(const Report& report, const std::string& folder);

}  // namespace glissade::apps
