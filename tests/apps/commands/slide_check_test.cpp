/// `glissade slide` as an assembly check: a stack of trajectories in, one row for each out, and a page.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glissade/apps/text.h>
#include <glissade/files/text_file.h>

#include "glissade_program.h"
#include "report_page.h"
#include "temporary_folder.h"

namespace glissade::apps {
namespace {

using test_support::expect_refused;
using test_support::ProgramResult;

constexpr double kMargin = 1e-5;

/// The rows by the trajectory's file name, each by column name.
std::map<std::string, std::map<std::string, double>> checks_of(const std::string& csv) {
  std::map<std::string, std::map<std::string, double>> rows;
  for (const test_support::CsvRow& cells : test_support::rows_of(csv)) {
    const std::string& path = cells.at("trajectory");
    auto& row = rows[path.substr(path.rfind('/') + 1)];
    for (const auto& [column, cell] : cells) {
      if (column != "trajectory") row[column] = std::stod(cell);
    }
  }
  return rows;
}

/// A box of 0.1 × 0.06 × 0.04 m above a floor, and ways to lead it.
class AssemblyCheck : public testing::Test {
 protected:
  std::string trajectory(const std::string& name, const std::string& rows) const {
    return folder.write(name, "t_s,x_m,y_m,z_m,qw,qx,qy,qz\n" + rows);
  }

  ProgramResult check(std::vector<std::string> trajectories, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments{"slide", scene, "--part", "box", "--trajectory"};
    arguments.insert(arguments.end(), trajectories.begin(), trajectories.end());
    arguments.insert(arguments.end(), more.begin(), more.end());
    return test_support::glissade(arguments);
  }

