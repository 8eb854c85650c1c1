/// `glissade grasp`: a hand takes a ball from a table and leaves it in a tray.

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glissade/apps/text.h>
#include <glissade/files/text_file.h>
#include <glissade/geometry/mesh_generators.h>
#include <glissade/grasping/hand_model.h>
#include <glissade/reference/grid_check.h>

#include "glissade_program.h"
#include "poses.h"
#include "report_page.h"
#include "temporary_folder.h"

namespace glissade::apps {
namespace {

using Eigen::Isometry3d;
using test_support::at;
using test_support::CsvRow;
using test_support::expect_refused;
using test_support::glissade;
using test_support::ProgramResult;
using test_support::rows_of;
using test_support::TemporaryFolder;

const std::string kScene = GLISSADE_SCENES "/ball_and_tray.yaml";
const std::string kHand = GLISSADE_SCENES "/ball_and_tray_hand.csv";

double number(const CsvRow& row, const std::string& column) {
  return std::stod(row.at(column));
}

/// The pose in the columns `<prefix>x_m` to `<prefix>qz`.
Isometry3d pose_from(const CsvRow& row, const std::string& prefix = "") {
  Isometry3d X = at(number(row, prefix + "x_m"), number(row, prefix + "y_m"), number(row, prefix + "z_m"));
  X.linear() = Eigen::Quaterniond(number(row, prefix + "qw"), number(row, prefix + "qx"), number(row, prefix + "qy"),
                                  number(row, prefix + "qz"))
                   .toRotationMatrix();
  return X;
}

class GraspCommand : public testing::Test {
 protected:
  TemporaryFolder folder;
  std::string hands = folder.path("hands.csv");
  std::string objects = folder.path("objects.csv");

