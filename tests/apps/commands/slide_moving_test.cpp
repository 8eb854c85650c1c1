/// `glissade slide` with objects of the scene that move on their own.

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <glissade/apps/text.h>
#include <glissade/files/text_file.h>

#include "glissade_program.h"
#include "temporary_folder.h"

namespace glissade::apps {
namespace {

using test_support::expect_refused;
using test_support::kTwoMargins;
using test_support::ProgramResult;
using test_support::rows_of;

/// A lift of 0.1 × 0.1 × 0.02 m that rises by 10 mm in 0.1 s, 1 s after time zero, and a cube that is held 25 mm above
/// where it begins: their faces are 5 mm apart.
class SlideAmongMovingObjects : public testing::Test {
 protected:
  std::string scene(const std::string& more_of_lift = "") const {
    return folder.write("scene.yaml",
                        "objects:\n"
                        "  - {name: cube, movable: true, shape: {type: box, size_x_m: 0.02, size_y_m: 0.02, size_z_m: "
                        "0.02, triangles: 12}}\n"
                        "  - {name: floor, shape: {type: plate, size_x_m: 0.5, size_y_m: 0.5, triangles: 50}}\n"
                        "  - {name: lift, moves: lift.csv, shape: {type: box, size_x_m: 0.1, size_y_m: 0.1, size_z_m: "
                        "0.02, triangles: 48}" +
                            more_of_lift + "}\n");
  }
  std::vector<std::string> slide(const std::string& scene_file, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments{"slide", scene_file, "--part", "cube", "--trajectory", hand};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }

