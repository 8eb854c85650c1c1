#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include <nlohmann/json.hpp>
#include <sodium.h>
#include <unistd.h>

#include <glissade/apps/report/html_report.h>
#include <glissade/apps/text.h>
#include <glissade/files/file_checks.h>
#include <glissade/viewer/page.h>

namespace glissade::apps {

namespace {

std::string summary_table(const std::vector<std::pair<std::string, std::string>>& summary) {
  if (summary.empty()) return "";
  std::string html = "<section>\n<table class=\"summary\">\n";
  for (const auto& [what, value] : summary) {
    html += "<tr><th scope=\"row\">" + html_escaped(what) + "</th><td>" + html_escaped(value) + "</td></tr>\n";
  }
  return html + "</table>\n</section>\n";
}

/// Numbers with so many digits, which keeps the page small. One that is not finite becomes null, a gap.
nlohmann::json numbers_json(const std::vector<double>& values, int digits) {
  nlohmann::json json = nlohmann::json::array();
  for (const double value : values) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.*g", digits, value);
    json.push_back(std::strtod(text.data(), nullptr));
  }
  return json;
}

nlohmann::json series_json(const PlotSeries& series) {
  constexpr int kDigitsOfTime = 9;  // no two points at one time
  constexpr int kDigits = 6;
  return {{"name", series.name}, {"x", numbers_json(series.x, kDigitsOfTime)}, {"y", numbers_json(series.y, kDigits)}};
}

nlohmann::json plot_json(const Plot& plot) {
  nlohmann::json json{{"title", plot.title},     {"x_label", plot.x_label},
                      {"y_label", plot.y_label}, {"counts", plot.counts},
                      {"steps", plot.steps},     {"over_time", plot.x_label == kTimeLabel},
                      {"words", plot.words},     {"series", nlohmann::json::array()}};
  for (const PlotSeries& series : plot.series)
    json["series"].push_back(series_json(series));
  return json;
}

/// Data of the page. What no page takes for the end of the element.
std::string json_element(const char* id, const std::string& json) {
  std::string html = "<script type=\"application/json\" id=\"" + std::string(id) + "\">";
  for (const char character : json) {
    if (character == '<') {
      html += "\\u003c";
    } else {
      html += character;
    }
  }
  return html + "</script>\n";
}

/// Names of files may be no UTF-8.
std::string plots_element(const Report& report) {
  nlohmann::json json = nlohmann::json::array();
  for (const Plot& plot : report.plots)
    json.push_back(plot_json(plot));
  return json_element("report-plots", json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
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

}  // namespace

std::string html_report(const Report& report) {
  const std::string title = html_escaped(report.title);
  std::string content = "<div class=\"paper\">\n" + summary_table(report.summary) + to_html(report.table) +
                        "<div id=\"study\"></div>\n<div id=\"plots\"></div>\n<div id=\"study-rows\"></div>\n</div>\n" +
                        plots_element(report);
  if (!report.study.empty()) content += json_element("report-study", report.study);
  if (report.replay) {
    content +=
        data_element("report-model", report.replay->model) + data_element("report-frames", report.replay->frames);
    if (!report.replay->whole_model.empty()) content += data_element("report-whole-model", report.replay->whole_model);
  }
  std::string page(viewer::page());
  fill_in(page, "<title>Glissade</title>", "<title>" + title + "</title>");
  fill_in(page, "<h1 id=\"title\">Glissade</h1>", "<h1 id=\"title\">" + title + "</h1>");
  fill_in(page, "<!--report-->", content);
  return page;
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
  const std::string partial = path + ".partial";
  std::ofstream file = open_output(partial);
  file << html_report(report);
  file.close();
  if (!file) throw std::runtime_error(partial + ": not everything could be written");
  std::filesystem::rename(partial, path);
  return path;
}

}  // namespace glissade::apps
