/// `glissade slide`: a box led over a plane, into a groove and into a corner, as files in and a file out.

#include <algorithm>
#include <cmath>
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glissade/apps/text.h>
#include <glissade/files/text_file.h>

#include "glissade_program.h"
#include "report_page.h"
#include "temporary_folder.h"

namespace glissade::apps {
namespace {

using test_support::expect_fails;
using test_support::expect_refused;
using test_support::kTwoMargins;
using test_support::ProgramResult;
using test_support::rows_of;

/// One row of the answer by column name; the state's text is left out.
using Row = std::map<std::string, double>;

std::vector<Row> ticks_of(const std::string& csv) {
  std::vector<Row> rows;
  for (const test_support::CsvRow& cells : rows_of(csv)) {
    Row& row = rows.emplace_back();
    for (const auto& [column, cell] : cells) {
      if (!column.starts_with("state")) row[column] = std::stod(cell);
    }
  }
  return rows;
}

class Slide : public testing::Test {
 protected:
  /// A 0.1 × 0.06 × 0.04 m box, finely cut, and sheets in the given poses.
  std::string scene(const std::vector<std::string>& sheet_poses) const {
    std::string text =
        "objects:\n"
        "  - {name: box, movable: true, shape: {type: box, size_x_m: 0.1, size_y_m: 0.06, size_z_m: 0.04, triangles: "
        "600}}\n";
    for (std::size_t i = 0; i < sheet_poses.size(); ++i) {
      text += "  - {name: sheet" + std::to_string(i) +
              ", shape: {type: plate, size_x_m: 0.5, size_y_m: 0.5, triangles: 900}, pose: " + sheet_poses[i] + "}\n";
    }
    return folder.write("scene.yaml", text);
  }

  std::string trajectory(const std::string& rows) const {
    return folder.write("hand.csv", "t_s,x_m,y_m,z_m,qw,qx,qy,qz\n" + rows);
  }

