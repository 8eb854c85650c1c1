/// Scenes written to files, and read back.

#include <chrono>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glissade/geometry/mesh_generators.h>
#include <glissade/simulation/scene.h>
#include <glissade/simulation/simulation.h>

#include "expect_bad_input.h"
#include "poses.h"
#include "temporary_folder.h"
#include "tetrahedron_file.h"

namespace glissade::simulation {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using std::chrono::nanoseconds;
using test_support::at;
using test_support::expect_bad_input;
using test_support::kTetrahedronObj;
using test_support::pose;
using test_support::TemporaryFolder;
using test_support::turn;
namespace fs = std::filesystem;

/// Also tells 0 from -0.
template <typename Matrix>
bool are_same_bits(const Matrix& a, const Matrix& b) {
  return std::memcmp(a.data(), b.data(), sizeof(double) * static_cast<std::size_t>(a.size())) == 0;
}

void expect_equal_meshes(const SceneMesh& a, const SceneMesh& b) {
  EXPECT_EQ(a->triangles, b->triangles);
  ASSERT_EQ(a->vertices.size(), b->vertices.size());
  for (std::size_t i = 0; i < a->vertices.size(); ++i)
    ASSERT_TRUE(are_same_bits(a->vertices[i], b->vertices[i])) << "vertex " << i;
}

void expect_equal_motions(const SceneMotion& a, const SceneMotion& b) {
  EXPECT_EQ(a.grip_N_per_m, b.grip_N_per_m);
  ASSERT_EQ(a.script_X_WB.rows().size(), b.script_X_WB.rows().size());
  for (std::size_t i = 0; i < a.script_X_WB.rows().size(); ++i) {
    EXPECT_EQ(a.script_X_WB.rows()[i].time, b.script_X_WB.rows()[i].time) << "row " << i;
    EXPECT_TRUE(are_same_bits(a.script_X_WB.rows()[i].X_WB.matrix(), b.script_X_WB.rows()[i].X_WB.matrix()));
  }
}

void expect_equal(const Scene& a, const Scene& b) {
  ASSERT_EQ(a.objects.size(), b.objects.size());
  for (std::size_t i = 0; i < a.objects.size(); ++i) {
    const SceneObject& object = a.objects[i];
    const SceneObject& other = b.objects[i];
    SCOPED_TRACE(object.name);
    EXPECT_EQ(object.name, other.name);
    expect_equal_meshes(object.mesh, other.mesh);
    EXPECT_TRUE(are_same_bits(object.X_WB.matrix(), other.X_WB.matrix()));
    EXPECT_EQ(object.movable, other.movable);
    ASSERT_EQ(object.motion.has_value(), other.motion.has_value());
    if (object.motion) expect_equal_motions(*object.motion, *other.motion);
    EXPECT_EQ(object.margin_m, other.margin_m);
    EXPECT_EQ(object.compliance_point_B, other.compliance_point_B);
    EXPECT_EQ(object.giving_way, other.giving_way);
  }
  ASSERT_EQ(a.X_WGoal.has_value(), b.X_WGoal.has_value());
  if (a.X_WGoal) {
    EXPECT_TRUE(are_same_bits(a.X_WGoal->matrix(), b.X_WGoal->matrix()));
  }
  ASSERT_EQ(a.script_path.has_value(), b.script_path.has_value());
  if (a.script_path) {
    EXPECT_EQ(fs::weakly_canonical(*a.script_path), fs::weakly_canonical(*b.script_path));
  }
}

Scene written_and_read(const Scene& scene, const fs::path& path) {
  write_scene(scene, path);
  return read_scene(path);
}

std::string text_of(const fs::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Every key that a scene file may have, with digits that no short decimal holds.
std::string scene_of_all_keys(const TemporaryFolder& folder) {
  folder.write("part.obj", kTetrahedronObj);
  folder.write("double.obj", std::string(kTetrahedronObj) + "f 1 3 2\nf 1 1 2\n");
  folder.write("lift.csv",
               "t_s,x_m,y_m,z_m,roll_deg,pitch_deg,yaw_deg\n"
               "0.123456789,0,0,0.1,10,20,30\n0.3,0,0.7,-0,40,50,60\n");
  return folder.write("scene.yaml",
                      "objects:\n"
                      "  - name: \"a: 'b', #7\"\n"
                      "    mesh: part.obj\n"
                      "    scale: 0.0254\n"
                      "    pose: {position_m: [0.1, 1e-300, -0.0], orientation_rpy_deg: [10, 20, 30]}\n"
                      "    movable: true\n"
                      "    compliance_point_m: [0.001, 0.002, 0.1]\n"
                      "  - name: 12\n"
                      "    mesh: double.obj\n"
                      "    welded: false\n"
                      "    pose: {position_m: [5, 0, 0], orientation_wxyz: [0.3, 0.4, 0.5, 0.7071]}\n"
                      "    margin_m: 2.3e-6\n"
                      "  - name: box\n"
                      "    shape: {type: box, size_x_m: 0.3, triangles: 300}\n"
                      "    pose: {orientation_matrix: [0, -1, 0, 1, 0, -0.0, 0, 0, 1]}\n"
                      "    gives_way: [{min_m: [-1, -1, 0.04], max_m: [1, 1, 1]},\n"
                      "                {min_m: [-1, 0.04, -1], max_m: [0, 1, 1]}]\n"
                      "  - {name: lift, shape: {type: sphere}, moves: lift.csv, grip_N_per_m: 1000.1}\n"
                      "  - {name: lid, shape: {type: sphere}, moves: [{t_s: 1, position_m: [1, 0, 9]}, {t_s: 2.5}]}\n"
                      "script: hand.csv\n"
                      "goal: {position_m: [0.1, 0.2, 0.3], orientation_rpy_deg: [1, 2, 3]}\n");
}

TEST(SceneWriter, RoundTripOfEveryKeyIsBitIdentical) {
  const TemporaryFolder folder;
  const Scene scene = read_scene(scene_of_all_keys(folder));
  const TemporaryFolder other;
  const Scene read = written_and_read(scene, other.path("copy.yaml"));
  expect_equal(scene, read);
  EXPECT_EQ(read.objects[3].mesh.shared(), read.objects[4].mesh.shared()) << "of one shape";
  EXPECT_EQ(std::distance(fs::directory_iterator(other.path("")), {}), 1) << "no mesh was given as a value";
  fs::create_directory(folder.path("below"));
  expect_equal(scene, written_and_read(read, folder.path("below/again.yaml")));
  EXPECT_THAT(text_of(folder.path("below/again.yaml")), testing::HasSubstr("mesh: ../part.obj\n"));
}

/// Objects as a program makes them: no mesh is welded, no matrix comes from a quaternion.
Scene scene_in_code() {
  geometry::TriangleMesh mesh = geometry::make_sphere(0.02, 500);
  mesh.vertices.push_back(Vector3d(-0.0, 1.0 / 3.0, 1e-17));  // of no triangle
  mesh.vertices.push_back(mesh.vertices.front());
  mesh.triangles.push_back({0, 0, 1});
  const SceneMesh ball = mesh;
  Isometry3d X = Isometry3d::Identity();
  for (int i = 0; i < 7; ++i)
    X = X * pose({0.01, 1.0 / 3.0, 0.0}, turn(0.1 + i, {1.0, 2.0, 3.0}));
  geometry::PoseTrajectory path({{nanoseconds(-7), X}, {nanoseconds(123'456'789'012'345), X * X}});
  return {.objects = {
              {.name = "ball", .mesh = ball, .X_WB = X, .movable = true},
              {.name = "plate", .mesh = geometry::make_plate({0.2, 0.2}, 200), .X_WB = at(0, 0, -0.1)},
              {.name = "twin", .mesh = ball, .X_WB = path.pose_at(path.first_time()), .motion = SceneMotion{path}}}};
}

TEST(SceneWriter, RoundTripOfASceneMadeInCodeIsBitIdentical) {
  const TemporaryFolder folder;
  const Scene scene = scene_in_code();
  const Scene read = written_and_read(scene, folder.path("cell.yaml"));
  expect_equal(scene, read);
  EXPECT_EQ(read.objects[0].mesh.shared(), read.objects[2].mesh.shared());
  EXPECT_TRUE(fs::exists(folder.path("cell_1.obj")));
  EXPECT_TRUE(fs::exists(folder.path("cell_2.obj")));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path("")), {}), 3) << "two share a mesh";
  expect_equal(scene, written_and_read(read, folder.path("second.yaml")));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path("")), {}), 4) << "the meshes are files by now";
}

