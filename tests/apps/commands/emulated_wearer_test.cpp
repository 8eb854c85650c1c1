/// The wearer of an emulated glove who follows a script.

#include <chrono>
#include <fstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glissade/apps/commands/emulate.h>
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
  /// All joints go from 0.1 to 0.5 rad, between 1 and 3 seconds of the script's time.
  std::string closing_hand() const {
    std::ofstream file(folder.path("closing.csv"));
    file << with_commas(hand_trajectory_columns()) << '\n';
    for (const auto& [time, angle] : {std::pair{"1", ",0.1"}, std::pair{"3", ",0.5"}}) {
      file << time << ",0,0,0,1,0,0,0";
      for (std::size_t joint = 0; joint < hands::kJoints; ++joint)
        file << angle;
      file << '\n';
    }
    return folder.path("closing.csv");
  }

  const test_support::TemporaryFolder folder;
};

TEST_F(EmulatedWearer, BeginsWithTheScriptAfterTwoSeconds) {
  const bridges::EmulatedWearer wearer = wearer_of(closing_hand());
  EXPECT_THAT(wearer(milliseconds(0)), testing::Each(0.1));
  EXPECT_THAT(wearer(milliseconds(2000)), testing::Each(0.1));
  EXPECT_THAT(wearer(milliseconds(2500)), testing::Each(testing::DoubleNear(0.2, 1e-12)));
  EXPECT_THAT(wearer(milliseconds(9000)), testing::Each(0.5));
}

TEST_F(EmulatedWearer, NeedsTheAnglesOfTheJoints) {
  std::ofstream(folder.path("poses.csv")) << "t_s,x_m,y_m,z_m,qw,qx,qy,qz\n0,0,0,0,1,0,0,0\n1,0,0,0,1,0,0,0\n";
  EXPECT_THAT([&] { wearer_of(folder.path("poses.csv")); },
              testing::ThrowsMessage<std::invalid_argument>(
                  testing::HasSubstr("poses.csv: the columns of the 22 joint angles are missing")));
}

}  // namespace
}  // namespace glissade::apps