  std::vector<Row> slide(const std::string& scene_file, const std::string& trajectory_file,
                         const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments{"slide", scene_file, "--part", "box", "--trajectory", trajectory_file};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramResult result = test_support::glissade(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.standard_error;
    const bool is_paper = std::find(more.begin(), more.end(), "paper") != more.end();
    EXPECT_EQ(result.standard_output.substr(0, result.standard_output.find('\n')),
              std::string("t_s,gx_m,gy_m,gz_m,gqw,gqx,gqy,gqz,vx_m,vy_m,vz_m,vqw,vqx,vqy,vqz,"
                          "fx_N,fy_N,fz_N,tx_Nm,ty_Nm,tz_Nm,contacts,state") +
                  (is_paper ? ",states" : ""));
    return ticks_of(result.standard_output);
  }

  test_support::TemporaryFolder folder;
  const std::string floor = "{position_m: [0, 0, 0]}";
  // Quarter turns about y and x stand a sheet upright.
  const std::string wall_x = "{position_m: [0, 0, 0], orientation_wxyz: [0.70710678, 0, 0.70710678, 0]}";
  const std::string wall_y = "{position_m: [0, 0, 0], orientation_wxyz: [0.70710678, 0.70710678, 0, 0]}";
};

TEST_F(Slide, OverAPlaneTheBoxStaysOnItAndFollowsTheGhost) {
  const auto rows = slide(scene({floor}), trajectory("0,-0.1,0,0.03,1,0,0,0\n"
                                                     "0.1,-0.1,0,0.017,1,0,0,0\n"
                                                     "0.3,0.1,0.02,0.017,1,0,0,0\n"));
  ASSERT_EQ(rows.size(), 301u);
  EXPECT_DOUBLE_EQ(rows[150].at("t_s"), 0.15);
  for (std::size_t i = 100; i < rows.size(); ++i) {
    const Row& row = rows[i];
    EXPECT_NEAR(row.at("vx_m"), row.at("gx_m"), kTwoMargins);
    EXPECT_NEAR(row.at("vy_m"), row.at("gy_m"), kTwoMargins);
    EXPECT_NEAR(row.at("vz_m"), 0.02, kTwoMargins);
    EXPECT_NEAR(row.at("fz_N"), 1000.0 * 0.003, 1000.0 * kTwoMargins);
    EXPECT_GE(row.at("contacts"), 1.0);
  }
  for (std::size_t i = 0; i < 50; ++i) {
    for (const char* column : {"fx_N", "fy_N", "fz_N", "tx_Nm", "ty_Nm", "tz_Nm"})
      EXPECT_EQ(rows[i].at(column), 0.0);
  }
}

// The part needs some time to follow.
TEST_F(Slide, AJumpInFreeSpaceGivesNoForce) {
  const auto rows = slide(scene({floor}), trajectory("0,0,0,1,1,0,0,0\n0.001,0.1,0,1,1,0,0,0\n0.5,0.1,0,1,1,0,0,0\n"));
  EXPECT_LT(rows[1].at("vx_m"), 0.09);
  EXPECT_NEAR(rows.back().at("vx_m"), 0.1, 1e-9);
  for (const Row& row : rows) {
    for (const char* column : {"fx_N", "fy_N", "fz_N", "tx_Nm", "ty_Nm", "tz_Nm"})
      ASSERT_EQ(row.at(column), 0.0) << row.at("t_s") << " s";
  }
}

TEST_F(Slide, InAGrooveItFollowsTheGhostAlongIt) {
  const auto rows = slide(scene({floor, wall_x}), trajectory("0,0.06,-0.1,0.03,1,0,0,0\n"
                                                             "0.1,0.047,-0.1,0.018,1,0,0,0\n"
                                                             "0.3,0.047,0.1,0.018,1,0,0,0\n"));
  for (std::size_t i = 100; i < rows.size(); ++i) {
    EXPECT_NEAR(rows[i].at("vx_m"), 0.05, kTwoMargins);
    EXPECT_NEAR(rows[i].at("vy_m"), rows[i].at("gy_m"), kTwoMargins);
    EXPECT_NEAR(rows[i].at("vz_m"), 0.02, kTwoMargins);
  }
}

TEST_F(Slide, InACornerItStops) {
  const auto rows = slide(scene({floor, wall_x, wall_y}), trajectory("0,0.06,0.04,0.03,1,0,0,0\n"
                                                                     "0.1,0.047,0.028,0.016,1,0,0,0\n"
                                                                     "0.2,0.046,0.027,0.018,1,0,0,0\n"));
  for (std::size_t i = 100; i < rows.size(); ++i) {
    const double dx = rows[i].at("vx_m") - 0.05;
    const double dy = rows[i].at("vy_m") - 0.03;
    const double dz = rows[i].at("vz_m") - 0.02;
    EXPECT_LT(std::sqrt(dx * dx + dy * dy + dz * dz), kTwoMargins);
  }
}

TEST_F(Slide, ContactAndPatchForcesSumToTheHandForce) {
  const std::string hand =
      trajectory("0,0.06,0,0.03,1,0,0,0\n0.1,0.047,0,0.018,1,0,0,0\n0.2,0.047,0.02,0.018,1,0,0,0\n");
  const ProgramResult result =
      test_support::glissade({"slide", scene({floor, wall_x}), "--part", "box", "--trajectory", hand, "--contacts",
                              folder.path("contacts.csv"), "--patches", folder.path("patches.csv")});
  ASSERT_EQ(result.exit_code, 0) << result.standard_error;
  const auto motion = ticks_of(result.standard_output);
  const Row& last = motion.back();

  std::map<std::string, double> force_by_obstacle;
  double force_x = 0.0;
  for (const auto& row : rows_of(read_text_file(folder.path("contacts.csv")))) {
    const auto number = [&](const char* column) { return std::stod(row.at(column)); };
    for (const char axis : {'x', 'y', 'z'}) {
      const std::string a(1, axis);
      EXPECT_NEAR(std::stod(row.at("p" + a + "_m")) - std::stod(row.at("q" + a + "_m")),
                  number("gap_m") * std::stod(row.at("n" + a)), 1e-12);
    }
    EXPECT_GE(number("id"), 1.0);
    EXPECT_LE(number("age_ms"), 200.0);
    if (number("t_s") != 0.2) continue;
    force_by_obstacle[row.at("obstacle")] += number("force_N");
    force_x += number("force_N") * number("nx");
  }
  EXPECT_EQ(force_by_obstacle.size(), 2u);
  EXPECT_NEAR(force_by_obstacle["sheet0"], last.at("fz_N"), 0.02);
  EXPECT_NEAR(force_by_obstacle["sheet1"], last.at("fx_N"), 0.02);
  EXPECT_NEAR(force_x, last.at("fx_N"), 0.02);

  int patches = 0;
  for (const auto& row : rows_of(read_text_file(folder.path("patches.csv")))) {
    if (std::stod(row.at("t_s")) != 0.2) continue;
    ++patches;
    EXPECT_NEAR(std::stod(row.at("fx_N")) + std::stod(row.at("fz_N")), force_by_obstacle[row.at("obstacle")], 1e-9);
    EXPECT_GE(std::stod(row.at("contacts")), 2.0);
  }
  EXPECT_EQ(patches, 2);
}

TEST_F(Slide, RefusesTwoTablesInOneFile) {
  const std::string hand = trajectory("0,0,0,0.03,1,0,0,0\n0.01,0,0,0.03,1,0,0,0\n");
  const auto slide_with = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"slide", scene({floor}), "--part", "box", "--trajectory", hand};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  };
  expect_refused(slide_with({"--contacts", "-"}), {"--contacts", "'-'", "--out"});
  expect_refused(slide_with({"--out", "a.csv", "--patches", "a.csv"}), {"--patches", "'a.csv'", "--out"});
  expect_refused(slide_with({"--contacts", "a.csv", "--patches", "a.csv"}), {"--patches", "--contacts"});
  expect_refused(slide_with({"--out", "a.csv", "--summary", "./a.csv"}), {"--summary", "'./a.csv'", "--out"});
  const std::string odd = folder.write("odd.yaml",
                                       "objects:\n"
                                       "  - {name: box, movable: true, shape: {type: box}}\n"
                                       "  - {name: 'a,b', shape: {type: plate}, pose: {position_m: [0, 0, -3]}}\n");
  expect_refused({"slide", odd, "--part", "box", "--trajectory", hand, "--contacts", folder.path("c.csv")},
                 {"odd.yaml", "'a,b'", "comma"});
}

TEST_F(Slide, TheMethodOfThePaperSlidesOnAPlaneOfTwoTriangles) {
  const std::string scene_file =
      folder.write("coarse.yaml",
                   "objects:\n"
                   "  - {name: box, movable: true, shape: {type: box, size_x_m: 0.1, size_y_m: 0.06, size_z_m: 0.04, "
                   "triangles: 12}}\n"
                   "  - {name: sheet, shape: {type: plate, size_x_m: 0.5, size_y_m: 0.5, triangles: 2}}\n");
  const std::string hand = trajectory("0,-0.1,0,0.03,1,0,0,0\n0.1,-0.1,0,0.017,1,0,0,0\n0.3,0.1,0.02,0.017,1,0,0,0\n");
  const auto rows = slide(scene_file, hand, {"--method", "paper"});
  for (std::size_t i = 100; i < rows.size(); ++i) {
    EXPECT_NEAR(rows[i].at("vx_m"), rows[i].at("gx_m"), 1e-6);
    // It stops within half a micrometre of the contact, where the default keeps its margin of several.
    EXPECT_NEAR(rows[i].at("vz_m"), 0.02, 0.5e-6);
    EXPECT_NEAR(rows[i].at("fz_N"), 3.0, 1e-3);
    EXPECT_GE(rows[i].at("contacts"), 1.0);
  }
  EXPECT_GT(slide(scene_file, hand).back().at("vz_m"), 0.02 + 2e-6) << "the default";
}

TEST_F(Slide, ThePapersMethodTellsTheStatesThatItWentThrough) {
  const std::string hand = trajectory("0,0,0,0.03,1,0,0,0\n0.01,0,0,0.018,1,0,0,0\n");
  const ProgramResult result =
      test_support::glissade({"slide", scene({floor}), "--part", "box", "--trajectory", hand, "--method", "paper"});
  ASSERT_EQ(result.exit_code, 0) << result.standard_error;
  const auto rows = rows_of(result.standard_output);
  EXPECT_EQ(rows[1].at("states"), "moving>done") << "nothing in the way";
  EXPECT_THAT(rows.back().at("states"), testing::StartsWith("moving>bisecting>classifying>new-direction>criterion"));
  EXPECT_THAT(rows.back().at("states"), testing::EndsWith(">done"));
}

TEST_F(Slide, StartingInsideAnObstacleIsAFailureWithItsReason) {
  expect_fails(
      1,
      {"slide", scene({floor}), "--part", "box", "--trajectory", trajectory("0,0,0,0.01,1,0,0,0\n1,0,0,0.1,1,0,0,0\n")},
      {"hand.csv", "collides with 'sheet0'", "first row", "at most 10 mm deep in 'sheet0'", "--depenetrate"});
  // In two at once; and what the paper's method cannot do is not proposed.
  const std::string corner = trajectory("0,0.04,0,0.015,1,0,0,0\n1,0,0,0.1,1,0,0,0\n");
  const ProgramResult result = test_support::glissade(
      {"slide", scene({floor, wall_x}), "--part", "box", "--trajectory", corner, "--method", "paper"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.standard_error,
              testing::HasSubstr(": at most 5 mm deep in 'sheet0', at most 10 mm deep in 'sheet1'\n"));
}

TEST_F(Slide, APartMustBeMovable) {
  const std::string hand = trajectory("0,0,0,0.03,1,0,0,0\n0.01,0,0,0.03,1,0,0,0\n");
  expect_refused({"slide", scene({floor}), "--part", "sheet0", "--trajectory", hand},
                 {"--part", "'sheet0'", "scene.yaml", "movable: true"});
}

TEST_F(Slide, APartThatStartsInsideIsDepenetratedOnRequest) {
  const std::string hand = trajectory("0,0,0,0.019,1,0,0,0\n0.1,0,0,0.019,1,0,0,0\n");
  const auto rows = slide(scene({floor}), hand, {"--depenetrate"});
  EXPECT_LT(rows.front().at("vz_m"), 0.0193) << "at limited speed";
  EXPECT_NEAR(rows.back().at("vz_m"), 0.02, 1e-5) << "half of the box above the floor";
}

TEST_F(Slide, PartOfNominalFitLeavesTheSlotButNotThroughItsWalls) {
  const auto ends_at = [&](const std::string& left, const std::string& hand, const std::vector<std::string>& options) {
    const std::string file =
        folder.write("slot.yaml",
                     "objects:\n"
                     "- {name: right, shape: {type: box, size_x_m: 0.002, size_y_m: 0.1, size_z_m: 0.04}, "
                     "pose: {position_m: [0.011, 0, 0]}}\n"
                     "- {name: left, shape: {type: box, size_x_m: 0.002, size_y_m: 0.1, size_z_m: 0.04}, "
                     "pose: {position_m: [" +
                         left +
                         ", 0, 0]}}\n"
                         "- {name: box, movable: true, shape: {type: box, size_x_m: 0.02, size_y_m: 0.02, "
                         "size_z_m: 0.02}}\n");
    return slide(file, hand, options).back();
  };
  const std::string up = trajectory("0,0,0,0,1,0,0,0\n0.3,0,0,0.05,1,0,0,0\n0.35,0,0,0.05,1,0,0,0\n");
  EXPECT_NEAR(ends_at("-0.011", up, {}).at("vz_m"), 0.05, 1e-9) << "the faces coincide";
  EXPECT_NEAR(ends_at("-0.0109", up, {"--depenetrate"}).at("vz_m"), 0.05, 1e-9) << "0.1 mm too thick";
  const std::string aside = trajectory("0,0,0,0,1,0,0,0\n0.3,0.05,0,0,1,0,0,0\n");
  for (const char* left : {"-0.011", "-0.0109"})
    EXPECT_LT(std::abs(ends_at(left, aside, {"--depenetrate"}).at("vx_m")), 1e-5) << left;
}

TEST_F(Slide, WarnsOfAPartInsideAClosedSolid) {
  const std::string hand = trajectory("0,0,0,0,1,0,0,0\n0.01,0,0,0,1,0,0,0\n");
  const auto warnings = [&](const std::string& around) {
    const std::string file = folder.write(
        "around.yaml",
        "objects:\n- {name: around, " + around +
            "}\n- {name: box, movable: true, shape: {type: box, size_x_m: 0.02, size_y_m: 0.02, size_z_m: 0.02}}\n");
    return test_support::glissade({"slide", file, "--part", "box", "--trajectory", hand}).standard_error;
  };
  EXPECT_EQ(
      warnings("shape: {type: box}"),
      "glissade: warning: " + hand + ": part 'box' starts inside the closed surface of 'around', and cannot get out\n");
  EXPECT_EQ(warnings("shape: {type: box}, pose: {position_m: [0.08, 0, 0]}"), "") << "beside it";
  EXPECT_EQ(warnings("shape: {type: tube}"), "") << "it can get out";
  EXPECT_EQ(warnings("shape: {type: torus}"), "") << "in its hole";
  EXPECT_EQ(warnings("shape: {type: box, size_x_m: 0.01}").find("warning"), std::string::npos) << "it collides";
}

TEST_F(Slide, FrictionHoldsThePartBack) {
  // Pressed by 2 N, drawn by 1 N.
  const std::string hand = trajectory("0,0,0,0.021,1,0,0,0\n0.1,0,0,0.018,1,0,0,0\n0.2,0.001,0,0.018,1,0,0,0\n");
  const auto reached = [&](const std::vector<std::string>& options) {
    return slide(scene({floor}), hand, options).back().at("vx_m");
  };
  EXPECT_NEAR(reached({}), 1e-3, 1e-6);
  EXPECT_NEAR(reached({"--friction", "0.25"}), 0.5e-3, 1e-5);
  EXPECT_NEAR(reached({"--friction", "0.25", "0.6"}), 0.0, 1e-6) << "at rest it holds more";
  EXPECT_EQ(reached({"--friction", "0"}), reached({}));
}

TEST_F(Slide, TheForceIsStiffnessTimesDepth) {
  const std::string hand = trajectory("0,0,0,0.021,1,0,0,0\n0.1,0,0,0.018,1,0,0,0\n0.2,0,0,0.018,1,0,0,0\n");
  const auto force = [&](const std::vector<std::string>& options) {
    return slide(scene({floor}), hand, options).back().at("fz_N");
  };
  EXPECT_NEAR(force({}), 1000.0 * 0.002, 1000.0 * kTwoMargins);
  EXPECT_NEAR(force({"--stiffness", "300"}), 300.0 * 0.002, 300.0 * kTwoMargins);
  EXPECT_NEAR(force({"--stiffness", "5000", "--method", "paper"}), 5000.0 * 0.002, 0.01 * 5000.0 * 0.002);
}

TEST_F(Slide, PrintsOutcomeUnlessStandardOutputIsATable) {
  const std::string hand = trajectory("0,0,0,0.03,1,0,0,0\n0.01,0,0,0.03,1,0,0,0\n");
  const ProgramResult result = test_support::glissade(
      {"slide", scene({floor}), "--part", "box", "--trajectory", hand, "--out", folder.path("motion.csv")});
  EXPECT_EQ(result.standard_output,
            hand + ": end of the trajectory reached, 0.000 mm and 0.00 degrees from it; at most 0.00 N and " +
                "0.000 Nm about the part's reference point; 0.000 of 0.010 s in contact\n");
}

TEST_F(Slide, RefusesInvalidRules) {
  const std::string hand = trajectory("0,0,0,0.03,1,0,0,0\n0.01,0,0,0.03,1,0,0,0\n");
  const auto slide_with = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"slide", scene({floor}), "--part", "box", "--trajectory", hand};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  };
  expect_refused(slide_with({"--friction", "-0.1"}), {"--friction: must be at least 0, not -0.1"});
  expect_refused(slide_with({"--stiffness", "-1"}), {"--stiffness: must be above 0, not -1"});
  expect_refused(slide_with({"--stiffness", "1"}), {"--stiffness: must lie between 10 and 100000 N/m, not 1"});
  expect_refused(slide_with({"--stiffness", "nan"}), {"--stiffness"});
  expect_refused(slide_with({"--friction", "0.3", "0.2"}), {"--friction", "at rest"});
  expect_refused(slide_with({"--method", "paper", "--spiral-search"}), {"--method", "--spiral-search"});
}