TEST(SceneWriter, TheCopyOfASceneMovesAsTheScene) {
  const TemporaryFolder folder;
  const Scene scene{.objects = {{.name = "floor", .mesh = geometry::make_box({1.0, 1.0, 0.1}, 300)},
                                {.name = "ball",
                                 .mesh = geometry::make_sphere(0.03, 800),
                                 .X_WB = pose({0.0, 0.0, 0.09}, turn(0.3, {1.0, 2.0, 3.0})),
                                 .movable = true}}};
  Simulation simulation(scene);
  Simulation copy(written_and_read(scene, folder.path("scene.yaml")));
  for (int ms = 0; ms < 100; ++ms) {
    simulation.advance(at(1e-3 * ms, 0.0, 0.06));
    copy.advance(at(1e-3 * ms, 0.0, 0.06));
    ASSERT_TRUE(are_same_bits(simulation.X_WV(0).matrix(), copy.X_WV(0).matrix()));
    ASSERT_TRUE(are_same_bits(simulation.wrench(0).f, copy.wrench(0).f));
  }
  EXPECT_GT(simulation.wrench(0).f.z(), 1.0);
}

TEST(SceneWriter, BoxesHoldTheTrianglesThatGiveWayAndNoOthers) {
  const TemporaryFolder folder;
  Scene scene{.objects = {{.name = "plate", .mesh = geometry::make_plate({0.2, 0.2}, 200)}}};
  const auto count = static_cast<std::int32_t>(scene.objects[0].mesh->triangles.size());
  for (std::int32_t t = 0; t < count; t += 4) {
    scene.objects[0].giving_way.push_back(t);  // a square of a grid is two triangles, of one box
    scene.objects[0].giving_way.push_back(t + 1);
  }
  expect_equal(scene, written_and_read(scene, folder.path("scene.yaml")));
  scene.objects[0].giving_way = {6};
  expect_bad_input([&] { write_scene(scene, folder.path("half.yaml")); },
                   {"half.yaml: cannot be written: object 'plate': no boxes hold the triangles that give way"});
  EXPECT_FALSE(fs::exists(folder.path("half.yaml")));
}

