#pragma once

/// The simulation of a run, as the commands that run, record and repeat start it.

#include <chrono>
#include <cstddef>
#include <optional>
#include <vector>

#include <glissade/apps/haptic_scene.h>
#include <glissade/apps/sliding_option.h>
#include <glissade/devices/glove_device.h>
#include <glissade/haptics/multi_part_sliding.h>
#include <glissade/haptics/sliding_rules.h>

namespace glissade::apps {

/// A device and the part that its hand takes.
struct Grip {
  devices::DeviceDescriptor device;
  std::optional<std::size_t> part;
};

/// Starts the simulation. A part has its default stiffness, lowered to the limits of the devices that hold it. Throws
/// std::invalid_argument, naming the scene, for a part that starts inside an obstacle.
haptics::MultiPartSliding start_sliding(const HapticScene& scene, const std::vector<Grip>& grips,
                                        const SlidingChoice& choice, const haptics::SlidingRules& rules,
                                        std::chrono::nanoseconds period = haptics::kTickPeriod);

}  // namespace glissade::apps
