/// `glissade demo`: a small scene of the test's own, offline and in real time, and a stretch of the car door.

#include <filesystem>
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <glissade/apps/text.h>
#include <glissade/files/text_file.h>

#include "glissade_program.h"
#include "pressing_scene.h"
#include "report_page.h"
#include "sanitizers.h"
#include "temporary_folder.h"

namespace glissade::apps {
namespace {

using test_support::expect_refused;
using test_support::ProgramResult;

class Demo : public testing::Test {
 protected:
  std::string scene = test_support::write_pressing_scene(folder);

  static nlohmann::json run(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"demo", "--json"});
    const ProgramResult result = test_support::glissade(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.standard_error;
    // A machine that is busy makes events, but a file is no terminal: there is no line that is renewed.
    EXPECT_EQ(result.standard_error.find_first_of("\r\033"), std::string::npos) << result.standard_error;
    return nlohmann::json::parse(result.standard_output);
  }

  test_support::TemporaryFolder& files() { return folder; }

 private:
  static inline test_support::TemporaryFolder folder;
};

TEST_F(Demo, OfflineGivesTheSameHashTwiceAndReachesTheSeatThroughContact) {
  const nlohmann::json first = run({"--scene", scene, "--seconds", "1", "--offline"});
  const nlohmann::json second = run({"--scene", scene, "--seconds", "1", "--offline"});
  EXPECT_EQ(first["hash"], second["hash"]);
  EXPECT_EQ(first["ticks"], 1000);
  EXPECT_EQ(first["colliding_poses"], 0);
  EXPECT_EQ(first["checked_poses"], 1000);
  EXPECT_EQ(first["goal_reached"], true);
  EXPECT_GT(first["parts"][0]["contact_fraction"], 0.7);
  EXPECT_GT(first["hands"][0]["force_max_N"], 2.0);
  EXPECT_LE(first["hands"][0]["force_step_max_N"], 20.0 / 7.0) << "the slew of the device";
  // It comes from above, slides, and at the end it rests.
  const nlohmann::json& states = first["parts"][0]["state_s"];
  double sum = 0.0;
  for (const auto& [name, seconds] : states.items())
    sum += seconds.get<double>();
  EXPECT_NEAR(sum, 1.0, 1e-9);
  for (const char* name : {"free", "sliding", "resting"})
    EXPECT_GT(states[name].get<double>(), 0.05) << name;
  EXPECT_LE(states["unknown"].get<double>(), 0.001) << "the first tick, before there is an answer";
  EXPECT_EQ(states["released"], 0.0);
  EXPECT_GE(first["parts"][0]["state_changes"], 3);
  EXPECT_TRUE(first["lateness_us_p50"].is_null());
}

TEST_F(Demo, ThePageNamesTheRules) {
  run({"--scene", scene, "--offline", "--seconds", "1", "--metaphor", "incremental", "--friction", "0.2", "--report",
       files().path("rules")});
  const std::string page = read_text_file(files().path("rules/index.html"));
  EXPECT_NE(page.find("<td>incremental</td>"), std::string::npos);
  EXPECT_NE(page.find("<td>friction 0.2</td>"), std::string::npos);
}

TEST_F(Demo, RealTimeRunOverLcmReachesTheGoal) {
  const nlohmann::json summary = run({"--scene", scene, "--seconds", "1.2", "--report", files().path("report")});
  EXPECT_GE(summary["ticks"], 800) << "until the end of the script; a busy machine misses some";
  EXPECT_EQ(summary["colliding_poses"], 0);
  EXPECT_EQ(summary["goal_reached"], true);
  EXPECT_GT(summary["hands"][0]["force_max_N"], 1.0);
  for (const char* figure :
       {"tick_us_p50", "tick_us_p99", "lateness_us_p50", "bare_lateness_us_p50", "late_ticks", "page_faults"}) {
    EXPECT_TRUE(summary[figure].is_number()) << figure;
  }
  EXPECT_GE(summary["lateness_us_p99"], summary["lateness_us_p50"]);
  EXPECT_GE(summary["bare_lateness_us_max"], summary["bare_lateness_us_p99"]);
  EXPECT_TRUE(summary["has_fifo_scheduling"].is_boolean());
  EXPECT_TRUE(summary["has_locked_memory"].is_boolean());
  std::ifstream page(files().path("report") + "/index.html");
  std::stringstream html;
  html << page.rdbuf();
  EXPECT_THAT(test_support::titles_of(html.str()),
              testing::IsSupersetOf({"Force on the hand of glove 1", "Torque on the hand of glove 1",
                                     "Clearance of the visible parts, up to 2 mm", "States of the parts"}));
  for (const char* text : {"<td>force-feedback</td>", "<td>no friction</td>"})
    EXPECT_NE(html.str().find(text), std::string::npos) << text;
  // Nothing is fetched from anywhere.
  for (const char* reference : {"<script src", "src=\"http", "href=\"http", "url(http", "@import"}) {
    EXPECT_EQ(html.str().find(reference), std::string::npos) << reference;
  }
}

TEST_F(Demo, TheCarDoorRunsOfflineWithoutACollision) {
  if (test_support::kSanitized) GTEST_SKIP() << "takes minutes; the small scene runs through the same code";
  const nlohmann::json summary = run({"--seconds", "1", "--offline"});
  EXPECT_EQ(summary["ticks"], 1000);
  EXPECT_EQ(summary["colliding_poses"], 0);
  EXPECT_GT(summary["parts"][0]["contact_fraction"], 0.3);
  EXPECT_GE(summary["objects"], 40);
  // What the pipeline's stages were asked: most of the door is never near the motor.
  const nlohmann::json& stages = summary["collision_stages"];
  EXPECT_LT(stages["neighbor_finding"]["out"], 10.0);
  EXPECT_LE(stages["exact"]["in"], stages["separating_planes"]["in"]);
  EXPECT_GT(stages["exact"]["us"], 0.0);
}

TEST_F(Demo, TheSquarePegDropsIntoItsHole) {
  const std::string square_peg = std::string(GLISSADE_DOCS) + "/../examples/scenes/square_peg.yaml";
  const nlohmann::json summary = run({"--offline", "--seconds", "5", "--scene", square_peg});
  EXPECT_EQ(summary["goal_reached"], true);
  EXPECT_EQ(summary["colliding_poses"], 0);
}

TEST_F(Demo, TheNutIsWoundOnItsBoltAndOffAgain) {
  if (test_support::kSanitized) GTEST_SKIP() << "takes minutes; other scenes run through the same code";
  const std::string nut = std::string(GLISSADE_DOCS) + "/../examples/scenes/nut_on_bolt.yaml";
  const nlohmann::json summary = run({"--offline", "--seconds", "45", "--scene", nut});
  EXPECT_EQ(summary["colliding_poses"], 0);
  EXPECT_EQ(summary["goal_reached"], true) << "off the bolt";
  EXPECT_GT(summary["parts"][0]["contact_fraction"], 0.7) << "pressed against one flank and then against the other";
  EXPECT_LE(summary["hands"][0]["force_step_max_N"], 20.0 / 7.0) << "the slew of the device";
}

TEST_F(Demo, FingersGraspTheMotorSeatItAndLetGo) {
  if (test_support::kSanitized) GTEST_SKIP() << "takes minutes; the tests of the loop run through the same code";
  const nlohmann::json summary = run({"--fingers", "--offline"});
  EXPECT_EQ(summary["colliding_poses"], 0);
  EXPECT_EQ(summary["goal_reached"], true);
  const nlohmann::json& hand = summary["hands"][0];
  EXPECT_EQ(hand["has_fingers"], true);
  EXPECT_EQ(hand["grasps"], 1);
  EXPECT_GT(hand["holding_s"], 5.0);
  EXPECT_EQ(hand["colliding_postures"], 0);
  EXPECT_GT(hand["joint_torque_max_Nm"], 0.05);
  EXPECT_LE(hand["joint_torque_max_Nm"], 0.5) << "the limit of the device";
  EXPECT_GT(summary["parts"][0]["state_s"]["released"], 1.0) << "before and after";
  EXPECT_LT(summary["parts"][0]["state_changes"], 40) << "a hand that holds does not let go now and then";
}

TEST_F(Demo, ThatMissesItsGoalFailsAndSaysWhy) {
  test_support::expect_fails(1, {"demo", "--offline", "--seconds", "0.05", "--scene", scene}, {"missed its goal by"});
}

TEST_F(Demo, FingersOptionRefusesAScene) {
  expect_refused({"demo", "--fingers", "--scene", scene}, {"--fingers", "--scene"});
}

TEST_F(Demo, FrictionHoldsTheHandBack) {
  const auto distance_with = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"demo", "--offline", "--scene", scene, "--seconds", "1", "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const test_support::ProgramResult result = test_support::glissade(arguments);
    return nlohmann::json::parse(result.standard_output)["goal_distance_m"].get<double>();
  };
  EXPECT_GT(distance_with({"--friction", "0.6"}), distance_with({}) + 2e-3);
}