  test_support::TemporaryFolder folder;
  const std::string scene =
      folder.write("scene.yaml",
                   "objects:\n"
                   "  - {name: box, movable: true, shape: {type: box, size_x_m: 0.1, size_y_m: 0.06, size_z_m: 0.04, "
                   "triangles: 600}}\n"
                   "  - {name: floor, shape: {type: plate, size_x_m: 0.5, size_y_m: 0.5, triangles: 900}}\n");
  const std::string above =
      trajectory("above.csv", "0,0,0,0.03,1,0,0,0\n0.1,0,0,0.025,1,0,0,0\n0.2,0.05,0,0.05,1,0,0,0\n");
  const std::string below = trajectory("below.csv", "5,0,0,0.03,1,0,0,0\n5.1,0.02,0,0.01,1,0,0,0\n");
};

TEST_F(AssemblyCheck, PaperMethodFindsWhichGoalsAreReached) {
  const ProgramResult result =
      check({above, below}, {"--method", "paper", "--summary", "-", "--report", folder.path("page")});
  ASSERT_EQ(result.exit_code, 0) << result.standard_error;
  auto rows = checks_of(result.standard_output);
  EXPECT_EQ(rows["above.csv"]["goal_reached"], 1.0);
  EXPECT_EQ(rows["below.csv"]["goal_reached"], 0.0);
  // It goes nearer than the default's margin.
  EXPECT_GT(rows["below.csv"]["clearance_min_m"], 0.0);
  EXPECT_LT(rows["below.csv"]["clearance_min_m"], 1e-6);
}

TEST_F(AssemblyCheck, SummaryHasTheResultOfEachTrajectory) {
  const ProgramResult result = check({above, below});
  ASSERT_EQ(result.exit_code, 0) << result.standard_error;
  const auto rows = checks_of(result.standard_output);
  ASSERT_EQ(rows.size(), 2U);

  const auto& free = rows.at("above.csv");
  EXPECT_EQ(free.at("goal_reached"), 1.0);
  EXPECT_LT(free.at("goal_distance_m"), 1e-12);
  EXPECT_EQ(free.at("force_max_N"), 0.0);
  EXPECT_NEAR(free.at("clearance_min_m"), 5e-3, 1e-9) << "at its lowest";
  EXPECT_NEAR(free.at("clearance_min_at_s"), 0.1, 1e-9);
  EXPECT_EQ(free.at("contact_s"), 0.0);
  EXPECT_NEAR(free.at("duration_s"), 0.2, 1e-9);

  // 10 mm above the floor, of 20 mm on the way down, is where it stops: half of the time, and 1000 N/m.
  const auto& blocked = rows.at("below.csv");
  EXPECT_EQ(blocked.at("goal_reached"), 0.0);
  EXPECT_NEAR(blocked.at("goal_distance_m"), 0.01, 2.0 * kMargin);
  EXPECT_NEAR(blocked.at("force_max_N"), 10.0, 1000.0 * 2.0 * kMargin);
  EXPECT_GT(blocked.at("clearance_min_m"), 0.0);
  EXPECT_LT(blocked.at("clearance_min_m"), 2.0 * kMargin);
  EXPECT_NEAR(blocked.at("contact_s"), 0.05, 0.003);
}

TEST_F(AssemblyCheck, GoalToleranceDecidesGoalReached) {
  const ProgramResult strict = check({below}, {"--summary", "-"});
  const ProgramResult lax = check({below}, {"--summary", "-", "--goal-tolerance-m", "0.011"});
  EXPECT_EQ(checks_of(strict.standard_output).at("below.csv").at("goal_reached"), 0.0);
  EXPECT_EQ(checks_of(lax.standard_output).at("below.csv").at("goal_reached"), 1.0);
}

TEST_F(AssemblyCheck, MissedRequiredGoalExitsWithCode3) {
  EXPECT_EQ(check({above, below}).exit_code, 0);
  EXPECT_EQ(check({above}, {"--require-goal"}).exit_code, 0);
  const ProgramResult missed = check({above, below}, {"--require-goal"});
  EXPECT_EQ(missed.exit_code, 3);
  EXPECT_THAT(missed.standard_error, testing::HasSubstr("below.csv: the end of the trajectory is not reached: the "
                                                        "part ends 10 mm"));
  EXPECT_THAT(missed.standard_error,
              testing::HasSubstr(" mm and 0.00 degrees from it; allowed are 0.3 mm and 0.5 degrees\n"));
  EXPECT_EQ(checks_of(missed.standard_output).size(), 2U) << "the answer is there all the same";
  EXPECT_EQ(check({below}, {"--require-goal"}).exit_code, 3) << "also for the motion alone";

  const std::string inside = trajectory("inside.csv", "0,0,0,0.01,1,0,0,0\n0.1,0,0,0.1,1,0,0,0\n");
  EXPECT_EQ(check({inside, below}, {"--require-goal"}).exit_code, 1) << "a failure counts more";
}

TEST_F(AssemblyCheck, WritesAPage) {
  const ProgramResult result = check({above, below}, {"--report", folder.path("page")});
  ASSERT_EQ(result.exit_code, 0) << result.standard_error;
  EXPECT_THAT(result.standard_output, testing::HasSubstr("above.csv: end of the trajectory reached"));
  EXPECT_THAT(result.standard_output, testing::HasSubstr("below.csv: end of the trajectory not reached, 10.0"));
  EXPECT_THAT(result.standard_output, testing::HasSubstr(" degrees from it (allowed: 0.3 mm and 0.5 degrees); "));
  EXPECT_THAT(result.standard_output,
              testing::HasSubstr("\n2 trajectories: 1 reach the goal, 1 do not, 0 cannot be checked\n"));
  const std::string with_goal = folder.write("goal.yaml", read_text_file(scene) + "goal: {position_m: [0, 0, 0]}\n");
  EXPECT_THAT(test_support::glissade(
                  {"slide", with_goal, "--part", "box", "--trajectory", above, "--report", folder.path("with_goal")})
                  .standard_output,
              testing::HasSubstr("above.csv: goal not reached, "));
  EXPECT_THAT(result.standard_output, testing::EndsWith("report: " + folder.path("page") + "/index.html\n"));
  const std::string page = read_text_file(folder.path("page/index.html"));
  for (const char* part : {"Assembly check of box", "1 of 2", "above.csv", "greatest force [N]", "clearance [um]"})
    EXPECT_THAT(page, testing::HasSubstr(part));
}

TEST_F(AssemblyCheck, ThePageOfSeveralHasATableOfThem) {
  const std::string inside = trajectory("inside.csv", "0,0,0,0.01,1,0,0,0\n0.1,0,0,0.1,1,0,0,0\n");
  check({above, inside, below}, {"--report", folder.path("page")});
  const auto rows = test_support::table_of(read_text_file(folder.path("page/index.html")));
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0].at("trajectory"), above);
  EXPECT_EQ(rows[0].at("goal"), "reached");
  EXPECT_EQ(rows[0].at("pushed at the end by"), "");
  EXPECT_EQ(rows[0].at("least clearance [mm]"), "5.0000");
  EXPECT_EQ(rows[0].at("its time [s]"), "0.100");
  EXPECT_THAT(rows[1].at("goal"), testing::StartsWith("not checked: "));
  EXPECT_EQ(rows[1].at("duration [s]"), "");
  EXPECT_EQ(rows[2].at("goal"), "missed");
  EXPECT_EQ(rows[2].at("pushed at the end by"), "floor");
  EXPECT_NEAR(std::stod(rows[2].at("distance from goal [mm]")), 10.0, 2e3 * kMargin);
  EXPECT_EQ(rows[2].at("duration [s]"), "0.100");
}

