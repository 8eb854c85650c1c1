/// The meshes of a scene at a moment: `glissade export`.

#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glissade/apps/files/scene_file.h>
#include <glissade/apps/text.h>
#include <glissade/files/text_file.h>
#include <glissade/geometry/mesh_import.h>
#include <glissade/grasping/hand_model.h>

#include "glb_file.h"
#include "glissade_program.h"
#include "poses.h"
#include "pressing_scene.h"
#include "temporary_folder.h"

namespace glissade::apps {
namespace {

using test_support::expect_fails;
using test_support::expect_refused;
using testing::HasSubstr;

/// A group of an OBJ file.
struct ObjGroup {
  std::string name;
  std::vector<Eigen::Vector3d> vertices;
  std::size_t triangles = 0;
};

std::vector<ObjGroup> read_obj(const std::string& path) {
  std::vector<ObjGroup> groups;
  std::istringstream file(read_text_file(path));
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "g") words >> groups.emplace_back().name;
    if (word == "f") ++groups.back().triangles;
    if (word != "v") continue;
    Eigen::Vector3d& vertex = groups.back().vertices.emplace_back();
    for (double& coordinate : vertex) {
      words >> word;
      coordinate = parse_number(word).value();
    }
  }
  return groups;
}

/// The pose in columns of these prefixes, such as "v" of vx_m and vqw.
Eigen::Isometry3d pose_in(const test_support::CsvRow& row, const std::string& prefix) {
  const auto number = [&](const char* column) { return parse_number(row.at(prefix + column)).value(); };
  return test_support::pose({number("x_m"), number("y_m"), number("z_m")},
                            {number("qw"), number("qx"), number("qy"), number("qz")});
}

double greatest_distance(const ObjGroup& group, const geometry::TriangleMesh& mesh, const Eigen::Isometry3d& X_WB) {
  EXPECT_EQ(group.vertices.size(), mesh.vertices.size());
  EXPECT_EQ(group.triangles, mesh.triangles.size());
  double greatest = 0.0;
  for (std::size_t i = 0; i < std::min(group.vertices.size(), mesh.vertices.size()); ++i)
    greatest = std::max(greatest, (group.vertices[i] - X_WB * mesh.vertices[i]).norm());
  return greatest;
}