TEST_F(Demo, AServerSpinsForHalfOfItsPeriodAtMost) {
  expect_refused({"run", scene, "--spin-us", "501"}, {"--spin-us", "0 and 500"});
  expect_refused({"run", scene, "--rate-hz", "5000", "--spin-us", "300"}, {"--spin-us", "period, 100, not 300"});
}

TEST_F(Demo, RefusesInvalidOptionsAndScenes) {
  expect_refused({"demo", "--seconds", "0"}, {"--seconds", "0.01 and 3600"});
  expect_refused({"demo", "--lcm", "carrier-pigeon://"}, {"carrier-pigeon://"});
  expect_refused({"demo", "--scene", files().path("none.yaml")}, {"none.yaml"});
  const std::string no_script = files().write("no_script.yaml",
                                              "objects:\n"
                                              "  - {name: plate, shape: {type: plate}}\n"
                                              "  - {name: box, movable: true, shape: {type: box}}\n");
  expect_refused({"demo", "--scene", no_script}, {"no_script.yaml", "script"});
  const std::string no_part = files().write("no_part.yaml",
                                            "objects:\n"
                                            "  - {name: a, shape: {type: box}}\n"
                                            "script: hand.csv\n");
  expect_refused({"demo", "--scene", no_part}, {"no_part.yaml", "movable"});
  expect_refused({"demo", "--scene", scene, "--metaphor", "glue"}, {"--metaphor", "'glue'", "rubber-band"});
  expect_refused({"demo", "--scene", scene, "--friction", "0.5", "0.2"}, {"--friction"});
  for (const char* none : {"99999999999999999999", "9223372036854775808", "0", "-1", "1.5", "left"}) {
    expect_refused({"run", scene, "--device", none}, {"--device", none, "number of a glove"});
    expect_refused({"glove", "--device", none}, {"--device", none, "number of a glove"});
  }
  expect_refused({"run", scene, "--device", "1", "1"}, {"--device", "glove 1", "twice"});
  expect_refused({"run", scene, "--device", "1", "2", "3", "4", "5"}, {"--device", "5 gloves"});
  expect_refused({"run", scene, "--hold", "2=box"}, {"--hold", "'2=box'", "GLOVE=PART"});
  expect_refused({"run", scene, "--hold", "1=plate"}, {"--hold", "'1=plate'", "'box'"});
  expect_refused({"demo", "--offline", "--lcm", "memq://"}, {"--offline", "--lcm"});
  expect_refused({"run", no_script, "--lcm", "udpm://nonsense"}, {"udpm://nonsense"});
  expect_refused({"glove", "--lcm", "udpm://nonsense"}, {"udpm://nonsense"});
  expect_refused({"glove", "--side", "middle"}, {"--side", "middle"});
  expect_refused({"glove", "--script", no_script}, {"no_script.yaml"});
}

