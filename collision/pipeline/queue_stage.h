#pragma once

/// Stage 0 of the pipeline: applies the changes of the world since the last frame to its objects.

#include <cstdint>
#include <span>
#include <vector>

#include <glissade/collision/frame_result.h>
#include <glissade/collision/world.h>

#include "pipeline/broad_phase.h"
#include "pipeline/placed_objects.h"

namespace glissade::collision {

class QueueStage {
 public:
  QueueStage(World& world, PlacedObjects& placed, BroadPhase& broad_phase)
      : world_(world), placed_(placed), broad_phase_(broad_phase) {}

  /// Takes the changes, and gives new boxes in the broad phase to the objects that have left their old ones.
  void take_changes(StageReport& report);

  /// Slots of the objects that are new or have moved.
  std::span<const std::uint32_t> changed() const { return changed_; }

  /// Whether pairs may have been enabled or disabled.
  bool interest_changed() const { return interest_changed_; }

  /// Number of objects in the world.
  std::int64_t objects() const { return objects_; }

 private:
  void set_box(std::uint32_t slot, const Eigen::Vector3d& step);

  World& world_;
  PlacedObjects& placed_;
  BroadPhase& broad_phase_;
  std::int64_t objects_ = 0;
  bool interest_changed_ = false;
  std::vector<std::uint32_t> changed_;
};

}  // namespace glissade::collision
