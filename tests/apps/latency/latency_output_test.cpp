#include <chrono>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <glissade/apps/latency/latency_output.h>
#include <glissade/apps/latency/latency_run.h>

#include "glissade_program.h"
#include "latency_figures.h"
#include "report_page.h"
#include "temporary_folder.h"

namespace glissade::apps {
namespace {

using test_support::given_latency_figures;
using testing::HasSubstr;

TEST(LatencyRatios, LatenessToBareLoopAndWholeWayToRoundTripPlusHalfTick) {
  const LatencyRatios ratios = latency_ratios(given_latency_figures().loaded);
  // 30 µs to 20 µs; the round trip of 100 µs and half a tick of 500 µs are two thirds of the 900 µs of the way.
  EXPECT_NEAR(ratios.lateness_p50, 1.5, 0.03);
  EXPECT_NEAR(ratios.lateness_p99, 1.5, 0.03);
  EXPECT_NEAR(ratios.udpm_p50, 1.5, 0.03);
}

TEST(LatencyOutput, TextTellsEachStageAndEachRatioWithItsTarget) {
  const std::string text = to_text(given_latency_figures());
  for (const char* stage : {"transport", "wait for the tick", "computation", "way back", "sample to force",
                            "haptic loop is late", "bare loop is late", "UDP round trip"})
    EXPECT_THAT(text, HasSubstr(stage));
  EXPECT_THAT(text, HasSubstr("lateness, loaded: p50 1.5"));
  EXPECT_THAT(text, HasSubstr("(target 1.2), p99 1.5"));
  EXPECT_THAT(text, HasSubstr("half a tick, idle: p50 "));
  EXPECT_THAT(text, HasSubstr("SCHED_FIFO was refused"));
}

TEST(LatencyOutput, JsonHasTheFiguresInMicroseconds) {
  const auto json = to_json(given_latency_figures());
  const auto& udpm = json.at("loaded").at("links").at(1);
  EXPECT_EQ(udpm.at("link"), "udpm://");
  EXPECT_EQ(udpm.at("whole_us").at("max"), 900.0);
  EXPECT_EQ(udpm.at("whole_us").at("count"), 1);
  EXPECT_EQ(udpm.at("lost"), 2);
  EXPECT_EQ(json.at("loaded").at("udp_round_trip_us").at("max"), 100.0);
  EXPECT_EQ(json.at("fifo"), false);
}

TEST(LatencyOutput, TheReportHasAHistogramOfEachLink) {
  const test_support::TemporaryFolder folder;
  std::ostringstream page;
  page << std::ifstream(write_latency_report(given_latency_figures(), folder.path("report"))).rdbuf();
  EXPECT_THAT(test_support::titles_of(page.str()),
              testing::IsSupersetOf({"udpm://, loaded: stages", "in process, idle: lateness"}));
  const nlohmann::json plot = test_support::plot_of(page.str(), "in process, idle: lateness");
  EXPECT_EQ(plot.at("x_label"), "duration [us]");
  EXPECT_EQ(plot.at("y_label"), "share [%]");
  EXPECT_TRUE(plot.at("steps")) << "bars";
  for (const nlohmann::json& series : plot.at("series"))
    EXPECT_THAT(series.at("y"), testing::Contains(100.0)) << "one sample is one bar of 100 %";
}

TEST(LatencyOutput, TheReportShowsASliceInThreeDimensions) {
  const test_support::TemporaryFolder folder;
  const auto page_of = [&](const LatencyFigures& figures) {
    std::ostringstream page;
    page << std::ifstream(write_latency_report(figures, folder.path("report"))).rdbuf();
    return page.str();
  };
  LatencyFigures figures = given_latency_figures();
  EXPECT_EQ(page_of(figures).find("id=\"report-frames\""), std::string::npos) << "nothing was kept";
  const auto slice = std::make_shared<SessionRecorder>(2, 1, 1);
  devices::HapticState state;
  slice->record(state);
  state.time = std::chrono::milliseconds(20);
  slice->record(state);
  figures.slice = slice;
  EXPECT_THAT(page_of(figures), HasSubstr("id=\"report-frames\""));
}

TEST(LatencyCommand, WrongDurationsAreRefused) {
  for (const std::string bad : {"0", "-1", "nan", "soon", "1e9"})
    test_support::expect_refused({"latency", "--seconds", bad}, {"--seconds"});
  test_support::expect_refused({"latency", "--report", "/dev/null/report"}, {"/dev/null/report"});
}

}  // namespace
}  // namespace glissade::apps
