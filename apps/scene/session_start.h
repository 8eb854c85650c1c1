#pragma once

/// The simulation of a run, as the commands that run, record and repeat start it.

#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include <glissade/apps/scene/haptic_scene.h>
#include <glissade/apps/scene/sliding_option.h>
#include <glissade/devices/glove_device.h>
#include <glissade/grasping/grasp_simulation.h>
#include <glissade/grasping/hand_model.h>
#include <glissade/haptics/haptic_kernel.h>

namespace glissade::apps {

/// A device, and what its hand takes.
struct Grip {
  devices::DeviceDescriptor device;
  std::optional<std::size_t> part{};             ///< number of the part; not of a hand with fingers
  std::optional<grasping::HandShape> fingers{};  ///< of a hand that takes hold with its fingers
};

/// What these devices cannot do, each in a sentence with the reason: contacts are softer than chosen; they are less
/// than half as stiff for a hand 0.1 m beside the reference point of its part or, with `has_links`, behind a link that
/// delays by a period; a hand with fingers has no joints.
std::vector<std::string> limits_of_devices(const std::vector<Grip>& grips, const SlidingChoice& choice,
                                           std::chrono::nanoseconds period, bool has_links = false);

/// Starts the simulation. A part has the chosen stiffness, lowered to the limits of all devices: each may come to hold
/// it. All hands have fingers, or none. Throws std::invalid_argument, naming the scene, for a part
/// that starts inside another object, with how deep it is and what can be done.
grasping::GraspSimulation start_simulation(const HapticScene& scene, const std::vector<Grip>& grips,
                                           const SlidingChoice& choice, const contact::SlidingRules& rules,
                                           std::chrono::nanoseconds period = haptics::kTickPeriod);

/// The model of each of `count` hands; null for one without fingers.
std::vector<std::shared_ptr<const grasping::HandModel>> hand_models(const grasping::GraspSimulation& simulation,
                                                                    std::size_t count);

}  // namespace glissade::apps
