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
#include <glissade/grasping/clasp.h>
#include <glissade/grasping/grasp_analysis.h>
#include <glissade/grasping/hand_model.h>
#include <glissade/hands/hand.h>

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

/// Where a hand with fingers is to go, and what is attached to its palm, where someone else decides that. The part
/// follows a ghost of its own, once that one has taken hold of it (`GraspSimulation::take_part`).
struct HandTarget {
  std::optional<Posture> posture{};   ///< tracked; none while the tracking is lost
  std::optional<std::size_t> part{};  ///< number of the part in the hand
};

/// The part that the simulation wants a hand to hold. The decider, such as a haptic thread, follows it.
struct HoldDecision {
  std::optional<std::size_t> part{};
  std::int64_t number = 0;  ///< increases whenever the simulation decides on another part
};

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
/// Without hands, the caller leads the parts, and holds them from the start. The results are those of
/// `contact::MultiPartSliding`, to the bit.
///
/// Someone else may decide what is held, such as the haptic thread of a server, which has the ghosts of parts in hands:
/// the second `advance`. A `decision` takes effect once that one has followed it. Then a part is where the tracked
/// palm, not the visible one, would have it: nothing moves when a hand takes hold.
class GraspSimulation {
 public:
  /// Among hands, parts are loose at the start, unless scripts lead them; scripted parts cannot be held. Throws
  /// std::invalid_argument as `contact::MultiPartSliding` and `Clasp` do, for a hand that is null, for more than
  /// `hands::kMaxHands`, and for an `up_W` that is no unit vector (to 1e-6).
  GraspSimulation(const std::vector<contact::Obstacle>& fixed, const std::vector<contact::HeldPart>& parts,
                  const std::vector<std::shared_ptr<const HandModel>>& hands = {}, const GraspRules& rules = {});
  GraspSimulation(GraspSimulation&&) noexcept;
  GraspSimulation& operator=(GraspSimulation&&) noexcept;
  ~GraspSimulation();

  /// One target for each hand: the tracked posture, or none while the tracking is lost. `milliseconds` have passed
  /// since the last call.
  void advance(std::span<const std::optional<Posture>> targets, double milliseconds = 1.0);

  /// The same where someone else decides what is held: a pose X_WG for each part, which counts from `take_part` to
  /// `leave_part`, and a target for each hand. Hands push the other parts. Not together with the other `advance`.
  void advance(std::span<const Eigen::Isometry3d> X_WG, std::span<const HandTarget> targets, double milliseconds);
  /// Someone takes hold of the part, or anew, with its ghost at X_WG; the last one lets go of it. As
  /// `contact::MultiPartSliding::grasp` and `contact::MultiPartSliding::release`; the compliance point is where the
  /// hands that are to hold it touch it, unless it was chosen.
  void take_part(std::size_t part, const Eigen::Isometry3d& X_WG);
  void leave_part(std::size_t part);
  /// Whether someone has taken hold of the part and not let go; without hands, also at the start.
  bool is_led(std::size_t part) const;

  /// The user's cart carries the hand to this posture, whatever is in the way. The hand lets go of what it holds, and
  /// waits until a target is free. Its posture stays as it was if this one is not finite or has other values than the
  /// hand.
  void move_cart(std::size_t hand, const Posture& posture);

  std::size_t hand_count() const;
  std::size_t part_count() const;

  // Of the hand with this number:
  const std::shared_ptr<const HandModel>& model(std::size_t hand) const;
  hands::HandActivity activity(std::size_t hand) const;
  /// The visible hand. While it is free or holds a part, it touches nothing, nor did it on its way. A hand that waits,
  /// or is lost while it holds nothing, stays as it was, and is in nobody's way.
  const Posture& posture(std::size_t hand) const;
  const Clasp& clasp(std::size_t hand) const;
  /// The contacts of the clasp, and those with a held part from which noise has taken a segment by millimetres.
  std::span<const LinkContact> contacts(std::size_t hand) const;
  /// Activity, grasp and posture.
  hands::VisibleHand visible(std::size_t hand) const;
  /// `Grasp::object` numbers the fixed bodies first, then the parts.
  const Grasp& grasp(std::size_t hand) const;
  /// The part that moves with the hand.
  std::optional<std::size_t> held_part(std::size_t hand) const;
  const HoldDecision& decision(std::size_t hand) const;

  /// Poses, lag and contacts of the parts.
  const contact::MultiPartSliding& parts() const;

 private:
  class Life;
  std::unique_ptr<Life> life_;
};

}  // namespace glissade::grasping
