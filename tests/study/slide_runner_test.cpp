/// Slides of a study, beside what geometry says of them.

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glissade/study/slide_runner.h>

#include "study_folder.h"

namespace glissade::study {
namespace {

/// A square peg over a square hole goes in if its corners do: |offset| + (w/2) (cos ψ + sin |ψ|) < hole/2. It is
/// pressed with 0.5 N at most, so it hardly yields sideways.
TEST(SlideRunner, APegGoesInWhereItsCornersFit) {
  constexpr double kHole_m = 0.0082;
  const StudyFolder folder(kHole_m);
  const Study study = folder.read(
      "parameters:\n"
      "  - {vary: [path.x_m, goal.x_m], uniform: [-0.0002, 0.0002]}\n"
      "  - {vary: [path.y_m, goal.y_m], uniform: [-0.0002, 0.0002]}\n"
      "  - {vary: path.yaw_deg, uniform: [-1, 1]}\n"
      "  - {name: width, vary: [peg.size_x_m, peg.size_y_m], uniform: [0.0079, 0.0082]}\n"
      "  - {vary: [end.z_m, goal.z_m], one_of: [0.0025]}\n"
      "slides: 200\n"
      "success: {distance_m: 0.0002, angle_deg: 2}\n"
      "record: [jam]\n");
  const SlideRunner runner(study);
  int fitting = 0;
  int near_the_edge = 0;
  for (std::int64_t slide = 0; slide < study.slides; ++slide) {
    const SlideRow row = runner.run(slide);
    ASSERT_FALSE(row.problem) << *row.problem;
    const double turn = std::abs(row.values[2]) * std::numbers::pi / 180.0;
    const double half_width = 0.5 * row.values[3] * (std::cos(turn) + std::sin(turn));
    const double room = kHole_m / 2.0 - half_width - std::max(std::abs(row.values[0]), std::abs(row.values[1]));
    constexpr double kMargin = 10e-6;  // the part keeps a few micrometres from its obstacles, and yields as much
    if (std::abs(room) < kMargin) {
      ++near_the_edge;
      continue;
    }
    EXPECT_EQ(row.outcome, room > 0.0 ? "success" : "jammed") << "slide " << slide << ", room " << 1e6 * room << " µm";
    fitting += room > 0.0 ? 1 : 0;
  }
  EXPECT_GT(fitting, 10);
  EXPECT_LT(near_the_edge, 20);
}

TEST(SlideRunner, RowsDependOnTheirNumberOnly) {
  const StudyFolder folder;
  const Study study = folder.read("parameters: [{vary: path.x_m, uniform: [-0.002, 0.002]}]\nslides: 6\n");
  const SlideRunner runner(study);
  const std::string third = json_of(study, runner.run(3));
  runner.run(5);
  EXPECT_EQ(json_of(study, runner.run(3)), third);
  EXPECT_EQ(json_of(study, SlideRunner(study).run(3)), third);
  EXPECT_EQ(runner.run(3).input_hash, runner.hash(3));
  EXPECT_THROW(runner.run(6), std::out_of_range);
  EXPECT_THROW(runner.run(-1), std::out_of_range);
}

/// A peg beside the hole stands on the plate at z = 0 while the ghost goes 3 mm into it.
TEST(SlideRunner, MeasuresAreThoseOfTheSpring) {
  const StudyFolder folder;
  const Study study = folder.read(
      "parameters:\n"
      "  - {vary: path.x_m, one_of: [0.02]}\n"
      "  - {vary: stiffness_N_per_m, one_of: [500]}\n"
      "slides: 1\n");
  const SlideMeasures measures = SlideRunner(study).run(0).measures;
  EXPECT_NEAR(measures.force_max_N, 500.0 * 0.003, 0.02);
  EXPECT_NEAR(measures.work_J, 0.5 * 500.0 * 0.003 * 0.003, 5e-5) << "the energy of the spring";
  EXPECT_NEAR(measures.contact_s, 0.075, 2e-3) << "the last three of four millimetres";
  EXPECT_GT(measures.still_since_s, 0.0175) << "then 0.3 mm, the tolerance, are left of the free way of 1 mm";
  EXPECT_LT(measures.still_since_s, 0.027) << "the end of the free way";
  EXPECT_EQ(measures.pushed_by, "right");
  ASSERT_TRUE(measures.jams());
  EXPECT_NEAR(measures.p_Wpushed->z(), 0.0, 1e-4);
  EXPECT_NEAR(measures.p_Wpushed->x(), 0.02, 0.005);
}

/// The peg stands on the plate beside the hole, and the ghost of the second slide drags it along until the end.
TEST(SlideRunner, APartThatStillMovesIsNotJammed) {
  const StudyFolder folder;
  const Study study = folder.read(
      "parameters:\n"
      "  - {vary: path.x_m, one_of: [0.02]}\n"
      "  - {vary: end.x_m, one_of: [0, 0.01]}\n"
      "sampling: grid\n");
  const SlideRunner runner(study);
  EXPECT_EQ(runner.run(0).outcome, "jammed");
  const SlideRow row = runner.run(1);
  EXPECT_EQ(row.outcome, "still moving");
  EXPECT_FALSE(row.measures.jams());
  EXPECT_EQ(row.measures.pushed_by, "right");
}

/// Each target changes what it says: the end of the path of the peg in free space, or the force of a contact.
TEST(SlideRunner, TargetsDisplaceTheirBodies) {
  const StudyFolder folder;
  const auto end_of = [&](const std::string& parameters) {
    const Study study = folder.read("parameters:\n" + parameters + "slides: 1\n");
    return SlideRunner(study).run(0).measures;
  };
  const Eigen::Vector3d nominal(0.0, 0.0, 0.097);
  SlideMeasures measures = end_of("  - {vary: end.z_m, one_of: [0.05]}\n");
  EXPECT_LT((measures.X_WV_end.translation() - nominal - Eigen::Vector3d(0, 0, 0.05)).norm(), 1e-9);
  EXPECT_FALSE(measures.goal_reached);
  measures = end_of("  - {vary: start.z_m, one_of: [0.05]}\n");
  EXPECT_LT((measures.X_WV_end.translation() - nominal).norm(), 1e-9) << "the end is where it was";
  EXPECT_TRUE(measures.goal_reached);
  measures = end_of("  - {vary: [end.z_m, goal.z_m], one_of: [0.05]}\n");
  EXPECT_TRUE(measures.goal_reached) << "the goal has moved too";
  measures = end_of("  - {vary: right.z_m, one_of: [0.001]}\n  - {vary: path.x_m, one_of: [0.02]}\n");
  EXPECT_NEAR(measures.force_max_N, 4.0, 0.05) << "the block is 1 mm higher";
  measures = end_of("  - {vary: peg.scale_z, one_of: [1.005]}\n  - {vary: path.x_m, one_of: [0.02]}\n");
  EXPECT_NEAR(measures.force_max_N, 3.5, 0.05) << "the peg is 1 mm longer, half of it downwards";
  // The peg turns about its compliance point, the tip.
  measures = end_of("  - {vary: path.pitch_deg, one_of: [90]}\n  - {vary: path.z_m, one_of: [0.5]}\n");
  EXPECT_LT((measures.X_WV_end.translation() - Eigen::Vector3d(0.1, 0.0, 0.497)).norm(), 1e-9);
}

TEST(SlideRunner, AStartInsideAnObjectIsAProblemOfItsRow) {
  const StudyFolder folder;
  const Study study = folder.read(
      "parameters: [{vary: path.z_m, one_of: [-0.003, 0.01]}, {vary: path.x_m, one_of: [0.02]}]\nsampling: grid\n");
  const SlideRunner runner(study);
  const SlideRow row = runner.run(0);
  EXPECT_EQ(row.outcome, "problem");
  ASSERT_TRUE(row.problem);
  EXPECT_THAT(*row.problem, testing::HasSubstr("collides with 'right'"));
  EXPECT_EQ(runner.run(1).outcome, "goal missed") << "it starts above the plate";
}

TEST(SlideRunner, LimitsOfForceAndClearanceCount) {
  const StudyFolder folder;
  const std::string pressed = "parameters: [{vary: path.x_m, one_of: [0.02]}]\nslides: 1\n";
  Study study = folder.read(pressed + "success: {distance_m: 0.1, force_N: 1}\n");
  EXPECT_EQ(SlideRunner(study).run(0).outcome, "force exceeded");
  study = folder.read(pressed + "success: {distance_m: 0.1, clearance_m: 0.0001}\n");
  EXPECT_EQ(SlideRunner(study).run(0).outcome, "too near");
  study = folder.read(pressed + "success: {distance_m: 0.1, force_N: 4, torque_Nm: 10}\n");
  EXPECT_EQ(SlideRunner(study).run(0).outcome, "success");
}

TEST(SlideRunner, AnotherMeshIsAnotherHash) {
  const StudyFolder folder;
  const std::string lines = "parameters: [{vary: path.x_m, uniform: [0, 0.001]}]\nslides: 4\n";
  const std::uint64_t before = SlideRunner(folder.read(lines)).hash(2);
  EXPECT_EQ(SlideRunner(folder.read(lines + "seed: 1\n")).hash(2), before);
  EXPECT_NE(SlideRunner(folder.read(lines + "success: {distance_m: 0.01}\n")).hash(2), before);
  EXPECT_NE(SlideRunner(folder.read(lines + "sliding: {friction: 0.1}\n")).hash(2), before);
  const StudyFolder other(0.0083);
  EXPECT_NE(SlideRunner(other.read(lines)).hash(2), before);
}

}  // namespace
}  // namespace glissade::study
