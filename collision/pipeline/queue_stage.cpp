#include "pipeline/queue_stage.h"

#include <algorithm>
#include <iterator>

#include "pipeline/world_box.h"

namespace glissade::collision {

void QueueStage::take_changes(StageReport& report) {
  const WorldChanges& changes = world_.take_changes();
  for (const std::uint32_t slot : changes.removed)
    broad_phase_.remove(slot);
  for (const std::uint32_t slot : changes.added) {
    placed_.place(slot, world_.objects()[slot]);
    set_box(slot, Eigen::Vector3d::Zero());
  }
  for (const std::uint32_t slot : changes.moved) {
    const Eigen::Vector3d step = placed_.move(slot, world_.objects()[slot]);
    if (!placed_.has_room(slot)) set_box(slot, step);
  }
  objects_ += std::ssize(changes.added) - std::ssize(changes.removed);
  interest_changed_ = changes.interest;
  changed_.clear();
  std::merge(changes.added.begin(), changes.added.end(), changes.moved.begin(), changes.moved.end(),
             std::back_inserter(changed_));
  report.in = std::ssize(changed_) + std::ssize(changes.removed);
  report.out = std::ssize(changed_);
}

void QueueStage::set_box(std::uint32_t slot, const Eigen::Vector3d& step) {
  const WorldObject& object = world_.objects()[slot];
  placed_.give_room(slot, broad_phase_.set(slot, world_box(*object.tree, object.X_WO), step));
}

}  // namespace glissade::collision