TEST_F(Slide, ObjectTooFarAwayOrWithoutAreaIsNamed) {
  const std::string hand = trajectory("0,0,0,0.03,1,0,0,0\n0.01,0,0,0.03,1,0,0,0\n");
  const std::string far = "{position_m: [0, 1.0e+9, 0]}";
  const auto slide_part = [&](const std::string& scene_file, const std::string& part) {
    return std::vector<std::string>{"slide", scene_file, "--part", part, "--trajectory", hand};
  };
  for (const char* part : {"box", "sheet1"}) {
    expect_refused(slide_part(scene({floor, far}), part), {"scene.yaml", "'sheet1'", "beyond ±1e9"});
  }
  // So small that its area is rounded to nothing, the sphere has none among obstacles that have.
  const std::string tiny = folder.write("tiny.yaml",
                                        "objects:\n"
                                        "  - {name: box, shape: {type: box}}\n"
                                        "  - {name: plate, shape: {type: plate}}\n"
                                        "  - name: dust\n"
                                        "    shape: {type: sphere, radius_m: 1.0e-9}\n"
                                        "    pose: {position_m: [1.0e+8, 1.0e+8, 1.0e+8]}\n");
  for (const char* part : {"box", "dust"}) {
    expect_refused(slide_part(tiny, part), {"tiny.yaml", "'dust'", "no triangle of positive area"});
  }
}

