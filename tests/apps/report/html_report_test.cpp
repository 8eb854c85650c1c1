#include <fstream>
#include <sstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glissade/apps/report/html_report.h>

#include "expect_bad_input.h"
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

int count(const std::string& text, const std::string& part) {
  int result = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++result;
  return result;
}

TEST(HtmlReport, ShowsTitleSummaryPlotsAndLegend) {
  const std::string html = html_report(small_report());
  EXPECT_THAT(html, HasSubstr("<h1>Motor &lt;into&gt; door</h1>"));
  EXPECT_THAT(html, HasSubstr("<td>12.5 N</td>"));
  EXPECT_THAT(html, HasSubstr("yes &amp; held"));
  EXPECT_THAT(html, HasSubstr("<h2>Force on the hand</h2>"));
  EXPECT_THAT(html, HasSubstr("<li class=\"c1\"><span>y</span></li>"));
}

TEST(HtmlReport, NeedsNoNetworkAndNoScript) {
  const std::string html = html_report(small_report());
  EXPECT_THAT(html, Not(HasSubstr("<script")));
  EXPECT_THAT(html, Not(HasSubstr("src=")));
  EXPECT_THAT(html, Not(HasSubstr("href=")));
  EXPECT_THAT(html, Not(HasSubstr("url(")));
  EXPECT_THAT(html, Not(HasSubstr("@import")));
}

TEST(HtmlReport, WithAReplayHoldsItsDataAndStillNeedsNoNetwork) {
  Report report = small_report();
  report.replay = Replay{"glTF", std::string("\x01\x02\x03", 3)};
  const std::string html = html_report(report);
  EXPECT_THAT(html, HasSubstr("id=\"report-model\">Z2xURg==<"));  // base64 of glTF
  EXPECT_THAT(html, HasSubstr("id=\"report-frames\">AQID<"));
  EXPECT_THAT(html, Not(HasSubstr("id=\"report-whole-model\"")));
  report.replay->whole_model = "glTF";
  EXPECT_THAT(html_report(report), HasSubstr("id=\"report-whole-model\">Z2xURg==<"));
  EXPECT_THAT(html, HasSubstr("<h1 id=\"title\">Motor &lt;into&gt; door</h1>"));
  EXPECT_THAT(html, HasSubstr("<td>12.5 N</td>"));
  EXPECT_THAT(html, HasSubstr("<canvas"));
  EXPECT_THAT(html, Not(HasSubstr("<script src")));
  EXPECT_THAT(html, Not(HasSubstr("<!--")));  // every mark is filled in
  EXPECT_THAT(html, Not(HasSubstr("rel=\"stylesheet\"")));
}

TEST(HtmlReport, APlotOverTimeTellsWhereItsTimesLie) {
  const std::string html = html_report(small_report());
  EXPECT_THAT(html, HasSubstr("data-from=\"0.00\" data-to=\"1.00\" data-left="));
  Report other = small_report();
  other.plots[0].x_label = "force [N]";
  EXPECT_THAT(html_report(other), Not(HasSubstr("data-from")));
}

TEST(HtmlReport, AStripHasItsWordsAndATimeAxis) {
  Report report{"strips", {}, {}};
  report.strips.push_back({"States", {"free", "sliding", "never"}, {{"peg", {{0.0, 1.5, 0}, {1.5, 2.0, 1}}}}});
  const std::string html = html_report(report);
  EXPECT_THAT(html, HasSubstr("<h2>States</h2>"));
  EXPECT_THAT(html, HasSubstr("<li class=\"c1\"><span>sliding</span></li>"));
  EXPECT_THAT(html, Not(HasSubstr("never")));
  EXPECT_THAT(html, HasSubstr(">peg</text>"));
  EXPECT_THAT(html, HasSubstr("data-from=\"0.00\" data-to=\"2.00\""));
  EXPECT_EQ(count(html, "<rect class=\"span c0\""), 1);
  EXPECT_EQ(count(html, "<rect class=\"span c1\""), 1);
}

TEST(HtmlReport, EveryElementIsClosed) {
  const std::string html = html_report(small_report());
  for (const std::string tag :
       {"html", "head", "body", "main", "section", "table", "tr", "th", "td", "svg", "text", "ul", "li"}) {
    const int opened = count(html, "<" + tag + ">") + count(html, "<" + tag + " ");
    EXPECT_GT(opened, 0) << tag;
    EXPECT_EQ(opened, count(html, "</" + tag + ">")) << tag;
  }
}

TEST(HtmlReport, IsWrittenIntoAFolderThatNeedNotExist) {
  const test_support::TemporaryFolder folder;
  const std::string path = write_html_report(small_report(), folder.path("deep/report"));
  EXPECT_EQ(path, folder.path("deep/report/index.html"));
  std::ostringstream written;
  written << std::ifstream(path).rdbuf();
  EXPECT_EQ(written.str(), html_report(small_report()));
}

TEST(HtmlReport, AFolderIsNotNamedAsAPage) {
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
