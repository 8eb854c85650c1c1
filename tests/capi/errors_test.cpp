// Wrong arguments are errors with a sentence that names them, and never a crash.

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include <gmock/gmock.h>

#include "c_scene.h"

namespace glissade {
namespace {

using testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

void expect_invalid(GlissadeStatus status, const std::string& part) {
  EXPECT_EQ(status, GLISSADE_INVALID);
  EXPECT_THAT(glissade_last_error(), HasSubstr(part));
  EXPECT_THAT(glissade_last_error(), testing::Not(HasSubstr("\n")));
}

TEST_F(BoxOnPlate, HandlesThatAreNullWrongOrFreed) {
  expect_invalid(glissade_scene_set_movable({0}, "box", 1), "the handle of the scene is null");
  expect_invalid(glissade_scene_set_movable({simulation.id}, "box", 1), "no scene with the handle");
  expect_invalid(glissade_simulation_advance({scene.id}, nullptr, 0, 1.0), "no simulation with the handle");
  GlissadeFrame frame;
  expect_invalid(glissade_server_frame({~std::uint64_t{0}}, &frame), "no server with the handle");
  expect_invalid(glissade_server_start(simulation, nullptr, 1, nullptr), "server is null");
  const GlissadeGlove glove = driven_glove();
  ASSERT_C(glissade_glove_free(glove));
  GlissadeGloveCommand command;
  expect_invalid(glissade_glove_command(glove, &command), "it was freed");
  expect_invalid(glissade_glove_free(glove), "it was freed");
}

TEST_F(BoxOnPlate, PointersThatAreNull) {
  GlissadeScene made{};
  expect_invalid(glissade_scene_new(nullptr), "scene is null");
  expect_invalid(glissade_scene_read(nullptr, &made), "path is null");
  expect_invalid(glissade_scene_add_file(scene, nullptr, "x.stl", 1.0, nullptr), "x.stl");
  expect_invalid(glissade_scene_add_shape(scene, nullptr, "box", nullptr, nullptr, 0, nullptr), "name is null");
  expect_invalid(glissade_scene_add_shape(scene, "b", nullptr, nullptr, nullptr, 0, nullptr), "type is null");
  expect_invalid(glissade_scene_add_shape(scene, "b", "box", nullptr, nullptr, 1, nullptr), "parameters is null");
  expect_invalid(glissade_scene_add_mesh(scene, "m", nullptr, 3, nullptr, 1, nullptr), "vertices is null");
  expect_invalid(glissade_scene_set_pose(scene, "box", nullptr), "X_WB is null");
  expect_invalid(glissade_scene_object(scene, 0, nullptr), "out is null");
  expect_invalid(glissade_simulation_advance(simulation, nullptr, 1, 1.0), "ghosts is null");
  expect_invalid(glissade_simulation_part(simulation, 0, nullptr), "out is null");
  expect_invalid(glissade_glove_new("g", nullptr, nullptr), "glove is null");
  expect_invalid(glissade_device_default(nullptr), "device is null");
  expect_invalid(glissade_pose_to_engine(GLISSADE_UNITY, nullptr, nullptr), "null");
  expect_invalid(glissade_vector_to_engine(GLISSADE_UNITY, nullptr, nullptr), "vector is null");
  expect_invalid(glissade_reason_text(0, 0, nullptr, 4), "text is null");
}

TEST_F(BoxOnPlate, NumbersThatAreNone) {
  GlissadePose pose = at_height(kNan);
  expect_invalid(glissade_scene_set_pose(scene, "box", &pose), "X_WB has a number that is not finite");
  expect_invalid(glissade_simulation_advance(simulation, &pose, 1, 1.0), "ghosts");
  pose = {0, 0, 0, 0.5, 0, 0, 0};
  expect_invalid(glissade_scene_set_pose(scene, "box", &pose), "has length 0.5 instead of 1");
  pose.qw = kNan;
  expect_invalid(glissade_pose_to_engine(GLISSADE_UNREAL, &pose, &pose), "pose");
  pose.qw = 1.0;
  expect_invalid(glissade_pose_to_engine(7, &pose, &pose), "engine is 7");
  expect_invalid(glissade_simulation_advance(simulation, &pose, 1, kNan), "milliseconds");
  expect_invalid(glissade_simulation_advance(simulation, &pose, 1, -1.0), "milliseconds");
  expect_invalid(glissade_scene_set_friction(scene, kNan, 0.0), "at_rest");
  expect_invalid(glissade_scene_set_friction(scene, 0.2, 0.3), "sliding");
  expect_invalid(glissade_scene_set_stiffness(scene, 0.0), "stiffness_N_per_m");
  expect_invalid(glissade_scene_set_margin(scene, "plate", 1.0), "margin_m");
  const double vertices[] = {0, 0, 0, 1, 0, 0, 0, kNan, 0};
  const std::int32_t triangle[] = {0, 1, 2};
  expect_invalid(glissade_scene_add_mesh(scene, "m", vertices, 3, triangle, 1, nullptr), "vertex 2 is not finite");

  const GlissadeGlove glove = driven_glove();
  GlissadeGloveState state;
  glissade_glove_state_default(&state);
  state.velocity_m_per_s[1] = kNan;
  expect_invalid(glissade_glove_put(glove, &state), "velocity_m_per_s");
  glissade_glove_state_default(&state);
  state.joint_angles_rad[21] = kNan;
  expect_invalid(glissade_glove_put(glove, &state), "joint_angles_rad");
  glissade_glove_state_default(&state);
  state.time_ns = INT64_MIN;
  expect_invalid(glissade_glove_put(glove, &state), "time_ns");
  glissade_glove_free(glove);
  GlissadeDevice device;
  glissade_device_default(&device);
  GlissadeGlove refused{};
  device.max_force_N = -1.0;
  expect_invalid(glissade_glove_new("my glove", &device, &refused), "my glove");
  glissade_device_default(&device);
  device.max_mean_force_N = -1.0;
  expect_invalid(glissade_glove_new("my glove", &device, &refused), "my glove");
  const double times_s[] = {0.0, kNan};
  const GlissadePose hand[] = {at_height(0), at_height(0)};
  expect_invalid(glissade_glove_new_simulated(times_s, hand, 2, &refused), "times_s");
}

TEST_F(BoxOnPlate, LengthsAndNumbersThatDoNotFit) {
  const GlissadePose two[] = {at_height(0.1), at_height(0.1)};
  expect_invalid(glissade_simulation_advance(simulation, two, 2, 1.0), "2 poses for 1 part");
  expect_invalid(glissade_simulation_advance(simulation, nullptr, 0, 1.0), "0 poses for 1 part");
  GlissadePart part;
  expect_invalid(glissade_simulation_part(simulation, 1, &part), "there is no part 1");
  GlissadeObject object;
  expect_invalid(glissade_scene_object(scene, 2, &object), "there is no object 2");
  const double corners[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const std::int32_t wrong[] = {0, 1, 3};
  expect_invalid(glissade_scene_add_mesh(scene, "m", corners, 3, wrong, 1, nullptr), "has the vertex 3");
  expect_invalid(glissade_scene_add_mesh(scene, "m", corners, SIZE_MAX, wrong, 1, nullptr), "at most");
  GlissadeServer server{};
  expect_invalid(glissade_server_start(simulation, nullptr, 0, &server), "glove_count");
  expect_invalid(glissade_glove_new_simulated(nullptr, nullptr, 0, nullptr), "glove is null");
  GlissadeGlove glove{};
  expect_invalid(glissade_glove_new_simulated(nullptr, nullptr, 0, &glove), "");
  expect_invalid(glissade_reason_text(1, 0, nullptr, 0), "text is null");
  char text[8];
  ASSERT_C(glissade_reason_text(1, 0, text, sizeof text));
  EXPECT_EQ(std::string(text).size(), 7U) << "cut, with its final 0";
}

TEST_F(BoxOnPlate, NamesThatAreUnknownOrTaken) {
  expect_invalid(glissade_scene_set_movable(scene, "boks", 1), "no object 'boks' (known: plate, box)");
  expect_invalid(glissade_scene_add_shape(scene, "box", "box", nullptr, nullptr, 0, nullptr), "already is");
  expect_invalid(glissade_scene_add_shape(scene, "", "box", nullptr, nullptr, 0, nullptr), "name is empty");
  expect_invalid(glissade_scene_add_shape(scene, "b", "bocks", nullptr, nullptr, 0, nullptr), "bocks");
  expect_invalid(glissade_scene_add_file(scene, "m", "missing.stl", 1.0, nullptr), "missing.stl");
  std::size_t part = 0;
  expect_invalid(glissade_simulation_find_part(simulation, "plate", &part), "there is no part 'plate'");
  GlissadeScene read{};
  expect_invalid(glissade_scene_read("missing.yaml", &read), "missing.yaml");
  EXPECT_EQ(read.id, 0U) << "nothing is written";
  ASSERT_C(glissade_scene_set_movable(scene, "box", 0));
  GlissadeSimulation none{};
  expect_invalid(glissade_simulation_new(scene, &none), "no object is movable");
}

}  // namespace
}  // namespace glissade
