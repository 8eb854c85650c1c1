// Objects may be freed in any order, and one server at a time uses them.

#include <cstddef>

#include <gmock/gmock.h>

#include "c_scene.h"

namespace glissade {
namespace {

TEST_F(BoxOnPlate, AServerKeepsWhatItUses) {
  const GlissadeGlove glove = driven_glove();
  GlissadeServer server{};
  ASSERT_C(glissade_server_start(simulation, &glove, 1, &server));
  EXPECT_C(glissade_scene_free(scene));
  EXPECT_C(glissade_glove_free(glove));
  EXPECT_C(glissade_simulation_free(simulation));
  GlissadeFrame frame;
  EXPECT_C(glissade_server_frame(server, &frame));
  EXPECT_EQ(frame.part_count, 1);
  EXPECT_DOUBLE_EQ(frame.parts[0].X_WV.z, 0.022) << "where it starts, before any state of the glove";
  EXPECT_C(glissade_server_check(server));
  EXPECT_C(glissade_server_free(server));
  EXPECT_EQ(glissade_server_frame(server, &frame), GLISSADE_INVALID);
}

TEST_F(BoxOnPlate, OneServerAtATimeUsesAGloveAndASimulation) {
  const GlissadeGlove gloves[] = {driven_glove(), driven_glove()};
  GlissadeServer server{};
  GlissadeServer second{};
  const GlissadeGlove twice[] = {gloves[0], gloves[0]};
  EXPECT_EQ(glissade_server_start(simulation, twice, 2, &server), GLISSADE_INVALID);
  EXPECT_THAT(glissade_last_error(), testing::HasSubstr("gloves[1] is in use"));
  ASSERT_C(glissade_server_start(simulation, &gloves[0], 1, &server)) << "the failure has left nothing in use";
  EXPECT_EQ(glissade_server_start(simulation, &gloves[1], 1, &second), GLISSADE_INVALID);
  EXPECT_THAT(glissade_last_error(), testing::HasSubstr("the simulation is in use"));
  const GlissadePose ghost = at_height(0.02);
  EXPECT_EQ(glissade_simulation_advance(simulation, &ghost, 1, 1.0), GLISSADE_INVALID);
  std::size_t part = 9;
  EXPECT_C(glissade_simulation_find_part(simulation, "box", &part)) << "names and numbers do not change";
  EXPECT_C(glissade_server_stop(server));
  EXPECT_C(glissade_server_stop(server));
  EXPECT_C(glissade_simulation_advance(simulation, &ghost, 1, 1.0)) << "free again";
  ASSERT_C(glissade_server_start(simulation, &gloves[1], 1, &second));
  EXPECT_C(glissade_server_free(second));
  EXPECT_C(glissade_server_free(server));
  for (const GlissadeGlove& glove : gloves)
    EXPECT_C(glissade_glove_free(glove));
}

TEST_F(BoxOnPlate, ASimulatedGloveHasNoDriver) {
  const double time_s = 0.0;
  const GlissadePose hand = at_height(0.1);
  GlissadeGlove glove{};
  ASSERT_C(glissade_glove_new_simulated(&time_s, &hand, 1, &glove));
  GlissadeGloveState state;
  ASSERT_C(glissade_glove_state_default(&state));
  EXPECT_EQ(glissade_glove_put(glove, &state), GLISSADE_INVALID);
  EXPECT_THAT(glissade_last_error(), testing::HasSubstr("drives itself"));
  GlissadeServer server{};
  ASSERT_C(glissade_server_start(simulation, &glove, 1, &server));
  EXPECT_C(glissade_glove_free(glove));
  EXPECT_EQ(glissade_server_grasp(server, 0, 7), GLISSADE_INVALID);
  EXPECT_EQ(glissade_server_release(server, 1), GLISSADE_INVALID);
  EXPECT_C(glissade_server_release(server, 0));
  EXPECT_C(glissade_server_emergency_stop(server));
  EXPECT_C(glissade_server_free(server));
}

}  // namespace
}  // namespace glissade
