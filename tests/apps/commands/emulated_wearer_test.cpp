/// The wearer of an emulated glove who follows a script.

#include <chrono>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glissade/apps/commands/emulated_wearer.h>
#include <glissade/devices/hand_pose.h>
#include <glissade/devices/lcm_bus.h>
#include <glissade/files/csv_columns.h>

#include "temporary_folder.h"

namespace glissade::apps {
namespace {

using std::chrono::milliseconds;

std::string with_commas(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names)
    text += (text.empty() ? "" : ",") + name;
  return text;
}

class EmulatedWearer : public testing::Test {
 protected:
  /// All joints go from 0.1 to 0.5 rad, and the palm 0.4 m along x, between 1 and 3 seconds of the script's time.
  std::string closing_hand() const {
    std::ofstream file(folder.path("closing.csv"));
    file << with_commas(hand_trajectory_columns()) << '\n';
    for (const auto& [pose, angle] : {std::pair{"1,0", ",0.1"}, std::pair{"3,0.4", ",0.5"}}) {
      file << pose << ",0,0,1,0,0,0";
      for (std::size_t joint = 0; joint < hands::kJoints; ++joint)
        file << angle;
      file << '\n';
    }
    return folder.path("closing.csv");
  }

  const test_support::TemporaryFolder folder;
};

TEST_F(EmulatedWearer, BeginsWithTheScriptAfterTwoSeconds) {
  const bridges::EmulatedWearer wearer = wearer_of({.script = closing_hand()});
  EXPECT_THAT(wearer(milliseconds(0)), testing::Each(0.1));
  EXPECT_THAT(wearer(milliseconds(2000)), testing::Each(0.1));
  EXPECT_THAT(wearer(milliseconds(2500)), testing::Each(testing::DoubleNear(0.2, 1e-12)));
  EXPECT_THAT(wearer(milliseconds(9000)), testing::Each(0.5));
}

TEST_F(EmulatedWearer, SendsThePoseOfTheSameTime) {
  const auto bus = std::make_shared<devices::LcmBus>("memq://");
  devices::HandPoseSource source(bus, {.device = 7});
  const bridges::EmulatedWearer wearer = scripted_wearer(closing_hand(), bus, 7);
  EXPECT_THAT(wearer(milliseconds(2500)), testing::Each(testing::DoubleNear(0.2, 1e-12)));
  devices::GloveState state;
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (!source.join(state) && std::chrono::steady_clock::now() < deadline)
    std::this_thread::sleep_for(milliseconds(1));
  EXPECT_NEAR(state.X_WH.translation().x(), 0.1, 1e-12);
  EXPECT_NEAR(state.v_WH.x(), 0.2, 1e-9);
}

TEST_F(EmulatedWearer, SendsNinetyPosesASecond) {
  const auto bus = std::make_shared<devices::LcmBus>("memq://");
  devices::HandPoseSource source(bus, {.device = 7});
  const bridges::EmulatedWearer wearer = scripted_wearer(closing_hand(), bus, 7);
  for (milliseconds time{0}; time < milliseconds(200); ++time)
    wearer(time);
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (source.statistics().accepted < 18 && std::chrono::steady_clock::now() < deadline)
    std::this_thread::sleep_for(milliseconds(1));
  EXPECT_EQ(source.statistics().accepted, 18u);
}

TEST_F(EmulatedWearer, NeedsTheAnglesOfTheJoints) {
  std::ofstream(folder.path("poses.csv")) << "t_s,x_m,y_m,z_m,qw,qx,qy,qz\n0,0,0,0,1,0,0,0\n1,0,0,0,1,0,0,0\n";
  EXPECT_THAT([&] { wearer_of({.script = folder.path("poses.csv")}); },
              testing::ThrowsMessage<std::invalid_argument>(
                  testing::HasSubstr("poses.csv: the columns of the 22 joint angles are missing")));
}

}  // namespace
}  // namespace glissade::apps
