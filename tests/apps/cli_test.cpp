/// The program as its users meet it: what it prints, and how it ends on bad input.

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "glissade_program.h"
#include "temporary_folder.h"
#include "tetrahedron_file.h"

namespace glissade::apps {
namespace {

using test_support::expect_refused;
using test_support::glissade;
using test_support::kTetrahedronObj;
using test_support::ProgramResult;
using test_support::TemporaryFolder;
using testing::HasSubstr;

constexpr const char* kPosesHeader = "x_m,y_m,z_m,qw,qx,qy,qz\n";

/// A folder with a mesh `a.obj`, to which tests add what is wrong.
class Cli : public testing::Test {
 protected:
  void expect_row_refused(const std::string& row, const std::vector<std::string>& parts) const {
    const std::string bad_poses = folder.write("poses.csv", kPosesHeader + std::string("0,0,0,1,0,0,0\n") + row + "\n");
    expect_refused({"collide", mesh, mesh, "--poses", bad_poses}, parts);
  }

  TemporaryFolder folder;
  std::string mesh = folder.write("a.obj", kTetrahedronObj);
  std::string poses = folder.write("good.csv", kPosesHeader + std::string("0.5,0,0,1,0,0,0\n2,0,0,1,0,0,0\n"));
};

TEST_F(Cli, HelpAndVersionSucceed) {
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"--help"}, {"--version"}, {"info", "--help"}, {"collide", "--help"}}) {
    const ProgramResult result = glissade(arguments);
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_EQ(result.standard_error, "");
    EXPECT_NE(result.standard_output, "");
  }
  EXPECT_THAT(glissade({"collide", "--help"}).standard_output, HasSubstr("glissade collide panel.obj motor.obj"));
}

