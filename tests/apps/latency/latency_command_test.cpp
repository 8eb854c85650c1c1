/// `glissade latency` with its second process over UDP multicast, in a network namespace of its own.

#include <cstdlib>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "glissade_program.h"
#include "temporary_folder.h"

namespace glissade::apps {
namespace {

TEST(LatencyCommand, AShortRunMeasuresEveryLinkIdleAndLoaded) {
  ASSERT_NE(std::getenv("GLISSADE_NETWORK_NAMESPACE"), nullptr) << "would send outside of this test";
  const test_support::TemporaryFolder folder;
  const test_support::ProgramResult result =
      test_support::glissade({"latency", "--seconds", "1", "--json", "--report", folder.path("report")});
  ASSERT_EQ(result.exit_code, 0) << result.standard_error;
  EXPECT_EQ(result.standard_error, "") << "no progress bar without a terminal";
  const nlohmann::json json = nlohmann::json::parse(result.standard_output);
  for (const char* load : {"idle", "loaded"}) {
    ASSERT_EQ(json[load]["links"].size(), 3U);
    for (const nlohmann::json& link : json[load]["links"]) {
      SCOPED_TRACE(link["link"]);
      EXPECT_GT(link["whole_us"]["count"], 0);
      EXPECT_GT(link["haptic_lateness_us"]["count"], 0);
      EXPECT_GT(link["bare_lateness_us"]["count"], 0);
      // Each sample is measured before it arrives, and waits for a tick.
      EXPECT_GT(link["whole_us"]["max"], link["computation_us"]["p50"]);
    }
    EXPECT_GT(json[load]["udp_round_trip_us"]["count"], 0);
  }
  std::ostringstream page;
  page << std::ifstream(folder.path("report/index.html")).rdbuf();
  EXPECT_NE(page.str().find("id=\"report-frames\""), std::string::npos) << "a slice in three dimensions";
}

}  // namespace
}  // namespace glissade::apps
