#pragma once

/// Simulates hands that grasp, carry, push and release parts (paper §4). The simulation combines the clasp and the
/// grasp analysis of each hand with sliding contact for the held parts.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/base/export.h>
#include <glissade/contact/contact_body.h>
#include <glissade/contact/multi_part_sliding.h>
#include <glissade/contact/sliding_rules.h>
#include <glissade/grasping/clasp.h>
#include <glissade/grasping/grasp_analysis.h>
#include <glissade/grasping/hand_model.h>
#include <glissade/hands/hand.h>

namespace glissade::grasping {

/// The work budget of a hand in a call, i.e. a sixteenth of the budget of sliding contact with these rules.
constexpr std::optional<std::int64_t> work_of_hand(const contact::SlidingRules& rules) {
  if (!rules.work_budget) return std::nullopt;
  return *rules.work_budget < 16 ? 1 : *rules.work_budget / 16;
}

struct GraspRules {
  ClaspRules clasp{};  ///< the default work budget is `work_of_hand(sliding)`
  contact::SlidingRules sliding{};
  Eigen::Vector3d up_W = Eigen::Vector3d::UnitZ();  ///< of unit length, against gravity
};

/// The target of a hand with fingers. If the caller sets the holds, i.e. decides which hand holds which part, the
/// target also has the part in the hand. After `GraspSimulation::take_part`, this part follows its own ghost.
struct HandTarget {
  std::optional<Posture> posture{};   ///< the tracked posture; none while the tracking is lost
  std::optional<std::size_t> part{};  ///< number of the part in the hand
};

/// The decision of the simulation on the part that a hand should hold. If the caller sets the holds, as a haptic thread
/// does, the caller must follow this decision.
struct HoldDecision {
  std::optional<std::size_t> part{};
  std::int64_t number = 0;  ///< increases whenever the simulation decides on another part
};

/// Loose parts stand still where a hand left them. Nothing falls. Deterministic. Not thread-safe.
///
/// A hand takes hold of a part when `GraspAnalysis` finds a grasp. From then on the palm and the part are one rigid
/// body, which follows the tracked palm by sliding contact. The hand stays clasped round the visible part, wherever the
/// tracked hand goes. An obstacle that stops a segment of the hand also stops the part, like an obstacle at a face of
/// the part. The fingers still follow the glove. When the fingers open, the hand lets go. It takes hold of the same
/// part again after 0.2 s at the earliest. A part in two hands follows the mean of the targets of these hands. A hand
/// that touches a loose part without a grasp pushes the part. The part then moves, as far as obstacles allow, by the
/// shortest displacement after which the hand's target is at most 1 mm deep in the part. The speed of the part is at
/// most 1.5 times the speed of the fastest pushing segment (plus the gap of contacts, up to 20 µm a call).
///
/// Without hands, the caller leads the parts, which are held from the start. The results are then bit-identical to
/// those of `contact::MultiPartSliding`.
///
/// With the second `advance`, the caller sets the holds and supplies the ghosts of held parts, as the haptic thread of
/// a server does. A `decision` takes effect once the caller has set the hold. The part's target is then relative to the
/// tracked palm, not to the visible palm, so nothing moves when a hand takes hold.
class GLISSADE_EXPORT GraspSimulation {
 public:
  /// With hands, parts are loose at the start, unless scripts lead them. Scripted parts cannot be held. Throws
  /// std::invalid_argument for a null hand, for more than `hands::kMaxHands` hands, and for an `up_W` that is no unit
  /// vector (to 1e-6). Also throws what `contact::MultiPartSliding` and `Clasp` throw.
  GraspSimulation(const std::vector<contact::Obstacle>& fixed, const std::vector<contact::HeldPart>& parts,
                  const std::vector<std::shared_ptr<const HandModel>>& hands = {}, const GraspRules& rules = {});
  GraspSimulation(GraspSimulation&&) noexcept;
  GraspSimulation& operator=(GraspSimulation&&) noexcept;
  ~GraspSimulation();

  /// Advances the simulation. `targets` has the tracked posture of each hand, or none while the tracking of the hand is
  /// lost. `milliseconds` is the time since the last call.
  void advance(std::span<const std::optional<Posture>> targets, double milliseconds = 1.0);

  /// Advances the simulation if the caller sets the holds. X_WG has a ghost pose for each part, which is used from
  /// `take_part` to `leave_part`. `targets` has a target for each hand. Hands push parts that are not held. Call only
  /// one of the two `advance` functions of a simulation.
  void advance(std::span<const Eigen::Isometry3d> X_WG, std::span<const HandTarget> targets, double milliseconds);
  /// `take_part` begins a hold of the part, or begins a hold anew, with the ghost at X_WG. `leave_part` ends the hold.
  /// Both work like `contact::MultiPartSliding::grasp` and `contact::MultiPartSliding::release`. Unless the part has a
  /// chosen compliance point, this point is the mean of the contact points of the holding hands.
  void take_part(std::size_t part, const Eigen::Isometry3d& X_WG);
  void leave_part(std::size_t part);
  /// Whether the part is held. Without hands, parts are held from the start.
  bool is_led(std::size_t part) const;

  /// The user's cart (`Clasp::move_cart`) carries the hand to this posture, even through obstacles. The hand lets go of
  /// its part, and waits until a target is free. If `posture` is not finite or has a wrong number of values, the hand's
  /// posture stays the same.
  void move_cart(std::size_t hand, const Posture& posture);

  std::size_t hand_count() const;
  std::size_t part_count() const;

  // Of the hand with this number:
  const std::shared_ptr<const HandModel>& model(std::size_t hand) const;
  hands::HandActivity activity(std::size_t hand) const;
  /// The visible hand. While the hand is free or holds a part, its posture and its path are collision-free. While the
  /// hand waits, or is lost and holds nothing, it keeps its posture and is no obstacle.
  const Posture& posture(std::size_t hand) const;
  const Clasp& clasp(std::size_t hand) const;
  /// The contacts of the clasp, and contacts of segments that noise has moved away from the held part by millimetres.
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
