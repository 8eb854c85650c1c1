#pragma once

/// Runs of the haptic loop for the commands `demo` and `run`.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glissade/apps/record/run_recorders.h>
#include <glissade/apps/run/session.h>
#include <glissade/apps/scene/haptic_scene.h>
#include <glissade/apps/scene/sliding_option.h>
#include <glissade/devices/lcm_bus.h>
#include <glissade/devices/lcm_glove.h>
#include <glissade/devices/simulated_glove.h>
#include <glissade/grasping/hand_model.h>
#include <glissade/haptics/coupling.h>

namespace glissade::apps {

/// Runs the whole system on a simulated clock: `ticks` milliseconds of a simulated glove. If it has fingers in the
/// simulation, a right hand takes hold with them; otherwise it holds the first part if it starts closed. Throws
/// std::invalid_argument, naming scene and part, when a part collides at its start, and naming the file when the
/// recording cannot be created. There is no flight recorder.
Session run_session_offline(const HapticScene& scene, devices::SimulatedGlove glove, bool has_fingers,
                            std::int64_t ticks, const SlidingChoice& choice, const RecordSettings& record);

/// A glove of a run, and the part that its hand takes at the first state; or a hand with fingers, which takes hold of
/// what it touches.
struct SessionHand {
  std::int64_t device = devices::kDefaultDevice;  ///< number of the glove
  std::optional<std::size_t> part = 0;            ///< number of the part in the scene; none for a hand with fingers
  std::optional<grasping::HandShape> fingers{};   ///< the side is that of the glove, if the glove tells it
};

struct RunSettings {
  std::vector<SessionHand> hands{SessionHand{}};
  SlidingChoice choice{};
  double seconds = 0.0;  ///< after the first state of any glove; 0: no limit
  /// With a limit: the run may take so much longer, until it is told to stop.
  double longer_s = 0.0;
  /// Of the haptic loop; default: that of the fastest glove, within the bounds of `validate_tick_period`.
  std::optional<std::chrono::nanoseconds> period{};
  std::chrono::nanoseconds spin{0};  ///< as `haptics::HapticServerOptions::spin`
  RecordSettings record{};
  std::optional<std::uint16_t> view_port{};  ///< for browsers that look on; 0: any; none: nobody does
  bool waits_for_page = false;               ///< with a port: the run starts when the first page looks on
};

/// What a run tells ten times a second.
struct RunNews {
  std::int64_t ticks = 0;                      ///< so far
  std::optional<std::int64_t> awaited_device;  ///< before the first tick: the glove that has not been heard yet
  std::vector<std::string> sentences;          ///< events of `RunWatch`, and warnings
  std::string status;                          ///< of `RunWatch`; empty before the first tick and after the end
};

/// Runs the haptic server in real time with gloves on `bus`, until its time is over or `should_stop` returns true.
/// Waits for all gloves first. Publishes HAPTIC_STATE on the bus. Throws std::invalid_argument, naming scene and part,
/// when a part collides at its start, naming --spin-us when the spin is longer than half of the loop's period, and
/// naming a file that cannot be created.
Session run_session(const HapticScene& scene, const std::shared_ptr<devices::LcmBus>& bus, const RunSettings& settings,
                    const std::function<bool()>& should_stop, const std::function<void(const RunNews&)>& watch);

}  // namespace glissade::apps
