/// `glissade view` in a process of its own shows what a demonstration in another one publishes.

#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <regex>
#include <string>
#include <thread>

#include <gtest/gtest.h>

#include "glissade_program.h"
#include "page_client.h"
#include "temporary_folder.h"

namespace glissade::apps {
namespace {

constexpr const char* kViewUrl = "udpm://239.255.76.67:7667?ttl=0";

/// The port that `glissade view` tells.
std::uint16_t port_of(const test_support::Process& view) {
  for (std::smatch match;;) {
    const std::string text = view.standard_error();
    if (std::regex_search(text, match, std::regex("http://127\\.0\\.0\\.1:([0-9]+)/")))
      return static_cast<std::uint16_t>(std::stoi(match[1]));
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

TEST(ViewInAnotherProcess, ShowsTheTicksOfTheServer) {
  ASSERT_NE(std::getenv("GLISSADE_NETWORK_NAMESPACE"), nullptr) << "would send outside of this test";
  test_support::Process view({GLISSADE_PROGRAM, "view", "--lcm", kViewUrl, "--port", "0"});
  const std::uint16_t port = port_of(view);
  test_support::Browser browser(port);
  EXPECT_EQ(browser.ask(boost::beast::http::verb::get, "/model.glb").body().substr(0, 4), "glTF");
  test_support::PageViewer viewer(port);
  test_support::Process demo({GLISSADE_PROGRAM, "demo", "--lcm", kViewUrl, "--seconds", "2"});
  double last = 0.0;
  for (int i = 0; i < 20; ++i) {
    const double sequence = viewer.next().first;
    EXPECT_GT(sequence, last);
    last = sequence;
    viewer.acknowledge();
  }
  EXPECT_EQ(demo.wait().exit_code, 0);
  view.signal(SIGINT);
  const test_support::ProgramResult result = view.wait();
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.standard_error.find("is it the server's scene?"), std::string::npos) << result.standard_error;
}

TEST(ViewInAnotherProcess, SaysThatNoServerIsHeard) {
  ASSERT_NE(std::getenv("GLISSADE_NETWORK_NAMESPACE"), nullptr) << "would send outside of this test";
  const test_support::ProgramResult result =
      test_support::glissade({"view", "--lcm", kViewUrl, "--port", "0", "--seconds", "0.2"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_NE(result.standard_error.find("no server has been heard on HAPTIC_STATE at " + std::string(kViewUrl) +
                                       "; start one, such as: glissade demo --lcm '" + kViewUrl + "'\n"),
            std::string::npos)
      << result.standard_error;
}

TEST(ViewInAnotherProcess, SaysWhenTheServerHasAnotherScene) {
  ASSERT_NE(std::getenv("GLISSADE_NETWORK_NAMESPACE"), nullptr) << "would send outside of this test";
  const test_support::TemporaryFolder folder;
  const std::string scene =
      folder.write("scene.yaml",
                   "objects:\n"
                   "  - {name: one, movable: true, shape: {type: box}}\n"
                   "  - {name: two, movable: true, shape: {type: box}, pose: {position_m: [1, 0, 0]}}\n");
  test_support::Process view({GLISSADE_PROGRAM, "view", scene, "--lcm", kViewUrl, "--port", "0"});
  port_of(view);
  test_support::Process demo({GLISSADE_PROGRAM, "demo", "--lcm", kViewUrl, "--seconds", "1"});
  EXPECT_EQ(demo.wait().exit_code, 0);
  view.signal(SIGINT);
  EXPECT_NE(view.wait().standard_error.find("the server moves 1 parts, " + scene + " has 2"), std::string::npos);
}

TEST(ViewInAnotherProcess, SaysWhenTheServerHasAnotherPart) {
  ASSERT_NE(std::getenv("GLISSADE_NETWORK_NAMESPACE"), nullptr) << "would send outside of this test";
  const test_support::TemporaryFolder folder;
  const std::string scene = folder.write(
      "scene.yaml", "objects: [{name: one, movable: true, shape: {type: box}, compliance_point_m: [0, 0, 0.03]}]\n");
  test_support::Process view({GLISSADE_PROGRAM, "view", scene, "--lcm", kViewUrl, "--port", "0"});
  port_of(view);
  test_support::Process demo({GLISSADE_PROGRAM, "demo", "--lcm", kViewUrl, "--seconds", "1"});
  EXPECT_EQ(demo.wait().exit_code, 0);
  view.signal(SIGINT);
  EXPECT_NE(view.wait().standard_error.find("is it the server's scene?"), std::string::npos);
}

}  // namespace
}  // namespace glissade::apps
