/// A scene in motion: what a caller asks of it, beside the engine's own answers.

#include <array>
#include <chrono>
#include <memory>
#include <optional>
#include <stdexcept>

#include <gtest/gtest.h>

#include <glissade/geometry/mesh_generators.h>
#include <glissade/simulation/simulation.h>

#include "poses.h"

namespace glissade::simulation {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using std::chrono::milliseconds;
using test_support::at;

/// A box of 40 mm over a floor whose upper face is at z = 0, beside a wall whose face is at x = 0.1 m.
Scene room() {
  return {.objects = {{.name = "floor", .mesh = geometry::make_box({1.0, 1.0, 0.1}, 12), .X_WB = at(0.0, 0.0, -0.05)},
                      {.name = "wall", .mesh = geometry::make_box({0.1, 1.0, 1.0}, 12), .X_WB = at(0.15, 0.0, 0.5)},
                      {.name = "box",
                       .mesh = geometry::make_box({0.04, 0.04, 0.04}, 12),
                       .X_WB = at(0.0, 0.0, 0.03),
                       .movable = true}}};
}

void lead(Simulation& simulation, const Isometry3d& X_WG, int calls = 1000) {
  for (int i = 0; i < calls; ++i)
    simulation.advance(X_WG);
}

TEST(Simulation, WrenchIsTheSpringOfTheCouplingAtRest) {
  Scene scene = room();
  scene.stiffness_N_per_m = 500.0;
  Simulation simulation(scene);
  lead(simulation, at(0.02, 0.0, 0.017));
  EXPECT_NEAR(simulation.wrench(0).f.z(), 500.0 * 0.003, 0.01);
  EXPECT_NEAR(simulation.lag(0).v.z(), -0.003, 1e-5);
  EXPECT_LT(simulation.wrench(0).t.norm(), 1e-6);
}

TEST(SceneBodies, EachRowOfAScriptChangesTheHash) {
  const auto hash_with = [](double height) {
    std::vector<geometry::TimedPose> rows;
    for (int i = 0; i <= 5000; ++i)
      rows.push_back({milliseconds(i), at(0.0, 0.0, i == 2503 ? height : 0.5)});
    Scene scene = room();
    scene.objects[1].motion = SceneMotion{geometry::PoseTrajectory(rows)};
    return hash_of(bodies_of(scene, {"box"}));
  };
  EXPECT_EQ(hash_with(0.5), hash_with(0.5));
  EXPECT_NE(hash_with(0.503), hash_with(0.5));
}

TEST(Simulation, AdvanceTakesHoldOfAReleasedPart) {
  Simulation simulation(room());
  simulation.engine().leave_part(0);  // as a server does
  lead(simulation, at(0.02, 0.0, 0.017));
  EXPECT_NEAR(simulation.wrench(0).f.z(), 3.0, 0.01);
}

TEST(Simulation, WrenchIsZeroWhileNothingPushes) {
  Simulation simulation(room());
  for (int ms = 0; ms < 50; ++ms) {
    simulation.advance(at(0.05, 0.0, 0.03));  // 50 mm away: the part lags behind
    ASSERT_EQ(simulation.wrench(0).f, Vector3d::Zero());
  }
  EXPECT_GT(simulation.lag(0).v.norm(), 0.01);
}

TEST(Simulation, ContactsHaveNumbersThatStayAndNamesOfBodies) {
  Simulation simulation(room());
  lead(simulation, at(0.0, 0.0, 0.017));
  ASSERT_EQ(simulation.contacts(0).size(), 4U) << "the corners of the box";
  const std::int64_t first = simulation.contacts(0)[0].id;
  for (int ms = 0; ms < 100; ++ms) {
    simulation.advance(at(1e-4 * ms, 0.0, 0.017));
    ASSERT_EQ(simulation.contacts(0)[0].id, first) << ms;
    ASSERT_EQ(simulation.name_of_body(simulation.contacts(0)[0].contact.obstacle), "floor");
  }
}

TEST(Simulation, ClearanceIsTheDistanceToTheNearestBody) {
  Simulation simulation(room());
  EXPECT_NEAR(simulation.clearance(0), 0.01, 1e-12) << "to the floor";
  EXPECT_EQ(simulation.clearance(0, 0.005), 0.005) << "nothing is nearer";
  lead(simulation, at(0.077, 0.0, 0.03));
  EXPECT_NEAR(simulation.clearance(0), 0.003, 1e-9) << "to the wall";
}

TEST(Simulation, PartsBlockEachOther) {
  Scene scene = room();
  scene.objects.push_back({.name = "other",
                           .mesh = geometry::make_box({0.04, 0.04, 0.04}, 12),
                           .X_WB = at(0.0, 0.06, 0.03),
                           .movable = true});
  Simulation simulation(scene);
  for (int ms = 0; ms < 1000; ++ms)
    simulation.advance(std::array{at(0.0, 0.03, 0.03), at(0.0, 0.06, 0.03)});
  EXPECT_NEAR(simulation.clearance(0), 0.0, 1e-4);
  EXPECT_LT(simulation.wrench(0).f.y(), -1.0);
  EXPECT_GT(simulation.wrench(1).f.y(), 1.0);
  EXPECT_EQ(simulation.name_of_body(simulation.contacts(0)[0].contact.obstacle), "other");
}

TEST(Simulation, ObjectsThatMoveOnTheirOwnPushParts) {
  Scene scene = room();
  const geometry::PoseTrajectory lift(
      {{milliseconds(0), at(0.0, 0.0, 0.005)}, {milliseconds(500), at(0.0, 0.0, 0.03)}});
  scene.objects.push_back({.name = "lift",
                           .mesh = geometry::make_box({0.06, 0.06, 0.008}, 12),
                           .motion = SceneMotion{.script_X_WB = lift}});
  Simulation simulation(scene);
  lead(simulation, at(0.0, 0.0, 0.03), 500);
  EXPECT_NEAR(simulation.X_WV(0).translation().z(), 0.03 + 0.004 + 0.02, 1e-4);
  EXPECT_EQ(simulation.name_of_body(simulation.contacts(0)[0].contact.obstacle), "lift");
}

TEST(Simulation, TrianglesThatGiveWayStopNothing) {
  Scene scene = room();
  SceneObject& floor = scene.objects[0];
  floor.mesh = geometry::make_box({1.0, 1.0, 0.1}, 5000);
  floor.giving_way = geometry::triangles_inside(*floor.mesh, {Vector3d(-0.2, -0.2, -1.0), Vector3d(0.2, 0.2, 1.0)});
  Simulation simulation(scene);
  lead(simulation, at(0.0, 0.0, -0.2));
  EXPECT_LT(simulation.X_WV(0).translation().z(), -0.1) << "through the hole";
}

TEST(Simulation, HandsOfTheSceneTakeHoldOfParts) {
  Simulation simulation(
      {.objects = {{.name = "table", .mesh = geometry::make_box({0.6, 0.6, 0.02}, 200), .X_WB = at(0.1, 0.0, -0.102)},
                   {.name = "ball",
                    .mesh = geometry::make_sphere(0.035, 500),
                    .X_WB = at(0.095, 0.0, -0.056),
                    .movable = true}},
       .hands = {grasping::HandShape{}}});
  grasping::Posture posture{.values = std::vector<double>(hands::kJoints, 0.0)};
  for (int ms = 0; ms < 600; ++ms) {
    for (const std::size_t joint : {0u, 1u, 4u, 5u, 7u, 8u, 11u, 12u, 15u, 16u})
      posture.values[joint] = 1.2 * std::min(1.0, ms / 300.0);
    simulation.advance(std::array{std::optional(posture)});
  }
  EXPECT_EQ(simulation.engine().activity(0), hands::HandActivity::kHolding);
  EXPECT_EQ(simulation.name_of_body(simulation.engine().grasp(0).object), "ball");
  EXPECT_EQ(simulation.name_of_body(2), "a hand") << "after table and ball come its segments";
  EXPECT_EQ(simulation.name_of_body(-1), "nothing");
  EXPECT_THROW(simulation.advance(Isometry3d::Identity()), std::invalid_argument) << "the hand leads the ball";
  EXPECT_THROW(simulation.advance(std::array{std::optional(posture), std::optional(posture)}), std::invalid_argument);
}

TEST(SceneBodies, ObjectsOfOneMeshShareTheirBody) {
  const auto mesh = std::make_shared<const geometry::TriangleMesh>(geometry::make_box({0.1, 0.1, 0.1}, 12));
  Scene scene = room();
  scene.objects.push_back({.name = "left", .mesh = mesh, .X_WB = at(-1.0, 0.0, 0.0)});
  scene.objects.push_back({.name = "right", .mesh = mesh, .X_WB = at(2.0, 0.0, 0.0)});
  const SceneBodies bodies = bodies_of(scene, {"box"});
  EXPECT_EQ(bodies.obstacles[2].body, bodies.obstacles[3].body);
  EXPECT_EQ(bodies.body_names, (std::vector<std::string>{"floor", "wall", "left", "right", "box"}));
}

std::string complaint(const Scene& scene) {
  try {
    Simulation simulation(scene);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "none";
}

TEST(Scene, ComplaintsNameSceneAndObject) {
  Scene none_moves = room();
  none_moves.objects[2].movable = false;
  EXPECT_EQ(complaint(none_moves), "the scene: no object is movable; a hand needs a part to hold");
  Scene twice = room();
  twice.objects[1].name = "floor";
  twice.source = "room.yaml";
  EXPECT_EQ(complaint(twice), "room.yaml: object 'floor': another object has the same name");
  Scene no_mesh = room();
  no_mesh.objects[0].mesh = {};
  EXPECT_EQ(complaint(no_mesh), "the scene: object 'floor' has no mesh");
  Scene inside = room();
  inside.objects[2].X_WB = at(0.0, 0.0, 0.01);
  EXPECT_NE(complaint(inside).find("'box'"), std::string::npos) << complaint(inside);
  Scene wrong_triangle = room();
  wrong_triangle.objects[0].giving_way = {3, 12};
  EXPECT_EQ(complaint(wrong_triangle),
            "the scene: object 'floor': triangle 12 cannot give way: the numbers must ascend, and lie below 12");
  EXPECT_THROW(bodies_of(room(), {"box", "box"}), std::invalid_argument);
  EXPECT_THROW(Simulation(room()).advance(std::array{Isometry3d::Identity(), Isometry3d::Identity()}),
               std::invalid_argument);
  try {
    (void)room().find("bix");
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "the scene: there is no object 'bix' (did you mean 'box'?) (known: floor, wall, box)");
  }
  EXPECT_THROW(SceneMesh("missing.stl", 1.0), std::invalid_argument);
}

}  // namespace
}  // namespace glissade::simulation
