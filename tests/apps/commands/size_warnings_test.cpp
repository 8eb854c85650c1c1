/// Wrong units: the program computes what it is told, and says what is probably wrong.

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glissade/apps/commands/size_warnings.h>
#include <glissade/apps/text.h>
#include <glissade/devices/glove_device.h>
#include <glissade/files/text_file.h>

#include "glissade_program.h"
#include "temporary_folder.h"

namespace glissade::apps {
namespace {

using test_support::glissade;
using test_support::ProgramResult;
using testing::HasSubstr;
using testing::Not;

class WrongUnits : public testing::Test {
 protected:
  /// A tetrahedron of this size as a mesh file.
  std::string mesh(const std::string& name, const std::string& size) const {
    return folder.write(name, "v 0 0 0\nv " + size + " 0 0\nv 0 " + size + " 0\nv 0 0 " + size +
                                  "\nf 1 2 3\nf 1 2 4\nf 1 3 4\nf 2 3 4\n");
  }

  ProgramResult slide(const std::string& part, const std::string& obstacle, const std::string& height) const {
    const std::string scene = folder.write(
        "scene.yaml", "objects:\n- {name: part, movable: true, " + part + "}\n- {name: block, " + obstacle + "}\n");
    const std::string hand = folder.write(
        "hand.csv", "t_s,x_m,y_m,z_m,qw,qx,qy,qz\n0,0,0," + height + ",1,0,0,0\n0.01,0,0," + height + ",1,0,0,0\n");
    return glissade({"slide", scene, "--part", "part", "--trajectory", hand});
  }

