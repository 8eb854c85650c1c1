#pragma once

/// Hands that grasp, carry, push and let go of parts (paper §4): the clasp and the analysis of each hand, and sliding
/// contact for the parts that hands hold.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/contact/contact_body.h>
#include <glissade/contact/multi_part_sliding.h>
#include <glissade/contact/sliding_rules.h>
#include <glissade/devices/haptic_state.h>
#include <glissade/grasping/clasp.h>
#include <glissade/grasping/grasp_analysis.h>
#include <glissade/grasping/hand_model.h>
#include <glissade/haptics/haptic_kernel.h>
#include <glissade/haptics/loop_simulation.h>

namespace glissade::grasping {

/// The work that a hand may do in a call, beside sliding contact with these rules: a sixteenth of its budget.
constexpr std::optional<std::int64_t> work_of_hand(const contact::SlidingRules& rules) {
  if (!rules.work_budget) return std::nullopt;
  return *rules.work_budget < 16 ? 1 : *rules.work_budget / 16;
}

struct GraspRules {
  ClaspRules clasp{};  ///< without a budget of work: `work_of_hand(sliding)`
  contact::SlidingRules sliding{};
  Eigen::Vector3d up_W = Eigen::Vector3d::UnitZ();  ///< of unit length, against gravity
};

/// What the haptic loop needs to know of a hand (`haptics::KernelHand::fingers`).
haptics::FingerHand finger_hand(const HandModel& hand);

/// Loose parts stand still where they were left; nothing falls. Deterministic. Not thread-safe.
///
/// A hand takes hold of a part when the contacts of its segments say so (`GraspAnalysis`). From then on its palm and
/// the part are one rigid body, which follows the tracked palm by sliding contact: the hand stays clasped round the
/// visible part, wherever the tracked hand goes, and segments of the hand stop the part as its own faces do. The
/// fingers still follow the glove; when they open, the hand lets go, and takes hold of the same part again after 0.2 s
/// at the earliest. A part in two hands follows the mean of their wishes. A hand that touches a loose part without a
/// grasp pushes it. It yields by the shortest way on which the target of the hand lies no deeper than 1 mm in it, as
/// far as obstacles let it, and at most half again as fast as the fastest segment that pushes it (beside the gap of
/// contacts, up to 20 µm a call).
///
/// In the haptic loop (`haptics::HapticServer`), the haptic thread has the ghosts of parts in hands, and this
/// simulation decides who takes hold. A decision takes effect once the haptic thread has followed it. Then a part is
/// where the tracked palm, not the visible one, would have it: nothing moves when a hand takes hold.
class GraspSimulation final : public haptics::LoopSimulation {
 public:
  /// Parts are loose at the start, unless scripts lead them; scripted parts cannot be held. Throws
  /// std::invalid_argument as `contact::MultiPartSliding` and `Clasp` do, for a hand that is null, for more than
  /// `haptics::kMaxHands`, and for an `up_W` that is no unit vector (to 1e-6).
  GraspSimulation(const std::vector<contact::Obstacle>& fixed, const std::vector<contact::HeldPart>& parts,
                  const std::vector<std::shared_ptr<const HandModel>>& hands, const GraspRules& rules = {});
  GraspSimulation(GraspSimulation&&) noexcept;
  GraspSimulation& operator=(GraspSimulation&&) noexcept;
  ~GraspSimulation() override;

  /// One target for each hand: the tracked posture, or none while the tracking is lost. `milliseconds` have passed
  /// since the last call.
  void advance(std::span<const std::optional<Posture>> targets, double milliseconds = 1.0);

  /// The user's cart carries the hand to this posture, whatever is in the way. The hand lets go of what it holds, and
  /// waits until a target is free. Its posture stays as it was if this one is not finite or has other values than the
  /// hand. Not in the haptic loop, which has no cart.
  void move_cart(std::size_t hand, const Posture& posture);

  std::size_t hand_count() const;
  std::size_t part_count() const;

  // Of the hand with this number:
  devices::HandActivity activity(std::size_t hand) const;
  /// The visible hand. While it is free or holds a part, it touches nothing, nor did it on its way. A hand that waits,
  /// or is lost while it holds nothing, stays as it was, and is in nobody's way.
  const Posture& posture(std::size_t hand) const;
  const Clasp& clasp(std::size_t hand) const;
  /// `Grasp::object` numbers the fixed bodies first, then the parts.
  const Grasp& grasp(std::size_t hand) const;
  /// The part that moves with the hand.
  std::optional<std::size_t> held_part(std::size_t hand) const;

  /// Poses, lag and contacts of the parts.
  const contact::MultiPartSliding& parts() const override;

  // In the haptic loop: in one only, and not together with the other `advance`.
  void take_part(std::size_t part, const Eigen::Isometry3d& X_WG) override;
  void leave_part(std::size_t part) override;
  void advance(const haptics::Ghosts& ghosts, double milliseconds) override;
  void tell_hands(haptics::ContactSet& set) const override;

 private:
  class Life;
  std::unique_ptr<Life> life_;
};

}  // namespace glissade::grasping
