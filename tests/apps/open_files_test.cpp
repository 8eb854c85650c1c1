// Meshes from which something is left out: every command that reads one says so, and refuses it if it is asked to.

#include <algorithm>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "glissade_program.h"
#include "temporary_folder.h"
#include "tetrahedron_file.h"

namespace glissade::apps {
namespace {

using test_support::glissade;
using test_support::kTetrahedronObj;
using test_support::ProgramResult;
using test_support::TemporaryFolder;
using testing::HasSubstr;

/// Files with a mesh that has two triangles too many, a point and a line.
class DegenerateTriangles : public testing::Test {
 protected:
  std::string scene(const std::string& objects) const { return folder.write("scene.yaml", "objects:\n" + objects); }

  TemporaryFolder folder;
  std::string whole = folder.write("whole.obj", kTetrahedronObj);
  std::string slivers = folder.write("slivers.obj", std::string(kTetrahedronObj) + "f 1 1 1\nf 1 2 2\n");
  std::string sliver = folder.write("sliver.obj", std::string(kTetrahedronObj) + "f 1 1 1\n");
};

TEST_F(DegenerateTriangles, AreReportedByCollide) {
  const std::string poses = folder.write("poses.csv", "x_m,y_m,z_m,qw,qx,qy,qz\n0,0,0,1,0,0,0\n");
  const ProgramResult result = glissade({"collide", sliver, slivers, "--poses", poses});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.standard_error, HasSubstr(sliver + ": 1 triangle without area is left out\n"));
  EXPECT_THAT(result.standard_error, HasSubstr(slivers + ": 2 triangles without area are left out\n"));
  EXPECT_EQ(glissade({"collide", whole, whole, "--poses", poses}).standard_error, "");
}

TEST_F(DegenerateTriangles, AreCountedByInfo) {
  EXPECT_THAT(glissade({"info", slivers}).standard_output, HasSubstr("left out, without area      2\n"));
  EXPECT_THAT(glissade({"info", slivers, "--json"}).standard_output, HasSubstr("\"degenerate_triangles\": 2"));
}

TEST_F(DegenerateTriangles, AreReportedOncePerMeshBySceneCommands) {
  const std::string file = scene(
      "  - {name: part, movable: true, mesh: slivers.obj}\n"
      "  - {name: twin, mesh: slivers.obj, pose: {position_m: [3, 0, 0]}}\n"
      "  - {name: wall, mesh: whole.obj, pose: {position_m: [6, 0, 0]}}\n");
  const std::string way = folder.write("way.csv", "t_s,x_m,y_m,z_m,qw,qx,qy,qz\n0,0,0,0,1,0,0,0\n0.01,0,0,0,1,0,0,0\n");
  const std::string hand = folder.path("no_such_hand.yaml");
  // `run` and `record` open scenes by the same function, but need a network. `view` ends with an error afterwards.
  for (const std::vector<std::string>& arguments : {
           std::vector<std::string>{"slide", file, "--part", "part", "--trajectory", way},
           {"demo", "--scene", file, "--offline"},
           {"view", file, "--fingers", "--hand", hand},
       }) {
    SCOPED_TRACE(arguments.front());
    const std::string said = glissade(arguments).standard_error;
    EXPECT_THAT(said, HasSubstr("the mesh of object 'part': 2 triangles without area are left out\n"));
    EXPECT_EQ(said.find("'twin'"), std::string::npos) << said;
    EXPECT_EQ(said.find("'wall'"), std::string::npos) << said;
  }
}

/// A file with a face of two corners, and what every command says of it.
class MeshWarningsOfCommands : public DegenerateTriangles {
 protected:
  /// The command with the option, which is refused.
  static void expect_strict(std::vector<std::string> arguments, const std::string& warning) {
    arguments.emplace_back("--strict");
    test_support::expect_refused(arguments, {"glissade: " + warning, "--strict"});
  }

  std::string edge = folder.write("edge.obj", std::string(kTetrahedronObj) + "f 1 2\n");
  std::string warning = edge + ": 1 face has fewer than 3 corners and is left out (line 9).";
  std::string line = "glissade: warning: " + warning + "\n";
};

TEST_F(MeshWarningsOfCommands, ArePrintedByInfoAndCollideAndRefusedByStrict) {
  const ProgramResult info = glissade({"info", edge});
  EXPECT_EQ(info.exit_code, 0);
  EXPECT_EQ(info.standard_error, line);
  EXPECT_EQ(glissade({"collide", edge, edge}).standard_error, line);
  expect_strict({"info", edge}, warning);
  expect_strict({"collide", whole, edge}, warning);
  EXPECT_EQ(glissade({"info", whole, "--strict"}).exit_code, 0);
  EXPECT_EQ(glissade({"info", slivers, "--strict"}).exit_code, 0) << "triangles without area are no surface";
}

TEST_F(MeshWarningsOfCommands, ArePrintedOncePerFileBySceneCommands) {
  const std::string file = scene(
      "  - {name: part, movable: true, mesh: edge.obj}\n"
      "  - {name: twin, mesh: edge.obj, pose: {position_m: [3, 0, 0]}}\n"
      "  - {name: large, mesh: edge.obj, scale: 2, pose: {position_m: [6, 0, 0]}}\n");
  const std::string way = folder.write("way.csv", "t_s,x_m,y_m,z_m,qw,qx,qy,qz\n0,0,0,0,1,0,0,0\n0.01,0,0,0,1,0,0,0\n");
  for (const std::vector<std::string>& arguments : {
           std::vector<std::string>{"slide", file, "--part", "part", "--trajectory", way},
           {"demo", "--scene", file, "--offline"},
           {"export", file, "--out", folder.path("out.obj")},
           {"view", file, "--fingers", "--hand", "no_such_hand.yaml"},
       }) {
    SCOPED_TRACE(arguments.front());
    const std::string said = glissade(arguments).standard_error;
    EXPECT_THAT(said, HasSubstr(line));
    EXPECT_EQ(said.find(line), said.rfind(line)) << said;
    expect_strict(arguments, warning);
  }
  expect_strict({"grasp", file, "--hand-trajectory", GLISSADE_SCENES "/ball_and_tray_hand.csv"}, warning);
}

TEST_F(MeshWarningsOfCommands, AllCommandsThatLoadMeshesHaveStrict) {
  for (const char* command :
       {"info", "collide", "slide", "grasp", "demo", "run", "record", "replay", "export", "view"}) {
    EXPECT_THAT(glissade({command, "--help"}).standard_output, HasSubstr("--strict")) << command;
  }
  EXPECT_THAT(glissade({"log", "to-mcap", "--help"}).standard_output, HasSubstr("--strict"));
}

}  // namespace
}  // namespace glissade::apps
