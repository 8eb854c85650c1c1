/// `glissade run` and `glissade glove` as two processes over UDP multicast, in a network namespace of their own.

#include <chrono>
#include <cstdlib>
#include <future>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "glissade_program.h"
#include "temporary_folder.h"

namespace glissade::apps {
namespace {

constexpr const char* kUrl = "udpm://239.255.76.67:7667?ttl=0";

TEST(TwoProcesses, AGloveInOneProcessCarriesThePartInTheOtherToItsSeat) {
  ASSERT_NE(std::getenv("GLISSADE_NETWORK_NAMESPACE"), nullptr) << "would send outside of this test";
  const test_support::TemporaryFolder folder;
  const std::string scene = folder.write("scene.yaml",
                                         "objects:\n"
                                         "  - {name: plate, shape: {type: plate, size_x_m: 0.5, size_y_m: 0.5}}\n"
                                         "  - name: box\n"
                                         "    movable: true\n"
                                         "    shape: {type: box, size_x_m: 0.1, size_y_m: 0.06, size_z_m: 0.04}\n"
                                         "    pose: {position_m: [0, 0, 0.03]}\n"
                                         "goal: {position_m: [0.05, 0, 0.02]}\n");
  const std::string script = folder.write("hand.csv",
                                          "t_s,x_m,y_m,z_m,qw,qx,qy,qz\n"
                                          "0,0,0,0.03,1,0,0,0\n"
                                          "0.5,0,0,0.01,1,0,0,0\n"
                                          "1.5,0.05,0,0.01,1,0,0,0\n"
                                          "4,0.05,0,0.01,1,0,0,0\n");
  // The glove waits for the server, so the order does not matter; the server ends first, while the hand still presses.
  auto glove = std::async(std::launch::async, [&] {
    return test_support::glissade({"glove", "--lcm", kUrl, "--script", script});
  });
  const test_support::ProgramResult server =
      test_support::glissade({"run", scene, "--lcm", kUrl, "--seconds", "3", "--json"});
  const test_support::ProgramResult hand = glove.get();

  ASSERT_EQ(server.exit_code, 0) << server.standard_error;
  ASSERT_EQ(hand.exit_code, 0) << hand.standard_error;
  const nlohmann::json summary = nlohmann::json::parse(server.standard_output);
  EXPECT_EQ(summary["ticks"], 3000);
  EXPECT_EQ(summary["colliding_poses"], 0);
  EXPECT_EQ(summary["seat_reached"], true);
  EXPECT_GT(summary["contact_fraction"], 0.3);
  EXPECT_GT(summary["force_max_N"], 1.0);
  EXPECT_NE(hand.standard_output.find(" 0 refused)"), std::string::npos) << hand.standard_output;
  EXPECT_EQ(hand.standard_output.find("greatest force 0 N"), std::string::npos) << hand.standard_output;
}

TEST(TwoProcesses, AServerThatCannotStartSaysNothingOfWaiting) {
  ASSERT_NE(std::getenv("GLISSADE_NETWORK_NAMESPACE"), nullptr) << "would send outside of this test";
  const test_support::TemporaryFolder folder;
  const std::string scene = folder.write("stuck.yaml",
                                         "objects:\n"
                                         "  - {name: plate, shape: {type: plate}}\n"
                                         "  - {name: box, movable: true, shape: {type: box}}\n");
  test_support::expect_refused({"run", scene, "--lcm", kUrl}, {"stuck.yaml", "'box'", "collides"});
}

}  // namespace
}  // namespace glissade::apps