  test_support::TemporaryFolder folder;
  const std::string lift = folder.write(
      "lift.csv", "t_s,x_m,y_m,z_m,qw,qx,qy,qz\n0,0,0,0.02,1,0,0,0\n1,0,0,0.02,1,0,0,0\n1.1,0,0,0.03,1,0,0,0\n");
  const std::string hand =
      folder.write("hand.csv", "t_s,x_m,y_m,z_m,qw,qx,qy,qz\n1,0,0,0.045,1,0,0,0\n1.2,0,0,0.045,1,0,0,0\n");
};

TEST_F(SlideAmongMovingObjects, ObjectsFollowTheirTrajectoryAndPushThePart) {
  const ProgramResult result = test_support::glissade(
      slide(scene(), {"--moving", folder.path("moving.csv"), "--contacts", folder.path("contacts.csv")}));
  ASSERT_EQ(result.exit_code, 0) << result.standard_error;
  const auto rows = rows_of(result.standard_output);
  const auto moving = rows_of(read_text_file(folder.path("moving.csv")));
  ASSERT_EQ(rows.size(), 201U);
  ASSERT_EQ(moving.size(), rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(moving[i].at("t_s"), rows[i].at("t_s"));
    EXPECT_EQ(moving[i].at("object"), "lift");
    const double z_lift = std::stod(moving[i].at("z_m"));
    EXPECT_NEAR(z_lift, 0.02 + 1e-4 * static_cast<double>(std::min<std::size_t>(i, 100)), kTwoMargins) << "row " << i;
    EXPECT_GT(std::stod(rows[i].at("vz_m")) - z_lift, 0.02) << "never inside";
  }
  EXPECT_EQ(std::stod(rows[30].at("fz_N")), 0.0) << "it has not come yet";
  EXPECT_NEAR(std::stod(rows.back().at("vz_m")), 0.05, 2.0 * kTwoMargins);
  EXPECT_NEAR(std::stod(rows.back().at("fz_N")), 5.0, 0.05) << "the hand holds 5 mm against 1000 N/m";
  const auto contacts = rows_of(read_text_file(folder.path("contacts.csv")));
  ASSERT_FALSE(contacts.empty());
  for (const auto& contact : contacts)
    EXPECT_EQ(contact.at("obstacle"), "lift");
}

TEST_F(SlideAmongMovingObjects, ObjectWithEqualGripStiffnessYieldsHalf) {
  const ProgramResult result = test_support::glissade(slide(scene(", grip_N_per_m: 1000")));
  ASSERT_EQ(result.exit_code, 0) << result.standard_error;
  EXPECT_NEAR(std::stod(rows_of(result.standard_output).back().at("vz_m")), 0.0475, kTwoMargins);
}

TEST_F(SlideAmongMovingObjects, ACheckTellsTheClearanceToThem) {
  const ProgramResult result = test_support::glissade(slide(scene(), {"--summary", "-"}));
  ASSERT_EQ(result.exit_code, 0) << result.standard_error;
  const auto rows = rows_of(result.standard_output);
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_LT(std::stod(rows[0].at("clearance_min_m")), kTwoMargins);
  EXPECT_GT(std::stod(rows[0].at("clearance_min_m")), 0.0);
  EXPECT_GT(std::stod(rows[0].at("clearance_min_at_s")), 0.045) << "when the lift has come";
}

TEST_F(SlideAmongMovingObjects, RefusesInvalidInput) {
  expect_refused(slide(scene(", pose: {position_m: [0, 0, 1]}")), {"scene.yaml:4", "pose", "moves"});
  expect_refused(slide(scene(", margin_m: 1.0e-6")), {"scene.yaml:4", "margin_m", "moves"});
  expect_refused(slide(scene(", grip_N_per_m: 0")), {"scene.yaml:4", "grip_N_per_m", "positive"});
  expect_refused({"slide", scene(), "--part", "lift", "--trajectory", hand}, {"scene.yaml", "'lift'", "moves"});
  expect_refused(slide(scene(), {"--method", "paper"}), {"--method", "'lift'"});
  expect_refused(slide(scene(), {"--summary", "-", "--moving", "-"}), {"--summary", "'-'", "--moving"});
  expect_refused(slide(scene(), {"--out", folder.path("a.csv"), "--moving", folder.path("a.csv")}),
                 {"--moving", "a.csv", "--out"});
  folder.write("lift.csv", "t_s,x_m,y_m,z_m,qw,qx,qy,qz\n0,0,0,zero,1,0,0,0\n");
  expect_refused(slide(scene()), {"scene.yaml:4", "moves", "lift.csv:2", "zero"});
}

/// The lift comes up below a hand that stays where it is.
TEST_F(SlideAmongMovingObjects, ObjectsPushTheHandInTheHapticLoop) {
  const std::string above = folder.write(
      "demo.yaml",
      "objects:\n"
      "  - {name: cube, movable: true, shape: {type: box, size_x_m: 0.02, size_y_m: 0.02, size_z_m: 0.02}, pose: "
      "{position_m: [0, 0, 0.045]}}\n"
      "  - {name: lift, moves: lift.csv, shape: {type: box, size_x_m: 0.1, size_y_m: 0.1, size_z_m: 0.02}}\n"
      "script: hand.csv\n");
  folder.write("hand.csv", "t_s,x_m,y_m,z_m,qw,qx,qy,qz\n0,0,0,0.045,1,0,0,0\n1,0,0,0.045,1,0,0,0\n");
  const ProgramResult result =
      test_support::glissade({"demo", "--offline", "--scene", above, "--seconds", "2", "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.standard_error;
  const nlohmann::json summary = nlohmann::json::parse(result.standard_output);
  EXPECT_EQ(summary["parts"][0]["name"], "cube");
  EXPECT_EQ(summary["parts"][1]["name"], "lift");
  EXPECT_EQ(summary["colliding_poses"], 0);
  EXPECT_GT(summary["hands"][0]["force_max_N"], 5e-3 / (1.0 / 400.0 + 1.0 / 1000.0)) << "arm and coupling in a row";
  EXPECT_LT(summary["hands"][0]["force_max_N"], 5e-3 * 1000.0) << "the arm yields";
}

TEST_F(SlideAmongMovingObjects, MovingTableIsRefusedWithoutMovingObjects) {
  const std::string still = folder.write("still.yaml",
                                         "objects:\n"
                                         "  - {name: cube, movable: true, shape: {type: box}}\n"
                                         "  - {name: floor, shape: {type: plate}, pose: {position_m: [0, 0, -9]}}\n");
  expect_refused(slide(still, {"--moving", folder.path("moving.csv")}), {"--moving", "still.yaml"});
}

TEST_F(SlideAmongMovingObjects, EachHasItsOwnName) {
  const std::string two = folder.write("two.yaml", read_text_file(scene()) +
                                                       "  - {name: press, moves: press.csv, shape: {type: box, "
                                                       "size_x_m: 0.1, size_y_m: 0.1, size_z_m: 0.02}}\n");
  folder.write("press.csv", "t_s,x_m,y_m,z_m,qw,qx,qy,qz\n1,0,0,0.08,1,0,0,0\n1.1,0,0,0.064,1,0,0,0\n");
  const ProgramResult result = test_support::glissade(
      slide(two, {"--moving", folder.path("moving.csv"), "--patches", folder.path("patches.csv")}));
  ASSERT_EQ(result.exit_code, 0) << result.standard_error;
  const auto moving = rows_of(read_text_file(folder.path("moving.csv")));
  ASSERT_EQ(moving.size(), 2U * 201U);
  EXPECT_EQ(moving[400].at("object"), "lift");
  EXPECT_EQ(moving[401].at("object"), "press");
  // Between them there are 24 mm less both halves, for 20 mm of cube; so they leave it no room to move.
  EXPECT_NEAR(std::stod(moving[401].at("z_m")) - std::stod(moving[400].at("z_m")), 0.04, 2.0 * kTwoMargins);
  std::map<std::string, double> force;
  for (const auto& patch : rows_of(read_text_file(folder.path("patches.csv")))) {
    if (std::stod(patch.at("t_s")) == 1.2) force[patch.at("obstacle")] += std::stod(patch.at("fz_N"));
  }
  EXPECT_GT(force["lift"], 100.0);
  EXPECT_LT(force["press"], -100.0);
}

TEST_F(SlideAmongMovingObjects, RefusesTooManyMovingObjects) {
  std::string text =
      "objects:\n"
      "  - {name: cube, shape: {type: box, size_x_m: 0.02, size_y_m: 0.02, size_z_m: 0.02, triangles: 12}}\n";
  for (int i = 0; i < 4; ++i) {
    const std::string name = "lift" + std::to_string(i);
    text += "  - {name: " + name + ", moves: lift.csv, shape: {type: sphere}}\n";
  }
  expect_refused(slide(folder.write("many.yaml", text)), {"many.yaml", "5 objects", "at most 4"});
}

}  // namespace
}  // namespace glissade::apps