TEST(SceneWriter, OtherFilesAreNotOverwritten) {
  const TemporaryFolder folder;
  const Scene scene = scene_in_code();
  folder.write("cell_2.obj", "of somebody else");
  expect_bad_input([&] { write_scene(scene, folder.path("cell.yaml")); },
                   {"cell_2.obj: is there already, with another content"});
  EXPECT_EQ(text_of(folder.path("cell_2.obj")), "of somebody else");
  EXPECT_FALSE(fs::exists(folder.path("cell_1.obj"))) << "nothing is written";
  EXPECT_FALSE(fs::exists(folder.path("cell.yaml")));
  write_scene(scene, folder.path("desk.yaml"));
  write_scene(scene, folder.path("desk.yaml"));  // the same once more
  expect_bad_input([&] { write_scene(scene, folder.path("none/cell.yaml")); },
                   {"none/cell", ".obj: cannot be created: there is no folder"});
  const std::string file = scene_of_all_keys(folder);
  Scene changed = read_scene(file);
  changed.objects.pop_back();
  expect_bad_input([&] { write_scene(changed, file); }, {"scene.yaml: is there already"});
}

/// What is written of a changed scene is refused with these words, and leaves no file.
void expect_refused(const std::function<void(Scene&)>& change, const std::vector<std::string>& parts) {
  SCOPED_TRACE(testing::PrintToString(parts));
  const TemporaryFolder folder;
  Scene scene = scene_in_code();
  change(scene);
  expect_bad_input([&] { write_scene(scene, folder.path("x.yaml")); }, parts);
  EXPECT_TRUE(fs::is_empty(folder.path("")));
}