class ExportCommand : public testing::Test {
 protected:
  std::string exported(std::vector<std::string> arguments, const std::string& name) {
    arguments.insert(arguments.begin(), "export");
    arguments.insert(arguments.end(), {"--out", folder.path(name)});
    const test_support::ProgramResult result = test_support::glissade(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.standard_error;
    EXPECT_THAT(result.standard_output, HasSubstr(name + ": "));
    return folder.path(name);
  }

  test_support::TemporaryFolder folder;
};

TEST_F(ExportCommand, OurImporterReadsTheSameVerticesInWorldAxes) {
  // Half a turn about z, and coordinates that single precision holds: nothing is rounded on the way.
  const std::string original =
      folder.write("wedge.obj", "v 0 0 0\nv 0.5 0 0\nv 0 0.25 0\nv 0.125 0 2\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
  const std::string scene = folder.write("scene.yaml",
                                         "objects:\n- {name: a wedge, mesh: wedge.obj, pose: {position_m: [1.5, 0, "
                                         "-3], orientation_wxyz: [0, 0, 0, 1]}}\n");
  const std::string obj = exported({scene}, "scene.obj");
  EXPECT_EQ(read_obj(obj).at(0).name, "a_wedge");
  const geometry::TriangleMesh mesh = geometry::import_mesh(obj).mesh;
  const geometry::TriangleMesh mesh_B = geometry::import_mesh(original).mesh;
  ASSERT_EQ(mesh.vertices.size(), 4U);
  EXPECT_EQ(mesh.triangles, mesh_B.triangles);
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector3d& p_B = mesh_B.vertices[i];
    EXPECT_EQ(mesh.vertices[i], Eigen::Vector3d(1.5 - p_B.x(), -p_B.y(), p_B.z() - 3.0));
  }
}

TEST_F(ExportCommand, TheDigitsAreThoseOfDoublePrecision) {
  const std::string file = folder.write(
      "scene.yaml",
      "objects:\n"
      "  - {name: ball, shape: {type: sphere}, pose: {position_m: [0.1, 1234.5678, -0.3]}}\n"
      "  - {name: box, shape: {type: box}, pose: {position_m: [1, 2, 3], orientation_wxyz: [0.6, 0, 0.8, 0]}}\n");
  const std::vector<ObjGroup> groups = read_obj(exported({file}, "scene.obj"));
  const Scene scene = read_scene(file);
  ASSERT_EQ(groups.size(), 2U);
  for (std::size_t o = 0; o < groups.size(); ++o) {
    EXPECT_EQ(groups[o].name, scene.objects[o].name);
    EXPECT_EQ(greatest_distance(groups[o], *scene.objects[o].mesh, scene.objects[o].X_WB), 0.0);
  }
}

TEST_F(ExportCommand, MovingObjectsHaveTheirPoseAtTheGivenTime) {
  folder.write("way.csv", "t_s,x_m,y_m,z_m,qw,qx,qy,qz\n1,0,0,1,1,0,0,0\n3,4,0,1,1,0,0,0\n");
  const std::string scene = folder.write("scene.yaml",
                                         "objects:\n"
                                         "  - {name: floor, shape: {type: plate}}\n"
                                         "  - {name: lift, shape: {type: box}, moves: way.csv}\n");
  const auto x_of_lift = [](const std::string& obj) {
    Eigen::AlignedBox3d box;
    const ObjGroup lift = read_obj(obj).at(1);
    for (const Eigen::Vector3d& vertex : lift.vertices)
      box.extend(vertex);
    return box.center().x();
  };
  EXPECT_NEAR(x_of_lift(exported({scene}, "start.obj")), 0.0, 1e-12);
  EXPECT_NEAR(x_of_lift(exported({scene, "--at", "1.5"}, "later.obj")), 1.0, 1e-12);
  EXPECT_NEAR(x_of_lift(exported({scene, "--at", "9"}, "end.obj")), 4.0, 1e-12);
}

TEST_F(ExportCommand, GltfHasTheAxesAndTheOriginOfTheWorld) {
  const std::string scene =
      folder.write("scene.yaml",
                   "objects:\n"
                   "  - {name: floor, shape: {type: plate}, pose: {position_m: [0, 0, -1]}}\n"
                   "  - {name: box, shape: {type: box, size_x_m: 0.5}, pose: {position_m: [100, 2, 3]}}\n");
  const test_support::Glb glb = test_support::read_glb(read_text_file(exported({scene}, "scene.glb")));
  const nlohmann::json& nodes = glb.json["scenes"][0]["nodes"];
  ASSERT_EQ(nodes.size(), 2U);
  const nlohmann::json& box = glb.json["nodes"][nodes[1].get<std::size_t>()];
  EXPECT_EQ(box["name"], "box");
  const Eigen::AlignedBox3d bounds = test_support::bounds_of(glb, box);
  EXPECT_TRUE(bounds.center().isApprox(Eigen::Vector3d(100.0, 2.0, 3.0), 1e-6)) << bounds.center().transpose();
  EXPECT_NEAR(bounds.sizes().x(), 0.5, 1e-4);
}

TEST_F(ExportCommand, WrongInputIsNamed) {
  const std::string scene = test_support::write_pressing_scene(folder);
  expect_refused({"export", scene, "--out", folder.path("scene.stl")}, {"scene.stl", ".obj", ".glb"});
  expect_refused({"export", "--out", folder.path("scene.obj")}, {"SCENE", "--log"});
  expect_refused({"export", scene, "--at", "1e10", "--out", folder.path("scene.obj")}, {"--at", "1e9"});
  expect_refused({"export", scene, "--out", folder.path("no/scene.obj")}, {"no/scene.obj", "cannot be created"});
  expect_refused({"export", "--log", scene, "--out", folder.path("scene.obj")}, {"scene.yaml", "is no LCM event log"});
}

class ExportOfARecording : public ExportCommand {
 protected:
  /// Half a second of a demonstration, and the table that `log to-csv` makes of it.
  std::vector<test_support::CsvRow> record(std::vector<std::string> arguments, const std::string& table) {
    arguments.insert(arguments.begin(), {"demo", "--offline", "--seconds", "0.5", "--record", log});
    test_support::glissade(arguments);  // the hand is too fast to reach the goal
    EXPECT_EQ(test_support::glissade({"log", "to-csv", log, folder.path("tables")}).exit_code, 0);
    return test_support::rows_of(read_text_file(folder.path("tables/" + table)));
  }

  /// The row `after` the first one, in seconds.
  static const test_support::CsvRow& row_after(double after, const std::vector<test_support::CsvRow>& rows) {
    const auto time = [](const test_support::CsvRow& row) { return parse_number(row.at("t_s")).value(); };
    std::size_t i = 0;
    while (i + 1 < rows.size() && time(rows[i + 1]) - time(rows[0]) < after + 1e-9)
      ++i;
    return rows[i];
  }

