#pragma once

/// A box 2 mm above a plate, in C.

#include <gtest/gtest.h>

#include <glissade/glissade.h>

namespace glissade {

/// Expects that the call succeeds, and shows the sentence if it does not.
#define EXPECT_C(call) EXPECT_EQ(call, GLISSADE_OK) << glissade_last_error()
#define ASSERT_C(call) ASSERT_EQ(call, GLISSADE_OK) << glissade_last_error()

inline GlissadePose at_height(double z) {
  return {0.0, 0.0, z, 1.0, 0.0, 0.0, 0.0};
}

class BoxOnPlate : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_C(glissade_scene_new(&scene));
    ASSERT_C(glissade_scene_add_shape(scene, "plate", "plate", nullptr, nullptr, 0, nullptr));
    const char* const edges[] = {"size_x_m", "size_y_m", "size_z_m"};
    const double edges_m[] = {0.04, 0.04, 0.04};
    const GlissadePose X_WB = at_height(0.022);
    ASSERT_C(glissade_scene_add_shape(scene, "box", "box", edges, edges_m, 3, &X_WB));
    ASSERT_C(glissade_scene_set_movable(scene, "box", 1));
    ASSERT_C(glissade_scene_use_real_time_rules(scene));
    ASSERT_C(glissade_simulation_new(scene, &simulation));
  }
  void TearDown() override {
    glissade_simulation_free(simulation);
    glissade_scene_free(scene);
  }

  /// A glove that the test drives: 20 N, at `update_rate_Hz`.
  static GlissadeGlove driven_glove(double update_rate_Hz = 1000.0) {
    GlissadeDevice device;
    glissade_device_default(&device);
    device.max_force_N = 20.0;
    device.max_stiffness_N_per_m = 1000.0;
    device.max_rotational_stiffness_Nm_per_rad = 5.0;
    device.damping_Ns_per_m = 5.0;
    device.update_rate_Hz = update_rate_Hz;
    GlissadeGlove glove{};
    EXPECT_C(glissade_glove_new("my glove", &device, &glove));
    return glove;
  }

  GlissadeScene scene{};
  GlissadeSimulation simulation{};
};

}  // namespace glissade
