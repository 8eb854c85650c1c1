#include <chrono>
#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <glissade/simulation/scene.h>

#include "expect_bad_input.h"
#include "temporary_folder.h"
#include "tetrahedron_file.h"

namespace glissade::simulation {
namespace {

using test_support::expect_bad_input;
using test_support::kTetrahedronObj;
using test_support::TemporaryFolder;

Scene parse_text(const std::string& text) {
  return parse_scene(text, "scene.yaml", ".");
}

/// A scene with one box and the lines `more` in its object.
Scene parse_object(const std::string& more) {
  return parse_text("objects:\n  - name: block\n    shape: {type: box}\n" + more);
}

TEST(SceneReader, EqualMeshesAreShared) {
  const TemporaryFolder folder;
  folder.write("part.obj", kTetrahedronObj);
  const std::string path = folder.write("scene.yaml",
                                        "objects:\n"
                                        "  - {name: a, shape: {type: box, size_x_m: 2, size_y_m: 3}}\n"
                                        "  - {name: b, shape: {size_y_m: 3, type: box, size_x_m: 2.0}}\n"
                                        "  - {name: c, shape: {type: box, size_x_m: 2}}\n"
                                        "  - {name: d, mesh: part.obj}\n"
                                        "  - {name: e, mesh: part.obj}\n"
                                        "  - {name: f, mesh: part.obj, scale: 0.5}\n");
  const Scene scene = read_scene(path);
  const auto mesh = [&](const char* name) { return scene.find(name).mesh.shared(); };
  EXPECT_EQ(mesh("a"), mesh("b"));
  EXPECT_NE(mesh("a"), mesh("c"));
  EXPECT_EQ(mesh("d"), mesh("e"));
  EXPECT_NE(mesh("d"), mesh("f"));
}

TEST(SceneReader, ReadsAnglesInPlaceOfAQuaternion) {
  const Scene scene = parse_object("    pose: {position_m: [1, 2, 3], orientation_rpy_deg: [0, 0, 90]}\n");
  EXPECT_TRUE((scene.objects[0].X_WB * Eigen::Vector3d::UnitX()).isApprox(Eigen::Vector3d(1.0, 3.0, 3.0), 1e-15));
  expect_bad_input([] { parse_object("    pose: {orientation_rpy_deg: [0, 90]}\n"); },
                   {"scene.yaml:4:", "orientation_rpy_deg", "3"});
  expect_bad_input([] { parse_object("    pose: {orientation_wxyz: [1, 0, 0, 0], orientation_rpy_deg: [0, 0, 0]}\n"); },
                   {"scene.yaml:4:", "give one"});
}

TEST(SceneReader, ReadsAMatrixByRowsAndKeepsItsDigits) {
  const Scene scene = parse_object("    pose: {orientation_matrix: [0, -1, 0, 1, 1e-17, 0, 0, -0.0, 1]}\n");
  EXPECT_EQ(scene.objects[0].X_WB * Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY());
  EXPECT_EQ(scene.objects[0].X_WB(1, 1), 1e-17);
  EXPECT_TRUE(std::signbit(scene.objects[0].X_WB(2, 1)));
  const Scene rounded =
      parse_object("    pose: {orientation_matrix: [0.70711, -0.70711, 0, 0.70711, 0.70711, 0, 0, 0, 1]}\n");
  EXPECT_LT(std::abs(rounded.objects[0].X_WB.linear().determinant() - 1.0), 1e-12) << "the nearest rotation";
  expect_bad_input([] { parse_object("    pose: {orientation_matrix: [1, 0, 0, 0, 1, 0, 0, 0, -1]}\n"); },
                   {"scene.yaml:4: pose: orientation_matrix: is no rotation"});
  expect_bad_input([] { parse_object("    pose: {orientation_matrix: [1, 0, 0, 1]}\n"); },
                   {"scene.yaml:4:", "orientation_matrix", "9 numbers"});
  expect_bad_input(
      [] {
        parse_object("    pose: {orientation_wxyz: [1, 0, 0, 0], orientation_matrix: [1, 0, 0, 0, 1, 0, 0, 0, 1]}\n");
      },
      {"scene.yaml:4:", "another orientation", "give one"});
}

TEST(SceneReader, ReadsAMotionRowByRow) {
  const Scene scene = parse_object(
      "    moves:\n"
      "      - {t_s: 0.5, position_m: [1, 0, 0]}\n"
      "      - {t_s: 1.5, position_m: [3, 0, 0], orientation_rpy_deg: [0, 0, 90]}\n");
  ASSERT_TRUE(scene.objects[0].motion);
  EXPECT_EQ(scene.objects[0].X_WB.translation().x(), 1.0) << "where the motion starts";
  EXPECT_EQ(scene.objects[0].motion->script_X_WB.pose_at(std::chrono::seconds(1)).translation().x(), 2.0);
  expect_bad_input([] { parse_object("    moves: [{t_s: 0}, {t_s: 0}]\n"); },
                   {"scene.yaml:4: moves: Row 1", "does not rise"});
  expect_bad_input([] { parse_object("    moves:\n      - {t_s: 0}\n      - {position_m: [0, 0, 0]}\n"); },
                   {"scene.yaml:6: moves: the key 't_s' is missing"});
  expect_bad_input([] { parse_object("    moves: [{t_s: 1e300}]\n"); }, {"scene.yaml:4: moves: t_s: 1e+300 is beyond"});
  expect_bad_input([] { parse_object("    moves: [{t_s: 0, x_m: 0}]\n"); }, {"scene.yaml:4:", "'x_m'", "position_m"});
  expect_bad_input([] { parse_object("    moves: []\n"); }, {"scene.yaml:4: moves:", "at least one row"});
}

TEST(SceneReader, AMeshThatIsNotWeldedIsAsTheFileHasIt) {
  const TemporaryFolder folder;
  folder.write("part.obj", "v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 0 0\nf 2 3 4\nf 2 3 5\n");
  const Scene scene = read_scene(folder.write("scene.yaml",
                                              "objects:\n"
                                              "  - {name: raw, mesh: part.obj, welded: false, scale: 0.5}\n"
                                              "  - {name: usual, mesh: part.obj}\n"));
  const geometry::TriangleMesh& raw = *scene.objects[0].mesh;
  EXPECT_EQ(raw.vertices.size(), 5U);
  EXPECT_EQ(raw.vertices[0], Eigen::Vector3d(4.5, 4.5, 4.5));
  EXPECT_EQ(raw.triangles, (std::vector<geometry::Triangle>{{1, 2, 3}, {1, 2, 4}}));
  EXPECT_EQ(scene.objects[1].mesh->triangles.size(), 1U);
  expect_bad_input([] { parse_object("    welded: false\n"); }, {"scene.yaml:4: welded: is for meshes"});
}

TEST(SceneReader, ReadsMarginCompliancePointAndGivingWay) {
  const Scene scene = parse_object(
      "    margin_m: 2.0e-6\n"
      "    compliance_point_m: [0, 0.01, -0.02]\n"
      "    gives_way: [{min_m: [-1, -1, 0.04], max_m: [1, 1, 1]}]\n");
  EXPECT_EQ(scene.objects[0].margin_m, 2e-6);
  EXPECT_EQ(scene.objects[0].compliance_point_B, Eigen::Vector3d(0.0, 0.01, -0.02));
  expect_bad_input([] { parse_object("    compliance_point_m: 3\n"); }, {"scene.yaml:4", "compliance_point_m"});
  EXPECT_GE(scene.objects[0].giving_way.size(), 2u) << "the upper face of a box";
  for (const std::int32_t t : scene.objects[0].giving_way) {
    for (int c = 0; c < 3; ++c)
      EXPECT_GE(scene.objects[0].mesh->corner(t, c).z(), 0.04);
  }
  expect_bad_input([] { parse_object("    margin_m: 0\n"); }, {"scene.yaml:4", "margin_m", "positive", "'0'"});
  expect_bad_input([] { parse_object("    gives_way: yes\n"); }, {"scene.yaml:4", "gives_way", "list"});
  expect_bad_input([] { parse_object("    gives_way: [{min_m: [0, 0, 0], max_m: [-1, 1, 1]}]\n"); },
                   {"scene.yaml:4", "gives_way", "min_m", "above"});
  expect_bad_input([] { parse_object("    gives_way: [{min_m: [5, 5, 5], max_m: [6, 6, 6]}]\n"); },
                   {"scene.yaml:4", "gives_way", "no triangle"});
}

TEST(SceneReader, ReadsObjectsScriptAndGoal) {
  const TemporaryFolder folder;
  folder.write("part.obj", kTetrahedronObj);
  const std::string path = folder.write("scene.yaml",
                                        "objects:\n"
                                        "  - name: block\n"
                                        "    shape: {type: box, size_x_m: 2}\n"
                                        "  - name: part\n"
                                        "    mesh: part.obj\n"
                                        "    scale: 0.001\n"
                                        "    pose: {position_m: [1, 2, 3], orientation_wxyz: [0, 1, 0, 0]}\n"
                                        "    movable: true\n"
                                        "script: hand.csv\n"
                                        "goal: {position_m: [0, 0, 4]}\n");
  const Scene scene = read_scene(path);
  ASSERT_EQ(scene.objects.size(), 2U);

  const SceneObject& block = scene.find("block");
  EXPECT_TRUE(block.X_WB.isApprox(Eigen::Isometry3d::Identity()));
  EXPECT_FALSE(block.movable);
  double largest_x = 0.0;
  for (const Eigen::Vector3d& vertex : block.mesh->vertices)
    largest_x = std::max(largest_x, vertex.x());
  EXPECT_DOUBLE_EQ(largest_x, 1.0) << "size_x_m is the full edge";

  const SceneObject& part = scene.find("part");
  EXPECT_TRUE(part.movable);
  EXPECT_EQ(part.mesh->triangles.size(), 4U);
  double extent = 0.0;
  for (const Eigen::Vector3d& vertex : part.mesh->vertices)
    extent = std::max(extent, vertex.maxCoeff());
  EXPECT_NEAR(extent, 0.001, 1e-9);
  EXPECT_TRUE((part.X_WB * Eigen::Vector3d(0.0, 1.0, 1.0)).isApprox(Eigen::Vector3d(1.0, 1.0, 2.0)));

  EXPECT_EQ(scene.script_path, folder.path("hand.csv"));
  ASSERT_TRUE(scene.X_WGoal.has_value());
  EXPECT_TRUE(scene.X_WGoal->translation().isApprox(Eigen::Vector3d(0.0, 0.0, 4.0)));
}

TEST(SceneReader, ScriptAndGoalAreOptional) {
  const Scene scene = parse_object("");
  EXPECT_FALSE(scene.script_path.has_value());
  EXPECT_FALSE(scene.X_WGoal.has_value());
}

TEST(SceneReader, CountsTrianglesWithoutArea) {
  const TemporaryFolder folder;
  folder.write("part.obj", std::string(kTetrahedronObj) + "f 1 2 2\nv 2 0 0\nf 1 2 5\n");
  const std::string path = folder.write("scene.yaml", "objects:\n  - {name: part, mesh: part.obj}\n");
  EXPECT_EQ(read_scene(path).objects.front().mesh.degenerate_triangles(), 2);
}

TEST(SceneReader, AnUnknownObjectListsTheKnownOnes) {
  expect_bad_input([] { (void)parse_object("  - {name: ball, shape: {type: sphere}}\n").find("motor"); },
                   {"scene.yaml:", "'motor'", "block, ball"});
}

TEST(SceneReader, UnknownAndRepeatedKeysNameTheirLine) {
  expect_bad_input([] { parse_object("    colour: red\n"); }, {"scene.yaml:4:", "'colour'", "movable"});
  expect_bad_input([] { parse_object("    movable: true\n    movable: false\n"); },
                   {"scene.yaml:5:", "'movable'", "twice"});
  expect_bad_input([] { parse_object("gaol: {}\n"); }, {"scene.yaml:4:", "'gaol'"});
  expect_bad_input([] { parse_object("    pose: {position: [0, 0, 0]}\n"); }, {"scene.yaml:4:", "'position'"});
  expect_bad_input([] { parse_object("    pose: {position_m: [0, 0, 0], position_m: [1, 0, 0]}\n"); },
                   {"scene.yaml:4:", "twice"});
}

TEST(SceneReader, NamesMustBeThereAndDiffer) {
  expect_bad_input([] { parse_text("objects:\n  - shape: {type: box}\n"); }, {"scene.yaml:2:", "'name'", "missing"});
  expect_bad_input([] { parse_text("objects:\n  - name: ''\n    shape: {type: box}\n"); }, {"scene.yaml:2:", "name"});
  expect_bad_input([] { parse_object("  - name: block\n    shape: {type: sphere}\n"); },
                   {"scene.yaml:4:", "'block'", "scene.yaml:2"});
}

TEST(SceneReader, ExactlyOneOfMeshAndShape) {
  expect_bad_input([] { parse_text("objects:\n  - name: block\n"); }, {"scene.yaml:2:", "'block'", "neither"});
  expect_bad_input([] { parse_object("    mesh: block.obj\n"); }, {"scene.yaml:3:", "'block'", "both"});
}

TEST(SceneReader, ShapesAndTheirParametersMustBeKnown) {
  expect_bad_input([] { parse_text("objects:\n  - name: a\n    shape: {type: blob}\n"); },
                   {"scene.yaml:3:", "blob", "sphere"});
  expect_bad_input([] { parse_text("objects:\n  - name: a\n    shape: {type: box, size: 1}\n"); },
                   {"scene.yaml:3:", "size", "size_x_m"});
  expect_bad_input([] { parse_text("objects:\n  - name: a\n    shape: {type: box, size_x_m: wide}\n"); },
                   {"scene.yaml:3:", "size_x_m", "'wide'"});
  expect_bad_input([] { parse_text("objects:\n  - name: a\n    shape: {size_x_m: 1}\n"); },
                   {"scene.yaml:3:", "'type'"});
  expect_bad_input([] { parse_text("objects:\n  - name: a\n    shape: {type: box, type: sphere}\n"); },
                   {"scene.yaml:3:", "'type'", "twice"});
  expect_bad_input([] { parse_text("objects:\n  - name: a\n    shape: box\n"); }, {"scene.yaml:3:", "shape"});
}

TEST(SceneReader, AMeshThatCannotBeReadNamesSceneLineAndFile) {
  expect_bad_input([] { parse_text("objects:\n  - name: a\n    mesh: none.obj\n"); }, {"scene.yaml:3:", "none.obj"});
}

TEST(SceneReader, ValuesOfTheWrongTypeNameKeyAndValue) {
  expect_bad_input([] { parse_object("    movable: maybe\n"); }, {"scene.yaml:4:", "movable", "'maybe'"});
  expect_bad_input([] { parse_object("    pose: here\n"); }, {"scene.yaml:4:", "pose", "'here'"});
  expect_bad_input([] { parse_object("    pose: {position_m: [0, 0]}\n"); },
                   {"scene.yaml:4:", "position_m", "3 numbers"});
  expect_bad_input([] { parse_object("    pose: {position_m: [0, 0, up]}\n"); },
                   {"scene.yaml:4:", "position_m", "'up'"});
  expect_bad_input([] { parse_object("script: [a, b]\n"); }, {"scene.yaml:4:", "script", "a list"});
}

TEST(SceneReader, ScaleIsForMeshesOnlyAndMustBeValid) {
  const TemporaryFolder folder;
  folder.write("part.obj", kTetrahedronObj);
  const auto read_scaled = [&](const std::string& scale) {
    read_scene(folder.write("scene.yaml", "objects:\n  - name: part\n    mesh: part.obj\n    scale: " + scale + "\n"));
  };
  expect_bad_input([&] { read_scaled("big"); }, {"scene.yaml:4:", "scale", "'big'"});
  expect_bad_input([&] { read_scaled("-1"); }, {"scene.yaml:4:", "scale", "'-1'"});
  expect_bad_input([&] { read_scaled(".nan"); }, {"scene.yaml:4:", "scale", "'.nan'"});
  expect_bad_input([&] { read_scaled("1e12"); }, {"scene.yaml:3:", "part.obj"});
  expect_bad_input([] { parse_object("    scale: 2\n"); }, {"scene.yaml:4:", "scale", "for meshes"});
}

TEST(SceneReader, ACompliancePointTooFarFromItsObjectNamesTheKeyAndTheLimit) {
  const std::string ball = "objects:\n  - name: ball\n    shape: {type: sphere, radius_m: 0.027}\n";
  // The sphere is a mesh with vertices on its axes, so that the farthest vertex is at its radius.
  expect_bad_input([&] { parse_text(ball + "    compliance_point_m: [0, 0, 27]\n"); },
                   {"scene.yaml:4: compliance_point_m: must lie within 0.27 m of the centre", "not 27 m from it"});
  EXPECT_TRUE(parse_text(ball + "    compliance_point_m: [0, 0, 0.26]\n").objects[0].compliance_point_B);
}

TEST(SceneReader, NonUnitQuaternionsAreRefused) {
  expect_bad_input([] { parse_object("    pose: {orientation_wxyz: [0, 0, 0, 0]}\n"); },
                   {"scene.yaml:4:", "orientation_wxyz", "is zero"});
  expect_bad_input([] { parse_object("goal:\n  orientation_wxyz: [1, 0.1, 0, 0]\n"); },
                   {"scene.yaml:5:", "orientation_wxyz", "length"});
}

TEST(SceneReader, WhatIsNotASceneIsAnError) {
  expect_bad_input([] { parse_text("objects: [\n"); }, {"scene.yaml:", "not valid YAML"});
  expect_bad_input([] { parse_text("a: b: c\n"); }, {"scene.yaml:1:", "not valid YAML"});
  expect_bad_input([] { parse_text(""); }, {"scene.yaml", "must be a map"});
  expect_bad_input([] { parse_text("just text\n"); }, {"scene.yaml:1:", "scene", "'just text'"});
  expect_bad_input([] { parse_text("script: hand.csv\n"); }, {"scene.yaml:1:", "'objects'", "missing"});
  expect_bad_input([] { parse_text("objects: []\n"); }, {"scene.yaml:1:", "objects"});
  expect_bad_input([] { parse_text("objects:\n  - 7\n"); }, {"scene.yaml:2:", "object", "'7'"});
}

TEST(SceneReader, SecondYamlDocumentIsRefused) {
  expect_bad_input([] { parse_object("---\nobjects: []\n"); }, {"scene.yaml:4:", "second"});
  expect_bad_input([] { parse_object("---\n"); }, {"scene.yaml:", "second"});
  for (const char* comma : {", 1", "[a] , b", "{objects: []}\n,"})
    expect_bad_input([&] { parse_text(comma); }, {"scene.yaml:", "second"});
  EXPECT_EQ(parse_text("---\nobjects:\n  - {name: a, shape: {type: box}}\n...\n").objects.size(), 1U);
}

TEST(SceneReader, AFileThatCannotBeReadIsNamed) {
  const TemporaryFolder folder;
  const std::string pipe = folder.path("pipe.yaml");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  expect_bad_input([&] { read_scene(pipe); }, {"pipe.yaml: is not a regular file"});
  expect_bad_input([] { read_scene(""); }, {"name", "empty"});
  expect_bad_input([&] { read_scene(folder.path("none.yaml")); }, {"none.yaml: there is no such file"});
  expect_bad_input([&] { read_scene(folder.path("")); }, {"is a folder"});
}

}  // namespace
}  // namespace glissade::simulation
