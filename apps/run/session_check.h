#pragma once

/// The check of a run afterwards, independent of the DOP-trees: does any pose that was shown collide?

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include <glissade/apps/run/session_recorder.h>
#include <glissade/apps/scene/haptic_scene.h>
#include <glissade/grasping/hand_model.h>
#include <glissade/reference/grid_check.h>

namespace glissade::apps {

using HandModels = std::vector<std::shared_ptr<const grasping::HandModel>>;

/// Checks the visible poses of parts and hands in the kept ticks by brute force, with a progress bar. A body at rest
/// repeats its pose, which is checked once in each of 64 strides over the run.
class SessionCheck {
 public:
  /// `hands` are the models of the hands, null for one without fingers in the simulation. The check ends early
  /// when `should_end` says so; what it has checked by then is spread over the whole run.
  SessionCheck(const SessionRecorder& samples, const HapticScene& scene, const HandModels& hands,
               const std::function<bool()>& should_end = {});

  /// The number of ticks that were checked: all, unless the check ended early.
  std::int64_t checked_ticks() const { return checked_ticks_; }
  /// Of these, the ticks in which the part collides with an obstacle or with a part of lower number.
  std::int64_t colliding_ticks_of_part(std::size_t part) const { return colliding_of_parts_[part]; }
  /// Of these, the ticks in which a segment of the hand collides with an obstacle or a part. Hands that wait, or are
  /// lost and hold nothing, are in nobody's way, and count as free.
  std::int64_t colliding_ticks_of_hand(std::size_t hand) const { return colliding_of_hands_[hand]; }

 private:
  using Mask = std::vector<char>;  // of ticks

  void check_part(std::size_t part, const Mask& chosen);
  void check_hand(std::size_t hand, const grasping::HandModel& model, const Mask& chosen);
  template <typename PoseAt>
  void check(const reference::GridCheck& obstacles, const geometry::TriangleMesh& mesh, const Mask& counts,
             const PoseAt& pose_at, Mask& collides) const;

  const SessionRecorder& samples_;
  reference::GridCheck obstacles_;
  std::vector<std::shared_ptr<const geometry::TriangleMesh>> meshes_;  // of the parts
  std::vector<reference::GridCheck> parts_;                            // each at its own origin
  std::int64_t checked_ticks_ = 0;
  std::vector<std::int64_t> colliding_of_parts_;
  std::vector<std::int64_t> colliding_of_hands_;
};

}  // namespace glissade::apps
