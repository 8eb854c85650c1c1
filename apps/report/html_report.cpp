#include <cerrno>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <system_error>

#include <unistd.h>

#include <glissade/apps/report/html_report.h>

namespace glissade::apps {

namespace {

/// `c0` … `c5` are the colours of the lines in a plot, in its order.
constexpr const char* kStyle = R"(
:root {
  color-scheme: light dark;
  --page: #f6f7f9; --card: #ffffff; --text: #1d232b; --quiet: #5a6572; --grid: #e3e7ec; --axis: #8e99a6;
  --c0: #1f6fbf; --c1: #d3690a; --c2: #14876a; --c3: #8e4ec6; --c4: #c7343c; --c5: #6b7280;
}
@media (prefers-color-scheme: dark) {
  :root {
    --page: #12161b; --card: #1b2128; --text: #e6eaef; --quiet: #9aa6b3; --grid: #2c343d; --axis: #6b7785;
    --c0: #6cb0f5; --c1: #f2a25c; --c2: #4fcfa6; --c3: #c39af0; --c4: #f2787d; --c5: #a8b0bb;
  }
}
* { box-sizing: border-box; }
body { margin: 0; background: var(--page); color: var(--text); font: 15px/1.5 system-ui, sans-serif; }
main { max-width: 960px; margin: 0 auto; padding: 32px 20px 48px; }
h1 { font-size: 26px; line-height: 1.25; margin: 0 0 20px; }
h2 { font-size: 16px; margin: 0 0 6px; }
section { background: var(--card); border: 1px solid var(--grid); border-radius: 8px; padding: 16px 20px; margin: 0 0 18px; }
table { border-collapse: collapse; width: 100%; }
th, td { padding: 5px 0; border-bottom: 1px solid var(--grid); text-align: left; vertical-align: top; }
tr:last-child > * { border-bottom: 0; }
th { font-weight: 400; color: var(--quiet); width: 45%; padding-right: 16px; }
td { font-variant-numeric: tabular-nums; overflow-wrap: anywhere; }
.legend { display: flex; flex-wrap: wrap; gap: 2px 18px; margin: 0 0 4px; padding: 0; list-style: none; color: var(--quiet); }
.legend li::before {
  content: ""; display: inline-block; width: 18px; height: 3px; border-radius: 2px;
  margin-right: 7px; vertical-align: middle; background: currentColor;
}
.legend span { color: var(--text); }
svg { display: block; width: 100%; height: auto; font: 12px system-ui, sans-serif; }
svg text { fill: var(--quiet); }
svg text.name { fill: var(--text); font-size: 13px; }
.grid { stroke: var(--grid); }
.zero, .axis { stroke: var(--axis); }
.line { fill: none; stroke: currentColor; stroke-width: 1.4; stroke-linejoin: round; }
.c0 { color: var(--c0); } .c1 { color: var(--c1); } .c2 { color: var(--c2); }
.c3 { color: var(--c3); } .c4 { color: var(--c4); } .c5 { color: var(--c5); }
@media print { section { break-inside: avoid; } }
)";

std::string summary_table(const std::vector<std::pair<std::string, std::string>>& summary) {
  std::string html = "<section>\n<table>\n";
  for (const auto& [what, value] : summary) {
    html += "<tr><th scope=\"row\">" + html_escaped(what) + "</th><td>" + html_escaped(value) + "</td></tr>\n";
  }
  return html + "</table>\n</section>\n";
}

/// Names and colours of the lines; a single line needs none, because the plot's title names it.
std::string legend(const std::vector<PlotSeries>& series) {
  if (series.size() < 2) return "";
  std::string html = "<ul class=\"legend\">\n";
  for (std::size_t i = 0; i < series.size(); ++i) {
    html += "<li class=\"c" + std::to_string(i % kPlotColors) + "\"><span>" + html_escaped(series[i].name) +
            "</span></li>\n";
  }
  return html + "</ul>\n";
}

}  // namespace

std::string html_report(const Report& report) {
  const std::string title = html_escaped(report.title);
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
      title + "</title>\n<style>" + kStyle + "</style>\n</head>\n<body>\n<main>\n<h1>" + title + "</h1>\n";
  if (!report.summary.empty()) html += summary_table(report.summary);
  for (const Plot& plot : report.plots) {
    html += "<section>\n<h2>" + html_escaped(plot.title) + "</h2>\n" + legend(plot.series) + svg_plot(plot) +
            "</section>\n";
  }
  return html + "</main>\n</body>\n</html>\n";
}

void prepare_report_folder(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw std::invalid_argument(folder + ": cannot make this folder: " + error.message());
  if (access(folder.c_str(), W_OK | X_OK) != 0) {
    throw std::invalid_argument(folder + ": nothing can be written there: " + std::generic_category().message(errno));
  }
}

std::string write_html_report(const Report& report, const std::string& folder) {
  prepare_report_folder(folder);
  std::string path = (std::filesystem::path(folder) / "index.html").string();
  std::ofstream file(path, std::ios::binary);
  if (!file) throw std::invalid_argument(path + ": cannot be written: " + std::generic_category().message(errno));
  file << html_report(report) << std::flush;
  if (!file) throw std::runtime_error(path + ": not everything could be written");
  return path;
}

}  // namespace glissade::apps
