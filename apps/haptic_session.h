#pragma once

/// Runs of the haptic loop for the commands `demo` and `run`.

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

#include <glissade/apps/haptic_scene.h>
#include <glissade/apps/session.h>
#include <glissade/devices/lcm_bus.h>
#include <glissade/devices/lcm_glove.h>
#include <glissade/geometry/pose_trajectory.h>
#include <glissade/haptics/coupling.h>

namespace glissade::apps {

/// Runs the whole system on a simulated clock: `ticks` milliseconds of a simulated glove that follows `script_X_WH`.
/// Throws std::invalid_argument, naming scene and part, when the part collides at its start.
Session run_session_offline(const HapticScene& scene, const geometry::PoseTrajectory& script_X_WH, std::int64_t ticks);

struct RunSettings {
  std::int64_t device = devices::kDefaultDevice;  ///< number of the glove
  double seconds = 0.0;                           ///< after the first state of the glove; 0: no limit
  /// Of the haptic loop; default: that of the glove, within the bounds of `validate_tick_period`.
  std::optional<std::chrono::nanoseconds> period{};
};

/// Runs the haptic server in real time with a glove on `bus`, until its time is over or `should_stop` returns true.
/// Calls `watch` ten times a second with the number of ticks so far and the news of `ReasonTeller`. Publishes
/// HAPTIC_STATE on the bus. Throws std::invalid_argument, naming scene and part, when the part collides at its start.
Session run_session(const HapticScene& scene, const std::shared_ptr<devices::LcmBus>& bus, const RunSettings& settings,
                    const std::function<bool()>& should_stop,
                    const std::function<void(std::int64_t, const std::string& news)>& watch);

}  // namespace glissade::apps
