#pragma once

/// An arm that holds half-spaces by itself.

#include <glissade/devices/glove_model.h>
#include <glissade/devices/simulated_glove.h>

namespace glissade::test_support {

/// The arm of the simulated glove, which holds half-spaces in a loop of its own.
inline devices::GloveModel holding_arm() {
  const devices::DeviceDescriptor glove = devices::simulated_glove_descriptor();
  devices::GloveModel arm;
  arm.name = "arm that holds half-spaces";
  arm.update_rate = glove.update_rate;
  arm.wrist = {.is_grounded = true,
               .holds_half_spaces = true,
               .max_force = glove.max_force,
               .max_torque = glove.max_torque,
               .max_stiffness = glove.max_stiffness,
               .max_rotational_stiffness = glove.max_rotational_stiffness,
               .max_damping = glove.max_damping,
               .damping = glove.damping,
               .rotational_damping = glove.rotational_damping};
  return arm;
}

}  // namespace glissade::test_support
