#pragma once

/// What came of a run of `glissade grasp`, in a few rows.

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <glissade/apps/scene/haptic_scene.h>
#include <glissade/grasping/grasp_simulation.h>

namespace glissade::apps {

/// Looks at a simulation, which must outlive it, millisecond by millisecond.
class GraspOutcome {
 public:
  GraspOutcome(const HapticScene& scene, const grasping::GraspSimulation& simulation);

  void add();

  /// Name, and value with unit: how long each hand held which parts, and how far each part came.
  std::vector<std::pair<std::string, std::string>> rows() const;

 private:
  struct Hand {
    std::int64_t grasps = 0;
    std::int64_t holding_ms = 0;
    std::int64_t waiting_ms = 0;
    std::int32_t part = -1;
  };

  const HapticScene& scene_;
  const grasping::GraspSimulation& simulation_;
  std::int64_t ticks_ = 0;
  std::vector<Hand> hands_;
};

}  // namespace glissade::apps