TEST_F(Cli, InfoTellsTheBoundsOfAMeshFarFromItsOrigin) {
  const std::string far = folder.write("far.obj",
                                       "v 1000000 0 0\nv 1000001 0 0\nv 1000000 1 0\nv 1000000 0 1\n"
                                       "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
  EXPECT_THAT(glissade({"info", far}).standard_output, HasSubstr(" 1000001 1 1 m\n"));
}

TEST_F(Cli, InfoTellsTheTrianglesAndTheTree) {
  const ProgramResult result = glissade({"info", mesh, "--json"});
  EXPECT_EQ(result.exit_code, 0) << result.standard_error;
  const nlohmann::json info = nlohmann::json::parse(result.standard_output);
  EXPECT_EQ(info.at("triangles"), 4);
  EXPECT_EQ(info.at("vertices"), 4);
  EXPECT_EQ(info.at("watertight"), true);
  EXPECT_EQ(info.at("bounds_max_m"), (std::vector<double>{1.0, 1.0, 1.0}));
  EXPECT_GE(info.at("tree_nodes"), 1);
  EXPECT_THAT(glissade({"info", mesh}).standard_output, HasSubstr("watertight"));
}

TEST_F(Cli, InfoReportsMeshOpenOnlyWithoutZeroAreaTriangles) {
  // A tetrahedron with a T-joint: vertex 5 lies on the edge of vertices 1 and 2, and the triangle 1 2 5 closes the gap.
  const std::string corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0.5 0 0\n";
  const std::string closed = "f 1 3 5\nf 5 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\nf 1 5 2\n";
  const std::string sentence = "no: open only where triangles without area are left out\n";
  EXPECT_THAT(glissade({"info", folder.write("joint.obj", corners + closed)}).standard_output, HasSubstr(sentence));
  const std::string open = closed.substr(0, closed.find("f 1 4 3")) + "f 1 5 2\n";
  EXPECT_THAT(glissade({"info", folder.write("open.obj", corners + open)}).standard_output,
              testing::Not(HasSubstr(sentence)));
  EXPECT_THAT(glissade({"info", mesh}).standard_output, HasSubstr("yes\n"));
}

TEST_F(Cli, CollideAnswersForEveryPose) {
  for (const std::string method : {"dop-tree", "brute-force"}) {
    const ProgramResult result = glissade({"collide", mesh, mesh, "--poses", poses, "--method", method});
    EXPECT_EQ(result.exit_code, 0) << result.standard_error;
    EXPECT_EQ(result.standard_output, "pose,colliding\n0,1\n1,0\n");
    EXPECT_EQ(result.standard_error, "");
  }
}

TEST_F(Cli, CollideCountsPairsWithinTheTolerance) {
  // Two units apart, the near corner of B is 1 m from the corner (1, 0, 0), which three triangles of A share.
  const ProgramResult result = glissade({"collide", mesh, mesh, "--poses", poses, "--pairs", "--tolerance-m", "1.0"});
  EXPECT_THAT(result.standard_output, HasSubstr("pose,colliding,pairs\n0,1,"));
  EXPECT_THAT(result.standard_output, HasSubstr("\n1,1,9\n"));
}

TEST_F(Cli, CollideMeasuresDistances) {
  for (const std::string method : {"dop-tree", "brute-force"}) {
    const ProgramResult result = glissade({"collide", mesh, mesh, "--poses", poses, "--distance", "--method", method});
    const std::string columns = "pose,colliding,distance_m,ax_m,ay_m,az_m,bx_m,by_m,bz_m,triangle_a,triangle_b\n";
    EXPECT_THAT(result.standard_output, testing::StartsWith(columns + "0,1,0,,,,,,,,\n1,0,1,1,0,0,2,0,0,")) << method;
    EXPECT_EQ(result.exit_code, 0);
  }
}

TEST_F(Cli, CollideWithoutPosesUsesTheIdentity) {
  const std::string other = folder.write("b.obj", "v 1.5 0 0\nv 1.5 1 0\nv 1.5 0 1\nf 1 2 3\n");
  const ProgramResult result = glissade({"collide", mesh, other, "--distance"});
  EXPECT_EQ(result.standard_error, "");
  EXPECT_THAT(result.standard_output, HasSubstr("\n0,0,0.5,1,0,0,1.5,0,0,"));
  EXPECT_EQ(glissade({"collide", mesh, mesh}).standard_output, "pose,colliding\n0,1\n");
}

TEST_F(Cli, CollideWritesTheSameToAFile) {
  const std::string out = folder.path("out.csv");
  const ProgramResult result = glissade({"collide", mesh, mesh, "--poses", poses, "--out", out});
  EXPECT_EQ(result.standard_output, "");
  EXPECT_EQ(std::filesystem::file_size(out), std::string("pose,colliding\n0,1\n1,0\n").size());
}

TEST_F(Cli, CacheKeepsTheTreesNextToTheMeshes) {
  const std::string other = folder.write("b.obj", kTetrahedronObj);
  const std::vector<std::string> collide{"collide", mesh, other, "--poses", poses, "--pairs"};
  std::vector<std::string> cached_collide = collide;
  cached_collide.emplace_back("--cache");
  const std::string expected = glissade(collide).standard_output;
  EXPECT_FALSE(std::filesystem::exists(mesh + ".dop-tree"));
  const auto expect_answer = [&](const std::string& standard_error) {
    const ProgramResult result = glissade(cached_collide);
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_EQ(result.standard_output, expected);
    EXPECT_EQ(result.standard_error, standard_error);
  };

  expect_answer("");
  const auto written = std::filesystem::last_write_time(mesh + ".dop-tree");
  EXPECT_TRUE(std::filesystem::exists(other + ".dop-tree"));
  expect_answer("");
  EXPECT_EQ(std::filesystem::last_write_time(mesh + ".dop-tree"), written);

  // The mesh moves away, and then its tree is damaged.
  folder.write("b.obj", "v 9 0 0\nv 9 1 0\nv 9 0 1\nf 1 2 3\n");
  const ProgramResult stale = glissade(cached_collide);
  EXPECT_EQ(stale.standard_output, "pose,colliding,pairs\n0,0,0\n1,0,0\n");
  EXPECT_EQ(stale.standard_error, "glissade: " + other + ".dop-tree: of another mesh; built anew\n");
  folder.write("b.obj", kTetrahedronObj);
  folder.write("b.obj.dop-tree", "DOP-tr");
  expect_answer("glissade: " + other + ".dop-tree: not a cached tree; built anew\n");
  expect_answer("");
}

TEST_F(Cli, UnsavableTreeCacheIsNoFailure) {
  std::filesystem::create_directories(mesh + ".dop-tree/occupied");
  const ProgramResult expected = glissade({"info", mesh});
  const ProgramResult result = glissade({"info", mesh, "--cache"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.standard_output, expected.standard_output);
  EXPECT_EQ(std::count(result.standard_error.begin(), result.standard_error.end(), '\n'), 1);
  EXPECT_THAT(result.standard_error,
              testing::StartsWith("glissade: " + mesh + ".dop-tree: not a regular file; built "));
  EXPECT_THAT(result.standard_error, HasSubstr("cannot be saved: " + mesh + ".dop-tree: "));
}

TEST_F(Cli, InfoOutputIsTheSameWithACachedTree) {
  const std::string expected = glissade({"info", mesh, "--json"}).standard_output;
  for (int run = 0; run < 2; ++run) {
    const ProgramResult result = glissade({"info", mesh, "--json", "--cache"});
    EXPECT_EQ(result.standard_output, expected);
    EXPECT_EQ(result.standard_error, "");
    EXPECT_TRUE(std::filesystem::exists(mesh + ".dop-tree"));
  }
}

TEST_F(Cli, FullDiskExitsWithCode1) {
  const ProgramResult result = glissade({"collide", mesh, mesh, "--poses", poses, "--out", "/dev/full"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.standard_error, HasSubstr("glissade: /dev/full"));
}

TEST_F(Cli, FullDiskBehindStandardOutputExitsWithCode1) {
  const std::vector<std::vector<std::string>> calls{
      {"info", mesh}, {"info", mesh, "--json"}, {"demo", "--offline", "--seconds", "1"}, {"--help"}};
  for (std::vector<std::string> arguments : calls) {
    SCOPED_TRACE(arguments.front());
    arguments.insert(arguments.begin(), {"/bin/sh", "-c", "exec \"$0\" \"$@\" > /dev/full", GLISSADE_PROGRAM});
    const ProgramResult result = test_support::Process(arguments).wait();
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_EQ(result.standard_error, "glissade: standard output: not everything could be written\n");
  }
}

TEST_F(Cli, PresetsOfGlovesAreListedWithASentenceEach) {
  const ProgramResult result = glissade({"glove", "--presets"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.standard_output, HasSubstr("\ncamera: A bare hand"));
  EXPECT_THAT(result.standard_output, HasSubstr("\nomega_3: Force Dimension"));
}

TEST_F(Cli, WrongUsageIsRefused) {
  expect_refused({"info", mesh, "demo"}, {"demo"});
  expect_refused({"demo", "--offline", "info", mesh}, {"info"});
  expect_refused({}, {"command"});
  expect_refused({"frobnicate"}, {"frobnicate"});
  expect_refused({"--frobnicate"}, {"--frobnicate"});
  expect_refused({"info"}, {"MESH"});
  expect_refused({"info", mesh, "--frobnicate"}, {"--frobnicate"});
  expect_refused({"info", mesh, "surplus"}, {"surplus"});
  expect_refused({"collide", mesh}, {"B"});
  expect_refused({"collide", mesh, mesh, "--scale", "0"}, {"--scale", "must be above 0, not 0\n"});
  expect_refused({"collide", mesh, mesh, "--poses", poses, "--method", "guess"}, {"--method", "guess", "dop-tree"});
  for (const std::string bad : {"wide", "-1", "nan", "inf"}) {
    expect_refused({"collide", mesh, mesh, "--poses", poses, "--tolerance-m", bad}, {"--tolerance-m", bad});
  }
  expect_refused({"collide", mesh, mesh, "--poses", poses, "--out", folder.path("no/out.csv")}, {"no/out.csv"});
  expect_refused({"glove", "--side", "up"}, {"--side: 'up' is unknown; known are left, right\n"});
  expect_refused({"glove", "--preset", "omega_4"}, {"'omega_4' is neither a file nor a preset (did you mean 'omega_"});
  expect_refused({"glove", "--script"}, {"--script: a value is missing\n"});
  expect_refused({"slide", mesh, "--part"}, {"--part: a value is missing\n"});
  expect_refused({"slide", mesh, "--part", "a", "--part", "b"}, {"--part: takes one value, not 2\n"});
  expect_refused({"slide", mesh, "--part", "a", "--friction", "1", "2", "3"},
                 {"--friction: takes at most 2 values, not 3\n"});
}

TEST_F(Cli, FilesThatCannotBeReadAreRefused) {
  expect_refused({"info", folder.path("none.obj")}, {"none.obj"});
  expect_refused({"info", folder.path("")}, {folder.path("")});
  expect_refused({"info", ""}, {"name", "empty"});
  expect_refused({"info", folder.write("a.doc", "text")}, {"a.doc"});
  expect_refused({"info", folder.write("empty.obj", "")}, {"empty.obj"});
  expect_refused({"info", folder.write("truncated.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0")},
                 {"truncated.stl"});
  expect_refused({"info", folder.write("nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")}, {"nan.obj"});
  expect_refused({"info", folder.write("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n")}, {"flat.obj"});
  expect_refused({"collide", mesh, mesh, "--poses", folder.path("none.csv")}, {"none.csv"});
  expect_refused({"collide", mesh, mesh, "--poses", folder.path("")}, {"folder"});
  expect_refused({"collide", mesh, mesh, "--poses", "/dev/zero"}, {"/dev/zero", "not a regular file"});
  expect_refused({"collide", mesh, mesh, "--poses", ""}, {"name", "empty"});
  expect_refused({"collide", mesh, folder.path("none.obj"), "--poses", poses}, {"none.obj"});
}

TEST_F(Cli, AFileWithoutPermissionIsRefused) {
  std::filesystem::permissions(mesh, std::filesystem::perms::none);
  if (access(mesh.c_str(), R_OK) == 0) GTEST_SKIP() << "this user may read every file";
  expect_refused({"info", mesh}, {"a.obj"});
}

TEST_F(Cli, WrongPosesAreRefusedWithLineColumnAndValue) {
  expect_row_refused("0,0,0,1,0,0", {"poses.csv:3:", "7 columns, not 6"});
  expect_row_refused("0,0,north,1,0,0,0", {"poses.csv:3:", "z_m", "'north'"});
  expect_row_refused("0,0,nan,1,0,0,0", {"poses.csv:3:", "z_m", "'nan'"});
  expect_row_refused("0,0,0,0,0,0,0", {"poses.csv:3:", "is zero"});
  expect_row_refused("0,0,0,0.99,0,0,0", {"poses.csv:3:", "length 0.99"});
}

TEST_F(Cli, NewlineInFileNameIsPrintedAsSpace) {
  expect_refused({"info", folder.path("a\nb.obj")}, {"a b.obj"});
}

}  // namespace
}  // namespace glissade::apps