TEST(SceneWriter, WhatSceneFilesDoNotHaveIsRefused) {
  const std::string begin = "x.yaml: cannot be written: ";
  expect_refused([](Scene& scene) { scene.hands.emplace_back(); }, {begin + "scene files have no hands"});
  for (const std::function<void(Scene&)>& change : std::vector<std::function<void(Scene&)>>{
           [](Scene& scene) { scene.metaphor = contact::Metaphor::kRubberBand; },
           [](Scene& scene) { scene.stiffness_N_per_m += 1.0; },
           [](Scene& scene) { scene.rules.friction.at_rest = 0.1; }, [](Scene& scene) { scene.rules.margin = 1e-6; },
           [](Scene& scene) { scene.up_W = Vector3d::UnitX(); }})
    expect_refused(change, {begin + "scene files have no metaphor, stiffness, rules or upward direction"});
  expect_refused([](Scene& scene) { scene.script_path = "\xff\n"; }, {begin + "the name of its script is no text"});
  expect_refused([](Scene& scene) { scene.objects.clear(); }, {begin + "there are no objects"});
}

TEST(SceneWriter, WhatTheReaderWouldRefuseOrChangeIsNotWritten) {
  const std::string begin = "x.yaml: cannot be written: object ";
  expect_refused([](Scene& scene) { scene.objects[1].name = "ball"; }, {"object 'ball': another object"});
  expect_refused([](Scene& scene) { scene.objects[1].mesh = {}; }, {"object 'plate' has no mesh"});
  expect_refused([](Scene& scene) { scene.objects[1].X_WB = at(1e10); }, {"object 'plate': vertex 0 lies beyond"});
  expect_refused([](Scene& scene) { scene.objects[1].giving_way = {3, 3}; }, {"object 'plate': triangle 3 cannot"});
  expect_refused([](Scene& scene) { scene.objects[1].name = ""; }, {begin + "''", "name: must be a text"});
  expect_refused([](Scene& scene) { scene.objects[1].name = "\xff\n"; }, {begin, "its name is no text in UTF-8"});
  expect_refused([](Scene& scene) { scene.objects[1].margin_m = -1.0; },
                 {begin + "'plate'", "margin_m: must be positive", "'-1'"});
  expect_refused([](Scene& scene) { scene.objects[1].margin_m = std::nan(""); },
                 {begin + "'plate'", "margin_m", "'nan'"});
  expect_refused([](Scene& scene) { scene.objects[1].compliance_point_B = Vector3d(9, 0, 0); },
                 {begin + "'plate'", "compliance_point_m: must lie within"});
  expect_refused([](Scene& scene) { scene.objects[2].movable = true; },
                 {begin + "'twin'", "movable: is not for objects that move"});
  expect_refused([](Scene& scene) { scene.objects[2].motion->grip_N_per_m = 0.0; },
                 {begin + "'twin'", "grip_N_per_m: must be positive"});
  expect_refused([](Scene& scene) { scene.objects[0].X_WB.linear() *= 1.0 + 1e-9; },
                 {begin + "'ball': its rotation has a defect above 1e-12"});
  expect_refused([](Scene& scene) { scene.objects[0].X_WB.linear() *= 1.1; },
                 {begin + "'ball'", "orientation_matrix: is no rotation"});
  expect_refused([](Scene& scene) { scene.X_WGoal = at(0, 0, 1e10); }, {"x.yaml: goal: the position 1e+10 is beyond"});
  expect_refused(
      [](Scene& scene) {
        const nanoseconds late((std::int64_t{1} << 55) + 1);
        scene.objects[2].motion->script_X_WB = geometry::PoseTrajectory({{nanoseconds(0), at(0)}, {late, at(1)}});
      },
      {begin + "'twin': row 1 of its motion has a time"});
}

}  // namespace
}  // namespace glissade::simulation
