#pragma once

/// The wearer of an emulated glove: fingers and palm follow one script by one clock.

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

#include <glissade/apps/run/lcm_option.h>
#include <glissade/bridges/emulator.h>
#include <glissade/devices/lcm_bus.h>
#include <glissade/devices/lcm_glove.h>

namespace glissade::apps {

struct WearerOptions {
  std::string script;       ///< empty: `bridges::busy_wearer`
  bool is_tracked = false;  ///< the wearer has a tracker, which sends the pose of the palm
  std::int64_t device = devices::kDefaultDevice;
  LcmAddress lcm;
};

/// --script, and --tracker with the options of its messages.
void add_wearer_options(CLI::App& command, WearerOptions& options);

/// The wearer of these options. Throws what `open_bus` and `scripted_wearer` throw.
bridges::EmulatedWearer wearer_of(const WearerOptions& options);

/// The fingers move two seconds after the start. If there is a bus, each call also sends the pose for this glove on
/// HAND_POSE, if one of 90 poses per second is due: so if the machine is too slow for the dynamics, palm and fingers
/// are late together. Throws what `read_hand_script` throws, and std::invalid_argument for a script without joint
/// angles.
bridges::EmulatedWearer scripted_wearer(const std::string& script, std::shared_ptr<devices::LcmBus> tracker_bus,
                                        std::int64_t device);

/// The time from the start to the first move of a script, so that bridge and server can start.
inline constexpr std::chrono::seconds kScriptWait{2};

}  // namespace glissade::apps
