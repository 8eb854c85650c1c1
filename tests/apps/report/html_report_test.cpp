#include <fstream>
#include <limits>
#include <sstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <glissade/apps/report/html_report.h>

#include "expect_bad_input.h"
#include "report_page.h"
#include "temporary_folder.h"

namespace glissade::apps {
namespace {

using testing::HasSubstr;
using testing::Not;

Report small_report() {
  return {"Motor <into> door",
          {{"greatest force", "12.5 N"}, {"goal reached", "yes & held"}},
          {{"Force on the hand", "time [s]", "force [N]", {{"x", {0, 1}, {0, 1}}, {"y", {0, 1}, {1, 0}}}}}};
}

TEST(HtmlReport, ShowsTitleAndSummary) {
  const std::string html = html_report(small_report());
  EXPECT_THAT(html, HasSubstr("<title>Motor &lt;into&gt; door</title>"));
  EXPECT_THAT(html, HasSubstr("<h1 id=\"title\">Motor &lt;into&gt; door</h1>"));
  EXPECT_THAT(html, HasSubstr("<td>12.5 N</td>"));
  EXPECT_THAT(html, HasSubstr("yes &amp; held"));
}

TEST(HtmlReport, NeedsNoNetwork) {
  const std::string html = html_report(small_report());
  for (const char* reference : {"<script src", "rel=\"stylesheet\"", "href=\"http", "url(", "@import"})
    EXPECT_THAT(html, Not(HasSubstr(reference)));
}

TEST(HtmlReport, ATableKeepsNumbersToSortBeside) {
  Report report = small_report();
  EXPECT_THAT(html_report(report), Not(HasSubstr("<table class=\"rows\">")));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  report.table = {"Ways", {"way", "force [N]"}, {{{"a<b"}, {"0.33", 1.0 / 3.0}}, {{"c"}, {"", nan}}}};
  const std::string html = html_report(report);
  EXPECT_THAT(html, HasSubstr("<th scope=\"col\"><button>force [N]</button></th>"));
  EXPECT_THAT(html, HasSubstr("<tr><td>a&lt;b</td><td class=\"number\" data-number=\"0.333333333\">0.33</td></tr>"));
  EXPECT_THAT(html, HasSubstr("<tr><td>c</td><td class=\"number\"></td></tr>"));
}

TEST(HtmlReport, WithAReplayHoldsItsData) {
  Report report = small_report();
  EXPECT_THAT(html_report(report), Not(HasSubstr("id=\"report-frames\"")));
  report.replay = Replay{"glTF", std::string("\x01\x02\x03", 3)};
  const std::string html = html_report(report);
  EXPECT_THAT(html, HasSubstr("id=\"report-model\">Z2xURg==<"));  // base64 of glTF
  EXPECT_THAT(html, HasSubstr("id=\"report-frames\">AQID<"));
  EXPECT_THAT(html, Not(HasSubstr("id=\"report-whole-model\"")));
  report.replay->whole_model = "glTF";
  EXPECT_THAT(html_report(report), HasSubstr("id=\"report-whole-model\">Z2xURg==<"));
}

TEST(HtmlReport, APlotHasItsLinesLabelsAndGaps) {
  Report report = small_report();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  report.plots[0].series[0] = {"x", {0.0, 0.001, 1000.001}, {1.0 / 3.0, nan, -2e-9}};
  report.plots.push_back({.title = "hits", .x_label = "force [N]", .y_label = "hits", .counts = true});
  report.plots.push_back({.title = "States", .x_label = "time [s]", .words = {"free", "sliding"}});
  const nlohmann::json plots = test_support::plots_of(html_report(report));
  ASSERT_EQ(plots.size(), 3u);
  const nlohmann::json& force = plots[0];
  EXPECT_EQ(force.at("title"), "Force on the hand");
  EXPECT_EQ(force.at("x_label"), "time [s]");
  EXPECT_EQ(force.at("y_label"), "force [N]");
  EXPECT_EQ(force.at("over_time"), true);
  EXPECT_EQ(force.at("series")[0].at("x"), nlohmann::json({0.0, 0.001, 1000.001}));
  EXPECT_EQ(force.at("series")[0].at("y"), nlohmann::json({0.333333, nullptr, -2e-9}));
  EXPECT_EQ(force.at("series")[1].at("name"), "y");
  EXPECT_EQ(plots[1].at("over_time"), false);
  EXPECT_EQ(plots[1].at("counts"), true);
  EXPECT_EQ(plots[1].at("words"), nlohmann::json::array());
  EXPECT_EQ(plots[2].at("words"), nlohmann::json({"free", "sliding"}));
}

TEST(HtmlReport, NamesAreEscapedInPlotData) {
  Report report = small_report();
  report.plots[0].title = "</script><!--<script>";
  report.plots[0].series[0].name = "no UTF-8: \xff.csv";
  const nlohmann::json plots = test_support::plots_of(html_report(report));
  EXPECT_EQ(plots.at(0).at("title"), report.plots[0].title);
  EXPECT_THAT(plots.at(0).at("series")[0].at("name").get<std::string>(), testing::EndsWith(".csv"));
}

TEST(HtmlReport, IsWrittenIntoAFolderThatNeedNotExist) {
  const test_support::TemporaryFolder folder;
  const std::string path = write_html_report(small_report(), folder.path("deep/report"));
  EXPECT_EQ(path, folder.path("deep/report/index.html"));
  std::ostringstream written;
  written << std::ifstream(path).rdbuf();
  EXPECT_EQ(written.str(), html_report(small_report()));
}

TEST(HtmlReport, FolderNamedLikeAPageIsRefused) {
  const test_support::TemporaryFolder folder;
  test_support::expect_bad_input([&] { write_html_report(small_report(), folder.path("x.html")); },
                                 {"x.html", "a folder", "name it '", "/x'"});
}

TEST(HtmlReport, AFolderThatCannotBeMadeIsNamed) {
  const test_support::TemporaryFolder folder;
  const std::string file = folder.write("file", "");
  test_support::expect_bad_input([&] { write_html_report(small_report(), file + "/report"); }, {file + "/report"});
}

}  // namespace
}  // namespace glissade::apps
