#pragma once

/// What came of a run of `glissade grasp`, in a few rows.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <glissade/apps/run/missed_grasp.h>
#include <glissade/apps/scene/haptic_scene.h>
#include <glissade/grasping/grasp_simulation.h>
#include <glissade/grasping/hand_model.h>

namespace glissade::apps {

/// Looks at a simulation, which must outlive it, millisecond by millisecond.
class GraspOutcome {
 public:
  GraspOutcome(const HapticScene& scene, const grasping::GraspSimulation& simulation,
               std::vector<std::shared_ptr<const grasping::HandModel>> hands);

  /// A tick at `time_s` on the clock of the trajectories, with the targets of the hands in it.
  void add(double time_s, const std::vector<std::optional<grasping::Posture>>& targets);

  /// Name, and value with unit: how long each hand held which parts, or why it held none, and how far each part came.
  std::vector<std::pair<std::string, std::string>> rows() const;
  /// How long this hand waits, and for what, as "waits for 0.300 s, first at 0.000 s: ..."; empty if it never does.
  std::string waiting(std::size_t hand) const;

 private:
  struct Hand {
    std::int64_t grasps = 0;
    std::int64_t holding_ms = 0;
    std::int64_t waiting_ms = 0;
    std::string waits_first;  // when and for what
    std::int32_t part = -1;
    MissedGrasp missed;
  };

  const HapticScene& scene_;
  const grasping::GraspSimulation& simulation_;
  std::vector<std::shared_ptr<const grasping::HandModel>> models_;
  std::int64_t ticks_ = 0;
  std::vector<Hand> hands_;
};

}  // namespace glissade::apps
