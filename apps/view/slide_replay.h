#pragma once

/// The replay of a report of `glissade slide`.

#include <chrono>
#include <cstdint>

#include <glissade/apps/scene/haptic_scene.h>
#include <glissade/apps/view/replay_maker.h>
#include <glissade/haptics/sliding_simulation.h>

namespace glissade::apps {

/// Looks at the simulation of the scene's first part, which one hand leads, millisecond by millisecond.
class SlideReplay {
 public:
  explicit SlideReplay(const HapticScene& scene);

  void add(std::chrono::nanoseconds time, const haptics::SlidingSimulation& sliding);
  Replay finish();

 private:
  ReplayMaker maker_;
  haptics::ContactPatches patches_;
  std::int64_t ticks_ = 0;
};

}  // namespace glissade::apps