  std::string log = folder.path("run.lcmlog");
};

TEST_F(ExportOfARecording, PartPosesEqualTheRecordedTable) {
  const std::string file = test_support::write_pressing_scene(folder);
  const std::vector<test_support::CsvRow> rows = record({"--scene", file}, "parts.csv");
  const Scene scene = read_scene(file);
  double way = 0.0;
  for (const double at : {0.0, 0.1234, 0.45}) {
    const std::vector<ObjGroup> groups = read_obj(exported({"--log", log, "--at", format_number(at)}, "moment.obj"));
    ASSERT_EQ(groups.size(), 2U);
    EXPECT_EQ(greatest_distance(groups[0], *scene.objects[0].mesh, scene.objects[0].X_WB), 0.0) << "the plate";
    const Eigen::Isometry3d X_WV = pose_in(row_after(at, rows), "v");
    EXPECT_LT(greatest_distance(groups[1], *scene.objects[1].mesh, X_WV), 1e-12) << "at " << at << " s";
    way = (X_WV.translation() - scene.objects[1].X_WB.translation()).norm();
  }
  EXPECT_GT(way, 0.01) << "the part has moved";
  // glTF has the same pose.
  const test_support::Glb glb =
      test_support::read_glb(read_text_file(exported({file, "--log", log, "--at", "0.45"}, "moment.glb")));
  const nlohmann::json& node = glb.json["nodes"][glb.json["scenes"][0]["nodes"][1].get<std::size_t>()];
  EXPECT_EQ(node["extras"]["kind"], "part");
  EXPECT_TRUE(test_support::pose_of(node).isApprox(pose_in(row_after(0.45, rows), "v"), 1e-9));
}

TEST_F(ExportOfARecording, HandLinksHaveTheirRecordedPoses) {
  const std::vector<test_support::CsvRow> rows = record({"--fingers"}, "hands.csv");
  const std::vector<ObjGroup> groups = read_obj(exported({"--log", log, "--at", "0.4"}, "moment.obj"));
  const test_support::Glb glb =
      test_support::read_glb(read_text_file(exported({"--log", log, "--at", "0.4"}, "moment.glb")));

  const grasping::HandModel model = grasping::make_hand();
  const test_support::CsvRow& row = row_after(0.4, rows);
  hands::JointValues angles{};
  for (std::size_t j = 0; j < angles.size(); ++j)
    angles[j] = parse_number(row.at(std::string(hands::kJointNames[j]) + "_rad")).value();
  std::vector<Eigen::Isometry3d> X_WL(model.chain.links().size());
  model.chain.poses(pose_in(row, ""), angles, X_WL);

  std::size_t found = 0;
  for (std::size_t l = 0; l < X_WL.size(); ++l) {
    const grasping::ChainLink& link = model.chain.links()[l];
    for (const ObjGroup& group : groups) {
      if (!link.mesh || group.name != "hand_0_" + link.name) continue;
      ++found;
      EXPECT_LT(greatest_distance(group, *link.mesh, X_WL[l]), 1e-12) << group.name;
    }
    for (const nlohmann::json& node : glb.json["nodes"]) {
      if (!node.contains("extras") || node["extras"]["kind"] != "segment" || node["extras"]["link"] != l) continue;
      EXPECT_TRUE(test_support::pose_of(node).isApprox(X_WL[l], 1e-9)) << link.name;
      ++found;
    }
  }
  EXPECT_EQ(found, 36U) << "18 segments in each file";
}

TEST_F(ExportOfARecording, MomentsAndScenesThatDoNotBelongToItAreRefused) {
  const std::string scene = test_support::write_pressing_scene(folder);
  record({"--scene", scene}, "ticks.csv");
  const std::string out = folder.path("moment.obj");
  expect_refused({"export", "--log", log, "--at", "0.6", "--out", out}, {"0.6 s", "run.lcmlog", "lasts 0.499 s"});
  expect_refused({"export", "--log", log, "--at", "-1", "--out", out}, {"-1 s", "before the log"});
  const std::string text = read_text_file(scene);
  const std::string moved =
      folder.write("moved.yaml", std::string(text).replace(text.find("0, 0, 0.03"), 10, "0, 0, 0.04"));
  expect_refused({"export", moved, "--log", log, "--out", out}, {"moved.yaml", "run.lcmlog", "has changed"});

  // A damaged log is good up to its damage.
  const std::string bytes = read_text_file(log);
  const std::string cut = folder.write("cut.lcmlog", bytes.substr(0, bytes.size() / 2));
  expect_fails(1, {"export", "--log", cut, "--at", "0.4", "--out", out}, {"cut.lcmlog", "damaged"});
  exported({"--log", cut, "--at", "0.1"}, "moment.obj");
}

}  // namespace
}  // namespace glissade::apps