TEST_F(AssemblyCheck, PrintsCountsUnlessStandardOutputIsATable) {
  const std::string inside = trajectory("inside.csv", "0,0,0,0.01,1,0,0,0\n0.1,0,0,0.1,1,0,0,0\n");
  const ProgramResult result = check({above, inside, below, above}, {"--summary", folder.path("summary.csv")});
  EXPECT_THAT(result.standard_output,
              testing::EndsWith("\n4 trajectories: 2 reach the goal, 1 do not, 1 cannot be checked\n"));
  EXPECT_THAT(check({above, below}, {}).standard_output, testing::Not(testing::HasSubstr("trajectories:")))
      << "only rows of the table";
  EXPECT_THAT(check({above}, {"--summary", folder.path("one.csv")}).standard_output,
              testing::Not(testing::HasSubstr("trajectories:")));
}

TEST_F(AssemblyCheck, ThePageNamesTheRules) {
  const auto page = [&](const std::vector<std::string>& rules) {
    std::vector<std::string> arguments{"--report", folder.path("page")};
    arguments.insert(arguments.end(), rules.begin(), rules.end());
    EXPECT_EQ(check({below}, arguments).exit_code, 0);
    return read_text_file(folder.path("page/index.html"));
  };
  EXPECT_THAT(page({}), testing::HasSubstr("<td>no friction</td>"));
  EXPECT_THAT(page({"--friction", "0.2", "0.3", "--spiral-search", "--depenetrate"}),
              testing::HasSubstr("<td>friction 0.2, at rest 0.3; spiral search; depenetrate</td>"));
}

TEST_F(AssemblyCheck, ThePageOfSeveralShowsTheFirstThatMissesTheGoal) {
  ASSERT_EQ(check({above, below, above}, {"--report", folder.path("page")}).exit_code, 0);
  const std::string page = read_text_file(folder.path("page/index.html"));
  EXPECT_THAT(test_support::titles_of(page), testing::Contains("Force on the hand, " + below));
  EXPECT_THAT(page, testing::HasSubstr("id=\"report-frames\""));
  ASSERT_EQ(check({above, above}, {"--report", folder.path("page")}).exit_code, 0);
  EXPECT_THAT(test_support::titles_of(read_text_file(folder.path("page/index.html"))),
              testing::Contains("Force on the hand, " + above));
}

TEST_F(AssemblyCheck, ReportOfOneTrajectoryPlotsForcesContactsAndStates) {
  ASSERT_EQ(check({below}, {"--report", folder.path("page")}).exit_code, 0);
  const std::string page = read_text_file(folder.path("page/index.html"));
  EXPECT_THAT(test_support::titles_of(page),
              testing::UnorderedElementsAre(
                  "Force on the hand", "Torque on the hand about the reference point of the part",
                  "Lag of the visible parts behind their ghosts", "Angle between the visible parts and their ghosts",
                  "Contacts that push", "Clearance of the visible parts, up to 2 mm", "States of the parts"));
  const nlohmann::json states = test_support::plot_of(page, "States of the parts");
  std::set<std::string> words;
  for (const nlohmann::json& word : states.at("series").at(0).at("y"))
    words.insert(states.at("words").at(word.get<std::size_t>()));
  EXPECT_THAT(words, testing::IsSupersetOf({"free", "sliding"}));
}

TEST_F(AssemblyCheck, ShowsProgressAndFinishedRowsWhileRunning) {
  // Hours of motion, which nobody waits for.
  const std::string endless = trajectory("endless.csv", "0,0,0,0.03,1,0,0,0\n86400,0.01,0,0.03,1,0,0,0\n");
  const std::string summary = folder.path("summary.csv");
  const std::string command = std::string(GLISSADE_PROGRAM) + " slide " + scene + " --part box --trajectory " + above +
                              " " + endless + " --summary " + summary;
  // `script` gives it a terminal; the test reads what appears there.
  const test_support::Process program({"/bin/sh", "-c", "exec script -qefc '" + command + "' /dev/null >&2"});
  const std::string bar = " of 86400.2";  // seconds of both together, of which the second has not ended
  std::string rows;
  std::string terminal;
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (std::chrono::steady_clock::now() < deadline &&
         (terminal.find(bar) == std::string::npos || rows.find("above.csv") == std::string::npos)) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    terminal = program.standard_error();
    rows = std::filesystem::exists(summary) ? read_text_file(summary) : "";
  }
  EXPECT_THAT(terminal, testing::HasSubstr(bar));
  EXPECT_EQ(checks_of(rows).size(), 1u) << rows;
  EXPECT_EQ(checks_of(rows).count("above.csv"), 1u) << rows;
}