  /// The beginning of the trajectory, up to the grasp: a whole one takes minutes under a sanitizer.
  std::string first_seconds() const {
    const std::string all = read_text_file(kHand);
    return folder.write("first_seconds.csv", all.substr(0, all.find("\n2.4,") + 1));
  }
};

void expect_ball_carried_to_tray(const std::vector<CsvRow>& postures, const CsvRow& left) {
  const bool is_held = std::any_of(postures.begin(), postures.end(), [](const CsvRow& row) {
    return row.at("state") == "holding" && row.at("object") == "ball";
  });
  EXPECT_TRUE(is_held);
  EXPECT_EQ(postures.back().at("state"), "free");
  EXPECT_EQ(left.at("object"), "ball");
  EXPECT_EQ(left.at("state"), "released");
  EXPECT_NEAR(number(left, "y_m"), 0.3, 0.03) << "over the tray";
  EXPECT_LT(number(left, "z_m"), 0.06);
}

std::vector<double> values_of(const CsvRow& row, const grasping::HandModel& hand) {
  std::vector<double> values;
  for (const grasping::FlexValue& value : hand.chain.values())
    values.push_back(number(row, value.name + "_rad"));
  return values;
}

/// Only a segment that touches presses, and tips that hold the ball do.
void expect_tips_press_where_they_touch(const std::vector<CsvRow>& postures) {
  double greatest = 0.0;
  for (const CsvRow& row : postures) {
    for (const std::string finger : {"thumb", "index", "middle", "ring", "little"}) {
      const double force = number(row, finger + "_tip_N");
      const bool touches = row.at("touching").find(finger + "_distal") != std::string::npos;
      ASSERT_GE(force, 0.0);
      ASSERT_TRUE(force == 0.0 || touches) << finger << ", " << row.at("t_s") << " s";
      greatest = std::max(greatest, force);
    }
  }
  EXPECT_GT(greatest, 1.0);
}

void expect_thumb_before_palm(const std::vector<CsvRow>& postures) {
  const grasping::HandModel hand = grasping::make_hand();
  std::vector<Isometry3d> X_RL(hand.chain.links().size());
  for (const CsvRow& row : postures) {
    hand.chain.poses(Isometry3d::Identity(), values_of(row, hand), X_RL);
    for (std::size_t link = 0; link < X_RL.size(); ++link) {
      if (hand.chain.links()[link].name != "thumb_distal") continue;
      ASSERT_LT(X_RL[link].translation().z(), 0.0) << "out of the back of the hand at " << row.at("t_s") << " s";
    }
  }
}

void expect_nothing_goes_into_anything(const std::vector<CsvRow>& postures, const std::vector<CsvRow>& moved) {
  const grasping::HandModel hand = grasping::make_hand();
  const auto table = std::make_shared<const geometry::TriangleMesh>(geometry::make_box({0.5, 0.8, 0.02}, 12));
  const auto tray = std::make_shared<const geometry::TriangleMesh>(geometry::make_torus(0.06, 0.015, 2000));
  const auto ball = std::make_shared<const geometry::TriangleMesh>(geometry::make_sphere(0.035, 2000));
  const std::vector<reference::PlacedMesh> still{{table, at(0.0, 0.15, -0.0101)}, {tray, at(0.0, 0.3, 0.0152)}};
  ASSERT_EQ(postures.size(), moved.size());
  std::vector<Isometry3d> X_WL(hand.chain.links().size());
  for (std::size_t row = 0; row < postures.size(); row += 25) {
    const Isometry3d X_WV = pose_from(moved[row]);
    ASSERT_FALSE(reference::GridCheck(still).collides(*ball, X_WV)) << row;
    std::vector<reference::PlacedMesh> all = still;
    all.push_back({ball, X_WV});
    const reference::GridCheck check(all);
    hand.chain.poses(pose_from(postures[row]), values_of(postures[row], hand), X_WL);
    for (std::size_t link = 0; link < X_WL.size(); ++link) {
      const auto& mesh = hand.chain.links()[link].mesh;
      if (mesh != nullptr) {
        ASSERT_FALSE(check.collides(*mesh, X_WL[link])) << row << " " << hand.chain.links()[link].name;
      }
    }
  }
}

TEST_F(GraspCommand, CarriesTheBallToTheTrayAndLeavesItThere) {
  const ProgramResult run = glissade({"grasp", kScene, "--hand-trajectory", kHand, "--out", hands, "--objects", objects,
                                      "--report", folder.path("report")});
  ASSERT_EQ(run.exit_code, 0) << run.standard_error;
  EXPECT_NE(run.standard_output.find("1 grasp, holds for 3."), std::string::npos) << run.standard_output;
  EXPECT_EQ(run.standard_output.find("waits"), std::string::npos);
  EXPECT_NE(run.standard_output.find(folder.path("report/index.html") + "\n"), std::string::npos);
  const std::vector<CsvRow> postures = rows_of(read_text_file(hands));
  const std::vector<CsvRow> moved = rows_of(read_text_file(objects));
  expect_ball_carried_to_tray(postures, moved.back());
  expect_thumb_before_palm(postures);
  expect_tips_press_where_they_touch(postures);
  expect_nothing_goes_into_anything(postures, moved);
  const std::string page = read_text_file(folder.path("report/index.html"));
  for (const char* part : {"1 grasp, holds for", "id=\"report-frames\"", "\"released\""})
    EXPECT_NE(page.find(part), std::string::npos) << part;
  EXPECT_THAT(test_support::titles_of(page),
              testing::IsSupersetOf({"Kind of grasp", "Segments that touch", "Force of ball on the hands",
                                     "Torque of ball on the hands, about its reference point", "Contacts that push",
                                     "Clearance of the visible parts, up to 2 mm", "States of the parts"}));
}

TEST_F(GraspCommand, ReportsAHandWaitingInsideAnObject) {
  const std::string inside = folder.write("inside.yaml",
                                          "objects:\n- {name: ball, movable: true, shape: {type: sphere}}\n"
                                          "- {name: wall, shape: {type: box, size_x_m: 0.4, size_y_m: 0.8},"
                                          " pose: {position_m: [0, 0, 0.2]}}\n");
  const ProgramResult waits = glissade({"grasp", inside, "--hand-trajectory", first_seconds(), "--out", hands});
  EXPECT_NE(waits.standard_output.find("waits for 0."), std::string::npos) << waits.standard_output;
  EXPECT_THAT(waits.standard_error,
              testing::ContainsRegex("the hand waits for 0\\..* s, first at 0\\.000 s: its target "
                                     "is inside an object, there [a-z_]+ in 'wall'\n"));
}

// Straight fingers push the ball along with their tips.
TEST_F(GraspCommand, TellsWhyNothingIsGrasped) {
  const std::string scene =
      folder.write("ball.yaml",
                   "objects:\n- {name: ball, movable: true, shape: {type: sphere}, pose: {position_m: [0.3, 0, 0]}}\n"
                   "- {name: floor, shape: {type: plate}, pose: {position_m: [0, 0, -1]}}\n");
  const std::string columns = read_text_file(kHand).substr(0, read_text_file(kHand).find('\n'));
  std::string zeros;
  for (int v = 0; v < 22; ++v)
    zeros += ",0";
  const std::string hand =
      folder.write("push.csv", columns + "\n0,0,0,0,1,0,0,0" + zeros + "\n0.5,0.1,0,0,1,0,0,0" + zeros + "\n");
  const ProgramResult run = glissade({"grasp", scene, "--hand-trajectory", hand, "--out", hands});
  ASSERT_EQ(run.exit_code, 0) << run.standard_error;
  EXPECT_THAT(run.standard_output,
              testing::ContainsRegex("hand 0 +holds nothing: the [a-z, ]+ alone pushed 'ball' from "
                                     "0\\.[0-9]+ to 0\\.5[0-9]+ s: a grasp needs the thumb as "
                                     "well, or the palm and a middle or outer segment\n"));
}

TEST_F(GraspCommand, PrintsNoSummaryAmongTableRows) {
  const ProgramResult table = glissade({"grasp", kScene, "--hand-trajectory", first_seconds()});
  EXPECT_EQ(table.exit_code, 0) << table.standard_error;
  EXPECT_EQ(table.standard_output.find("holds for"), std::string::npos);
}

TEST_F(GraspCommand, WithAnotherOutputPrintsTheSummaryOnly) {
  const std::vector<std::string> command{"grasp", kScene, "--hand-trajectory", first_seconds()};
  for (const auto& [option, output] : {std::pair("--report", "report"), std::pair("--objects", "objects.csv")}) {
    std::vector<std::string> arguments = command;
    arguments.insert(arguments.end(), {option, folder.path(output)});
    const ProgramResult run = glissade(arguments);
    EXPECT_EQ(run.exit_code, 0) << run.standard_error;
    EXPECT_THAT(run.standard_output, testing::HasSubstr("\nhand 0 "));
    EXPECT_THAT(run.standard_output, testing::Not(testing::HasSubstr("t_s,"))) << option;
  }
}

TEST_F(GraspCommand, AcceptsAHandShapeFile) {
  const std::string shape = folder.write("hand.yaml", "side: left\nlength_m: 0.166\nbreadth_m: 0.075\n");
  const ProgramResult result =
      glissade({"grasp", kScene, "--hand-trajectory", first_seconds(), "--hand", shape, "--out", hands});
  EXPECT_EQ(result.exit_code, 0) << result.standard_error;
}

TEST_F(GraspCommand, NamesWhatIsWrong) {
  expect_refused({"grasp", kScene, "--hand-trajectory", folder.write("few.csv", "t_s,x_m\n0,0\n")}, {"few.csv:1"});
  const std::string comma = folder.write("comma.yaml",
                                         "objects:\n- {name: 'ball, red', movable: true, shape: {type: sphere}}\n"
                                         "- {name: floor, shape: {type: plate}, pose: {position_m: [0, 0, -0.1]}}\n");
  expect_refused({"grasp", comma, "--hand-trajectory", kHand}, {"comma.yaml", "ball, red", "comma"});
  std::string late = read_text_file(kHand);
  late.replace(late.find("\n5.2,"), 5, "\n90000,");
  expect_refused({"grasp", kScene, "--hand-trajectory", folder.write("late.csv", late)}, {"late.csv", "a day"});
  const std::string shape = folder.write("hand.yaml", "side: left\nlength_m: 3\n");
  expect_refused({"grasp", kScene, "--hand-trajectory", kHand, "--hand", shape}, {"hand.yaml", "length"});
  const std::string side = folder.write("side.yaml", "side: upper\n");
  expect_refused({"grasp", kScene, "--hand-trajectory", kHand, "--hand", side}, {"side.yaml:1", "upper"});
  expect_refused({"grasp", kScene, "--hand-trajectory", kHand, "--hand", shape, shape},
                 {"--hand: 2 files for 1 hands"});
  expect_refused({"grasp", kScene, "--hand-trajectory", kHand, "--out", hands, "--objects", hands},
                 {"--objects", "--out"});
  const std::string stuck =
      folder.write("stuck.yaml",
                   "objects:\n"
                   "- {name: cube, movable: true, shape: {type: box, size_x_m: 0.1, size_y_m: 0.1,"
                   " size_z_m: 0.1}}\n"
                   "- {name: twin, movable: true, shape: {type: box, size_x_m: 0.1, size_y_m: 0.1,"
                   " size_z_m: 0.1}, pose: {position_m: [0.09, 0, 0]}}\n"
                   "- {name: floor, shape: {type: plate}, pose: {position_m: [0, 0, -1]}}\n");
  expect_refused({"grasp", stuck, "--hand-trajectory", kHand},
                 {"stuck.yaml", "'twin' collides", ": at most 10 mm deep in 'cube'\n"});
  const std::filesystem::path path = hands;
  expect_refused({"grasp", kScene, "--hand-trajectory", kHand, "--out", hands, "--objects",
                  (path.parent_path() / "." / path.filename()).string()},
                 {"--objects", "--out"});
}

}  // namespace
}  // namespace glissade::apps