  test_support::TemporaryFolder folder;
  const std::string small = mesh("small.obj", "0.06");
  const std::string large = mesh("large.obj", "60");  // the same in millimetres
};

TEST_F(WrongUnits, InfoReportsSizeAndProposesAScale) {
  EXPECT_THAT(glissade({"info", small}).standard_output, HasSubstr(" 0.06 m across\n"));
  EXPECT_THAT(glissade({"info", large}).standard_output, HasSubstr(" 60 m across: millimetres? --scale 0.001\n"));
  EXPECT_EQ(glissade({"info", large, "--scale", "0.001"}).standard_output, glissade({"info", small}).standard_output);
  test_support::expect_refused({"info", large, "--scale", "0"}, {"--scale"});
  test_support::expect_refused({"info", large, "--scale", "nan"}, {"--scale"});
}

TEST_F(WrongUnits, CollideWarnsAndTakesAScaleForEach) {
  const std::string poses = folder.write("poses.csv", "x_m,y_m,z_m,qw,qx,qy,qz\n0.05,0,0,1,0,0,0\n0.07,0,0,1,0,0,0\n");
  const std::string right = "pose,colliding\n0,1\n1,0\n";
  const ProgramResult wrong = glissade({"collide", large, small, "--poses", poses});
  EXPECT_EQ(wrong.exit_code, 0);
  EXPECT_EQ(wrong.standard_error, "glissade: warning: " + large + ": is 60 m across: millimetres? --scale 0.001\n");
  const ProgramResult each = glissade({"collide", large, small, "--poses", poses, "--scale", "0.001", "1"});
  EXPECT_EQ(each.standard_output, right);
  EXPECT_EQ(each.standard_error, "");
  EXPECT_EQ(glissade({"collide", large, large, "--poses", poses, "--scale", "0.001"}).standard_output, right);

  const std::string far = folder.write("far.csv", "x_m,y_m,z_m,qw,qx,qy,qz\n50,0,0,1,0,0,0\n70,0,0,1,0,0,0\n");
  EXPECT_THAT(glissade({"collide", small, small, "--poses", far}).standard_error,
              HasSubstr("warning: " + far + ": no pose brings the meshes, 0.06 m and 0.06 m across, near"));
  const std::string far_mesh = folder.write("far.obj", "v 50 0 0\nv 50.05 0 0\nv 50 0.05 0\nf 1 2 3\n");
  EXPECT_THAT(glissade({"collide", small, far_mesh}).standard_error, HasSubstr("m across, stand far from each other"));
}

TEST_F(WrongUnits, SlideWarnsOfAMeshInMillimetres) {
  const ProgramResult result = slide("mesh: small.obj", "mesh: large.obj", "-0.1");
  EXPECT_EQ(result.exit_code, 0) << result.standard_error;
  EXPECT_THAT(result.standard_error,
              HasSubstr("scene.yaml: object 'block' is 60 m across: millimetres? scale: 0.001\n"));
  EXPECT_EQ(slide("mesh: small.obj", "mesh: large.obj, scale: 0.001", "-0.1").standard_error, "");
  // A large shape is meant to be: its parameters are in metres.
  EXPECT_EQ(slide("mesh: small.obj", "shape: {type: plate, size_x_m: 60, size_y_m: 60}", "0.1").standard_error, "");
}

TEST_F(WrongUnits, RunDemoAndGraspWarnToo) {
  const std::string scene = folder.write("scene.yaml",
                                         "objects:\n"
                                         "- {name: part, movable: true, mesh: small.obj}\n"
                                         "- {name: block, mesh: large.obj, pose: {position_m: [0, 0, 1]}}\n"
                                         "script: hand.csv\n");
  folder.write("hand.csv", "t_s,x_m,y_m,z_m,qw,qx,qy,qz\n0,0,0,0,1,0,0,0\n1,0,0,0,1,0,0,0\n");
  const std::string warning = "warning: " + scene + ": object 'block' is 60 m across: millimetres? scale: 0.001\n";
  EXPECT_THAT(glissade({"demo", "--offline", "--seconds", "0.01", "--scene", scene}).standard_error,
              HasSubstr(warning));
  const std::string all = read_text_file(GLISSADE_SCENES "/ball_and_tray_hand.csv");
  const std::string start = folder.write("start.csv", all.substr(0, all.find('\n', all.find("\n0,") + 1) + 1));
  const ProgramResult grasp = glissade({"grasp", scene, "--hand-trajectory", start});
  EXPECT_EQ(grasp.exit_code, 0) << grasp.standard_error;
  EXPECT_THAT(grasp.standard_error, HasSubstr(warning));
  // A server that ends at once, because its part is in the way.
  folder.write("scene.yaml",
               "objects:\n"
               "- {name: part, movable: true, mesh: small.obj}\n"
               "- {name: block, mesh: large.obj}\n");
  EXPECT_THAT(glissade({"run", scene, "--lcm", "udpm://239.255.76.67:7667?ttl=0"}).standard_error, HasSubstr(warning));
}

TEST_F(WrongUnits, GraspWarnsOfDegreesAndOfAHandFarAway) {
  const std::string scene = GLISSADE_SCENES "/ball_and_tray.yaml";
  const std::string all = read_text_file(GLISSADE_SCENES "/ball_and_tray_hand.csv");
  const std::string header = all.substr(0, all.find('\n') + 1);
  const auto warning = [&](const std::string& x, const std::string& angle) {
    std::string row = "," + x + ",0,0.5,1,0,0,0";
    for (int joint = 0; joint < hands::kJoints; ++joint)
      row += "," + angle;
    const std::string hand = folder.write("fingers.csv", header + "0" + row + "\n0.01" + row + "\n");
    return glissade({"grasp", scene, "--hand-trajectory", hand}).standard_error;
  };
  EXPECT_EQ(warning("0.3", "0.1"), "");
  EXPECT_THAT(warning("0.3", "60"), HasSubstr("fingers.csv: angles of joints up to 60 rad: degrees?\n"));
  EXPECT_THAT(warning("300", "0.1"), HasSubstr("fingers.csv: the hand stays more than 300 m away from everything"));
}

TEST_F(WrongUnits, ViewAndExportWarnOfMeshesToo) {
  const std::string scene = folder.write("scene.yaml", "objects: [{name: block, mesh: large.obj}]\n");
  const std::string warning = "warning: " + scene + ": object 'block' is 60 m across: millimetres? scale: 0.001\n";
  EXPECT_THAT(glissade({"export", scene, "--out", folder.path("all.obj")}).standard_error, HasSubstr(warning));
  EXPECT_THAT(glissade({"view", scene, "--port", "0", "--seconds", "0.1", "--lcm", "memq://"}).standard_error,
              HasSubstr(warning));
}

TEST_F(WrongUnits, WarnsOfALargePartMeshButNotOfALargeObstacle) {
  mesh("screw.obj", "8");
  const std::string warning = "object 'part' is 8 m across: millimetres? scale: 0.001\n";
  EXPECT_THAT(slide("mesh: screw.obj", "mesh: screw.obj", "-20").standard_error, HasSubstr(warning));
  EXPECT_THAT(slide("mesh: screw.obj", "mesh: screw.obj", "-20").standard_error, Not(HasSubstr("'block'")))
      << "a car has obstacles of this size";
}

TEST_F(WrongUnits, SlideWarnsOfAPartThousandsOfTimesAsLargeAsAllElse) {
  const std::string dust = "shape: {type: sphere, radius_m: 5.0e-6}";
  const ProgramResult result = slide("shape: {type: box, size_x_m: 0.1, size_y_m: 0.1, size_z_m: 0.1}", dust, "0.06");
  EXPECT_THAT(result.standard_error,
              HasSubstr("object 'part' is 0.1 m across, and everything around it at most 1e-05 m"));
}

TEST_F(WrongUnits, SlideWarnsOfAPartThousandsOfTimesAsSmallAsAllElse) {
  const std::string speck = "shape: {type: sphere, radius_m: 5.0e-5}";
  const std::string box = "shape: {type: box, size_x_m: 0.6, size_y_m: 0.6, size_z_m: 0.6}";
  EXPECT_THAT(slide(speck, box, "0.4").standard_error,
              HasSubstr("object 'part' is 0.0001 m across, and everything around it at least 0.6 m"));
  // A crumb in a large room may lie near small things.
  EXPECT_EQ(slide(speck, box + "}\n- {name: bead, shape: {type: sphere, radius_m: 0.01}", "0.4001").standard_error, "");
}

TEST_F(WrongUnits, EveryCommandWarnsOfAScaleThatWasAppliedTwice) {
  const std::string tiny = " is 6e-05 m across: in metres already? ";
  const ProgramResult slid = slide("mesh: small.obj, scale: 0.001", "mesh: small.obj", "-0.1");
  EXPECT_THAT(slid.standard_error, HasSubstr("object 'part'" + tiny + "scale: 1\n"));
  EXPECT_THAT(slid.standard_error, Not(HasSubstr("everything around it"))) << "one warning is enough";
  EXPECT_THAT(slide("mesh: small.obj", "mesh: small.obj, scale: 0.001", "-0.1").standard_error,
              HasSubstr("object 'block'" + tiny + "scale: 1\n"));
  EXPECT_THAT(glissade({"info", small, "--scale", "0.001"}).standard_output,
              HasSubstr(" 6e-05 m across: in metres already? --scale 1\n"));
  const std::string poses = folder.write("poses.csv", "x_m,y_m,z_m,qw,qx,qy,qz\n0,0,0,1,0,0,0\n");
  EXPECT_THAT(glissade({"collide", small, small, "--poses", poses, "--scale", "0.001", "1"}).standard_error,
              HasSubstr(small + ":" + tiny + "--scale 1\n"));
  // Without a scale, a small mesh is meant to be small.
  mesh("crumb.obj", "0.0006");
  EXPECT_EQ(slide("mesh: crumb.obj", "mesh: small.obj", "-0.001").standard_error, "");
}

TEST_F(WrongUnits, WarnsOfALargePartShapeButNotOfALargeObstacle) {
  const std::string large_part = "shape: {type: box, size_x_m: 8, size_y_m: 0.1, size_z_m: 0.1}";
  const std::string result = slide(large_part, large_part, "-0.2").standard_error;
  EXPECT_THAT(result, HasSubstr("object 'part' is 8 m across, too large for a hand: is its shape in metres?\n"));
  EXPECT_THAT(result, Not(HasSubstr("'block'"))) << "a large shape that stays is meant to be large";
}

TEST_F(WrongUnits, SlideWarnsOfAPartThatNeverComesNearAnything) {
  const std::string box = "shape: {type: box, size_x_m: 0.1, size_y_m: 0.1, size_z_m: 0.1}";
  const ProgramResult result = slide(box, box, "30");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.standard_error,
              HasSubstr("warning: " + folder.path("hand.csv") +
                        ": the part, 0.1 m across, stays more than 29.8 m away from everything"));
  EXPECT_EQ(slide(box, box, "0.2").standard_error, "");
}

TEST_F(WrongUnits, WarnsOfTrajectoriesFarOutsideTheScene) {
  const std::string scene =
      folder.write("scene.yaml",
                   "objects:\n"
                   "- {name: part, movable: true, shape: {type: box, size_x_m: 0.1, size_y_m: 0.1, size_z_m: 0.1}, "
                   "pose: {position_m: [0, 0, 0.2]}}\n"
                   "- {name: floor, shape: {type: plate, size_x_m: 0.5, size_y_m: 0.5}}\n"
                   "script: way.csv\n");
  const auto warnings = [&](const std::string& x) {
    const std::string way =
        folder.write("way.csv", "t_s,x_m,y_m,z_m,qw,qx,qy,qz\n0,0,0,0.2,1,0,0,0\n0.02," + x + ",0,0.2,1,0,0,0\n");
    return glissade({"slide", scene, "--part", "part", "--trajectory", way, "--summary", "-"}).standard_error +
           glissade({"demo", "--scene", scene, "--offline", "--seconds", "0.02"}).standard_error;
  };
  EXPECT_EQ(warnings("1.5"), "");
  EXPECT_EQ(warnings("100").find("hand.csv"), std::string::npos);
  const std::string doubt = folder.path("way.csv") + ": it leads 99.8 m beyond everything in the scene: are its " +
                            "positions in millimetres?\n";
  EXPECT_EQ(warnings("100"), "glissade: warning: " + doubt + "glissade: warning: " + doubt);
}

TEST(ToldSize, ProposesTheScaleThatMakesMetresOfMillimetres) {
  EXPECT_EQ(told_size(0.06, 1.0, "--scale "), "0.06 m across");
  EXPECT_EQ(told_size(60.0, 1.0, "--scale "), "60 m across: millimetres? --scale 0.001");
  EXPECT_EQ(told_size(1500.0, 25.4, "scale: "), "1500 m across: millimetres? scale: 0.0254");
}

TEST(ToldSize, ProposesTheScaleOfAFileThatIsInMetresAlready) {
  EXPECT_EQ(told_size(2e-4, 1.0, "--scale "), "0.0002 m across");
  EXPECT_EQ(told_size(2e-4, 0.001, "--scale "), "0.0002 m across: in metres already? --scale 1");
}

}  // namespace
}  // namespace glissade::apps
