#include <cerrno>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>

#include <sodium.h>
#include <unistd.h>

#include <glissade/apps/report/html_report.h>
#include <glissade/apps/text.h>
#include <glissade/files/file_checks.h>
#include <glissade/viewer/page.h>

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
.paper { max-width: 960px; margin: 0 auto; padding: 32px 20px 48px; }
h1 { font-size: 26px; line-height: 1.25; margin: 0 0 20px; }
.paper + .paper { padding-top: 0; }
.paper h2 { font-size: 16px; margin: 0 0 6px; }
.paper section { background: var(--card); border: 1px solid var(--grid); border-radius: 8px; padding: 16px 20px; margin: 0 0 18px; }
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
.paper svg { display: block; width: 100%; height: auto; font: 12px system-ui, sans-serif; }
.paper svg text { fill: var(--quiet); }
.paper svg text.name { fill: var(--text); font-size: 13px; }
.grid { stroke: var(--grid); }
.zero, .axis { stroke: var(--axis); }
.span { fill: currentColor; }
.line { fill: none; stroke: currentColor; stroke-width: 1.4; stroke-linejoin: round; }
.c0 { color: var(--c0); } .c1 { color: var(--c1); } .c2 { color: var(--c2); }
.c3 { color: var(--c3); } .c4 { color: var(--c4); } .c5 { color: var(--c5); }
@media (max-width: 760px) {
  .paper section { overflow-x: scroll; }
  .paper svg { min-width: 690px; }
}
@media print { .paper section { break-inside: avoid; } }
)";

std::string summary_table(const std::vector<std::pair<std::string, std::string>>& summary) {
  std::string html = "<section>\n<table>\n";
  for (const auto& [what, value] : summary) {
    html += "<tr><th scope=\"row\">" + html_escaped(what) + "</th><td>" + html_escaped(value) + "</td></tr>\n";
  }
  return html + "</table>\n</section>\n";
}

/// Names with the colours of their numbers; an empty name is left out.
std::string legend(const std::vector<std::string>& names) {
  std::string html = "<ul class=\"legend\">\n";
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i].empty()) continue;
    html += "<li class=\"c" + std::to_string(i % kPlotColors) + "\"><span>" + html_escaped(names[i]) + "</span></li>\n";
  }
  return html + "</ul>\n";
}

/// Names and colours of the lines; a single line needs none, because the plot's title names it.
std::string legend_of(const Plot& plot) {
  std::vector<std::string> names;
  for (const PlotSeries& series : plot.series)
    names.push_back(series.name);
  return names.size() < 2 ? "" : legend(names);
}

std::string legend_of(const StripChart& chart) {
  std::vector<std::string> names(chart.words.size());
  for (const Strip& strip : chart.strips) {
    for (const StripSpan& span : strip.spans)
      names[span.word] = chart.words[span.word];
  }
  return legend(names);
}

/// Puts `text` in the place of the mark.
void fill_in(std::string& page, std::string_view mark, std::string_view text) {
  const std::size_t place = page.find(mark);
  if (place == std::string::npos) throw std::logic_error("the viewer's page has no " + std::string(mark));
  page.replace(place, mark.size(), text);
}

std::string to_base64(const std::string& bytes) {
  constexpr int kVariant = sodium_base64_VARIANT_ORIGINAL;
  std::string text(sodium_base64_encoded_len(bytes.size(), kVariant), '\0');
  sodium_bin2base64(text.data(), text.size(), reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(),
                    kVariant);
  text.pop_back();  // the zero at the end
  return text;
}

std::string data_element(const char* id, const std::string& bytes) {
  return "<script type=\"application/octet-stream\" id=\"" + std::string(id) + "\">" + to_base64(bytes) + "</script>\n";
}

/// The viewer's page, which finds the data of the replay in itself.
std::string page_with_replay(const std::string& title, const std::string& summary, const std::string& plots,
                             const Replay& replay) {
  const auto paper = [](const std::string& content) { return "<div class=\"paper\">\n" + content + "</div>\n"; };
  std::string page(viewer::page());
  fill_in(page, "<!--report-style-->", "<style>" + std::string(kStyle) + "</style>");
  fill_in(page, "<title>Glissade</title>", "<title>" + title + "</title>");
  fill_in(page, "<h1 id=\"title\">Glissade</h1>", "<h1 id=\"title\">" + title + "</h1>");
  fill_in(page, "<!--summary-->", paper(summary));
  fill_in(page, "<!--plots-->", paper(plots));
  std::string data = data_element("report-model", replay.model) + data_element("report-frames", replay.frames);
  if (!replay.whole_model.empty()) data += data_element("report-whole-model", replay.whole_model);
  fill_in(page, "<!--data-->", data);
  return page;
}

}  // namespace

std::string html_report(const Report& report) {
  const std::string title = html_escaped(report.title);
  const std::string summary = report.summary.empty() ? "" : summary_table(report.summary);
  std::string plots;
  for (const Plot& plot : report.plots) {
    plots +=
        "<section>\n<h2>" + html_escaped(plot.title) + "</h2>\n" + legend_of(plot) + svg_plot(plot) + "</section>\n";
  }
  for (const StripChart& chart : report.strips) {
    plots += "<section>\n<h2>" + html_escaped(chart.title) + "</h2>\n" + legend_of(chart) + svg_strips(chart) +
             "</section>\n";
  }
  if (report.replay) return page_with_replay(title, summary, plots, *report.replay);
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
         title + "</title>\n<style>" + kStyle + "</style>\n</head>\n<body>\n<main class=\"paper\">\n<h1>" + title +
         "</h1>\n" + summary + plots + "</main>\n</body>\n</html>\n";
}

std::string report_page(const std::string& folder) {
  return folder.empty() ? "" : (std::filesystem::path(folder) / "index.html").string();
}

void prepare_report_folder(const std::string& folder) {
  std::error_code error;
  std::filesystem::path path(folder);
  if (path.extension() == ".html" && !std::filesystem::is_directory(path, error)) {
    throw std::invalid_argument("--report: " + in_quotes(folder) +
                                " would be a folder, with the report as index.html in it; name it " +
                                in_quotes(path.replace_extension().string()));
  }
  std::filesystem::create_directories(folder, error);
  if (error) throw std::invalid_argument(folder + ": cannot make this folder: " + error.message());
  if (access(folder.c_str(), W_OK | X_OK) != 0) {
    throw std::invalid_argument(folder + ": nothing can be written there: " + std::generic_category().message(errno));
  }
  check_output(report_page(folder));
}

std::string write_html_report(const Report& report, const std::string& folder) {
  prepare_report_folder(folder);
  std::string path = report_page(folder);
  std::ofstream file = open_output(path);
  file << html_report(report) << std::flush;
  if (!file) throw std::runtime_error(path + ": not everything could be written");
  return path;
}

}  // namespace glissade::apps