TEST_F(Slide, RefusesInvalidInput) {
  const std::string good = trajectory("0,0,0,0.03,1,0,0,0\n0.01,0,0,0.03,1,0,0,0\n");
  expect_refused({"slide", scene({floor}), "--part", "motor", "--trajectory", good}, {"motor", "box, sheet0"});
  expect_refused({"slide", scene({floor}), "--part", "box", "--trajectory", good, "--metaphor", "glue"},
                 {"--metaphor", "glue", "force-feedback, rubber-band, rubber-band-spring, incremental"});
  expect_refused({"slide", scene({floor}), "--part", "box", "--trajectory", good, "--method", "glue"},
                 {"--method", "glue", "projection, paper"});
  expect_refused({"slide", scene({}), "--part", "box", "--trajectory", good}, {"scene.yaml", "nothing but"});
  const std::string scene_file = scene({floor});
  expect_refused({"slide", scene_file, "--part", "box", "--trajectory", folder.path("none.csv")}, {"none.csv"});
  const std::string long_one = trajectory("0,0,0,0.03,1,0,0,0\n86401,0,0,0.03,1,0,0,0\n");
  expect_refused({"slide", scene_file, "--part", "box", "--trajectory", long_one}, {"hand.csv", "86401 s", "a day"});
  const std::string standing = trajectory("0,0,0,0.03,1,0,0,0\n0.01,0,0,0.03,1,0,0,0\n0.01,0,0,0.04,1,0,0,0\n");
  expect_refused({"slide", scene_file, "--part", "box", "--trajectory", standing}, {"hand.csv:4", "0.01"});
  const std::string skewed = trajectory("0,0,0,0.03,1,0,0.1,0\n0.01,0,0,0.03,1,0,0,0\n");
  expect_refused({"slide", scene_file, "--part", "box", "--trajectory", skewed}, {"hand.csv:2"});
}

TEST_F(Slide, AReportOfOneTrajectoryShowsItInThreeDimensions) {
  const std::string scene_file = scene({floor});
  const std::string way = trajectory("0,0,0,0.05,1,0,0,0\n0.2,0,0,0.01,1,0,0,0\n");
  const auto page = [&](const std::vector<std::string>& ways) {
    std::vector<std::string> arguments{"slide", scene_file, "--part", "box", "--report", folder.path("report")};
    for (const std::string& one : ways)
      arguments.insert(arguments.end(), {"--trajectory", one});
    const ProgramResult result = test_support::glissade(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.standard_error;
    return read_text_file(folder.path("report/index.html"));
  };
  const std::string single = page({way});
  EXPECT_THAT(single, testing::HasSubstr("report-frames\">"));
  const nlohmann::json times = test_support::plots_of(single).at(0).at("series").at(0).at("x");
  EXPECT_EQ(times.front(), 0.0);
  EXPECT_EQ(times.back(), 0.2);
}

}  // namespace
}  // namespace glissade::apps