TEST_F(Demo, RunAndGloveRefuseTheInProcessBus) {
  expect_refused({"run", scene, "--lcm", "memq://"}, {"--lcm", "memq://", "one process"});
  expect_refused({"glove", "--lcm", "memq://"}, {"--lcm", "memq://", "one process"});
}

TEST_F(Demo, APartThatStartsInsideAnObstacleIsNamed) {
  const std::string stuck = files().write("stuck.yaml",
                                          "objects:\n"
                                          "  - {name: plate, shape: {type: plate}}\n"
                                          "  - {name: box, movable: true, shape: {type: box}}\n"
                                          "script: hand.csv\n");
  expect_refused({"demo", "--offline", "--scene", stuck},
                 {"stuck.yaml", "'box' collides", " mm deep in 'plate'; begin elsewhere, or let --depenetrate"});
  expect_refused({"demo", "--scene", stuck}, {"stuck.yaml", "'box'", "collides"});
}

TEST_F(Demo, UnwritableReportFolderIsRefusedBeforeTheRun) {
  // An hour in real time: a run that began would not end within this test.
  const std::string file = files().write("file", "");
  expect_refused({"demo", "--scene", scene, "--seconds", "3600", "--report", file}, {file});
  expect_refused({"demo", "--scene", scene, "--seconds", "3600", "--report", file + "/report"}, {file + "/report"});
  expect_refused({"run", scene, "--report", file}, {file});
}

}  // namespace
}  // namespace glissade::apps
