#pragma once

/// The check of a run afterwards, independent of the DOP-trees: does any pose that was shown collide?

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <glissade/apps/run/session_recorder.h>
#include <glissade/apps/scene/haptic_scene.h>
#include <glissade/grasping/hand_model.h>
#include <glissade/reference/grid_check.h>

namespace glissade::apps {

/// Checks the visible poses of parts and hands in the kept ticks by brute force, with progress bars. A body at rest
/// repeats its pose, which is checked once. All arguments must outlive the object.
class SessionCheck {
 public:
  SessionCheck(const SessionRecorder& samples, const HapticScene& scene);

  /// The number of ticks in which the part collides with an obstacle or with a part of lower number.
  std::int64_t colliding_ticks_of_part(std::size_t part) const;
  /// The number of ticks in which a segment of the hand, made like `model`, collides with an obstacle or a part. Hands
  /// that wait, or are lost and hold nothing, are in nobody's way, and count as free.
  std::int64_t colliding_ticks_of_hand(std::size_t hand, const grasping::HandModel& model) const;

 private:
  template <typename PoseAt>
  void check(const reference::GridCheck& obstacles, const geometry::TriangleMesh& mesh, const std::vector<char>& counts,
             const PoseAt& pose_at, std::vector<char>& collides) const;

  const SessionRecorder& samples_;
  reference::GridCheck obstacles_;
  std::vector<std::shared_ptr<const geometry::TriangleMesh>> meshes_;  // of the parts
  std::vector<reference::GridCheck> parts_;                            // each at its own origin
};

}  // namespace glissade::apps