TEST_F(AssemblyCheck, MaximumTorqueEqualsThatOfTheMotionTable) {
  // Held by a corner and turned, so that there is a torque, and it depends on the point that it is about.
  const std::string by_corner = folder.write("corner.yaml",
                                             "objects:\n"
                                             "  - {name: box, movable: true, compliance_point_m: [0.05, 0.03, 0.02], "
                                             "shape: {type: box, size_x_m: 0.1, size_y_m: "
                                             "0.06, size_z_m: 0.04}}\n"
                                             "  - {name: floor, shape: {type: plate, size_x_m: 0.5, size_y_m: 0.5}}\n");
  const std::string motion = folder.path("out.csv");
  const std::string turned = trajectory("turned.csv", "5,0,0,0.03,1,0,0,0\n5.1,0.02,0,0.01,0.9962,0.0,0.0872,0\n");
  const ProgramResult result = test_support::glissade(
      {"slide", by_corner, "--part", "box", "--trajectory", turned, "--summary", "-", "--out", motion});
  ASSERT_EQ(result.exit_code, 0) << result.standard_error;
  double torque_Nm = 0.0;
  for (const test_support::CsvRow& row : test_support::rows_of(read_text_file(motion))) {
    torque_Nm = std::max(
        torque_Nm, std::hypot(std::stod(row.at("tx_Nm")), std::stod(row.at("ty_Nm")), std::stod(row.at("tz_Nm"))));
  }
  EXPECT_GT(torque_Nm, 0.1);
  EXPECT_NEAR(checks_of(result.standard_output)["turned.csv"]["torque_max_Nm"], torque_Nm, 1e-9);
}

TEST_F(AssemblyCheck, OneRunWritesEverything) {
  const auto file = [&](const std::string& name) { return folder.path(name); };
  const ProgramResult all =
      check({below}, {"--out", file("out.csv"), "--contacts", file("contacts.csv"), "--patches", file("patches.csv"),
                      "--summary", file("summary.csv"), "--report", file("page")});
  ASSERT_EQ(all.exit_code, 0) << all.standard_error;
  EXPECT_THAT(all.standard_output, testing::HasSubstr("below.csv: end of the trajectory not reached, 10.0"))
      << "no table is in its way";
  EXPECT_THAT(read_text_file(file("page/index.html")), testing::HasSubstr("Assembly check of box"));
  // Each is what a run for it alone writes.
  EXPECT_EQ(read_text_file(file("out.csv")), check({below}).standard_output);
  EXPECT_EQ(read_text_file(file("summary.csv")), check({below}, {"--summary", "-"}).standard_output);
  for (const char* table : {"contacts", "patches"}) {
    ASSERT_EQ(check({below}, {"--" + std::string(table), file("alone.csv")}).exit_code, 0);
    EXPECT_EQ(read_text_file(file(table + std::string(".csv"))), read_text_file(file("alone.csv")));
  }
}

TEST_F(AssemblyCheck, TrajectoryThatCannotStartDoesNotStopTheOthers) {
  const std::string inside = trajectory("inside.csv", "0,0,0,0.01,1,0,0,0\n0.1,0,0,0.1,1,0,0,0\n");
  const ProgramResult result = check({inside, above});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.standard_error, testing::HasSubstr("inside.csv: the part collides with 'floor'"));
  EXPECT_EQ(checks_of(result.standard_output).size(), 1U);
}

TEST_F(AssemblyCheck, GivesTheSameBytesAgain) {
  const std::vector<std::string> many{above, below, above, below, below};
  EXPECT_EQ(check(many).standard_output, check(many).standard_output);
}

TEST_F(AssemblyCheck, RefusesInvalidOptions) {
  expect_refused({"slide", scene, "--part", "box", "--trajectory", above, below, "--out", folder.path("rows.csv")},
                 {"--out", "--summary"});
  expect_refused({"slide", scene, "--part", "box", "--trajectory", above, below, "--contacts", folder.path("rows.csv")},
                 {"--contacts", "one trajectory"});
  expect_refused({"slide", scene, "--part", "box", "--trajectory", above, folder.path("none.csv")}, {"none.csv"});
  expect_refused({"slide", scene, "--part", "box", "--trajectory", "a,b.csv", above},
                 {"--trajectory", "'a,b.csv'", "comma"});
}

}  // namespace
}  // namespace glissade::apps
