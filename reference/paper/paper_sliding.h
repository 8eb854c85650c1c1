#pragma once

/// Sliding contact as the founding paper describes it (§3): bisect to the contact, classify it, continue in a new
/// direction. For comparison; `sliding.h` is the method to use. The limits of this one, and their reasons, are in
/// docs/sliding.md.
///
/// The collision object (`collision_object.h`) is placed where the metaphor wants the part. If it collides there, the
/// path to that pose, straight and turning evenly, is bisected with static exact checks until a contact on it is known
/// to a fraction of a micrometre. The visible object is placed at the free end of that bracket, so it stays a small
/// distance before the contact and never at a colliding pose. The polygons that touch at the other end are classified
/// (`paper_classification.h`), the contacts deflect the remaining motion (`paper_direction.h`), and the collision
/// object continues in that direction until a stopping criterion ends the call. A finite state machine runs these steps
/// (`paper_states.h`).
///
/// Only poses are checked, not the paths between them: the part can pass through a thin sheet. A contact holds while
/// the part stays within kHeldWithin brackets of it, and no longer than one call.

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/contact/sliding_rules.h>
#include <glissade/contact/spring.h>
#include <glissade/reference/sliding_method.h>

#include "paper/collision_object.h"
#include "paper/paper_classification.h"
#include "paper/paper_direction.h"
#include "paper/paper_states.h"

namespace glissade::reference {

struct PaperSlidingOptions {
  contact::Metaphor metaphor = contact::Metaphor::kForceFeedback;
  /// Default: `stiffness_of_part` of the part's radius.
  std::optional<contact::CouplingStiffness> stiffness{};
  /// Bound (metres) of the motion of any point of the part between the two ends of a finished bisection.
  double bracket = 0.5e-6;
  /// Bisections in one call, at most.
  int max_cycles = 20;
};

/// The simulation of one part among fixed obstacles. Deterministic: the same calls give the same bits.
/// Not thread-safe; several simulations may share bodies.
class PaperSliding final : public SlidingSimulation {
 public:
  /// Ignores the margins of obstacles. Throws std::invalid_argument when there is no obstacle, for null pointers, for
  /// poses that `geometry::rigid_pose` rejects, when the part collides with an obstacle at X_WV_start, and for a
  /// bracket of less than a nanometre.
  PaperSliding(std::vector<contact::Obstacle> obstacles, std::shared_ptr<const contact::SlidingPart> part_V,
               const Eigen::Isometry3d& X_WV_start, const PaperSlidingOptions& options = {});

  void grasp(const Eigen::Isometry3d& X_WG) override;
  void release() override;
  /// The contacts of the result are those that hold the part at the end. The force of each is its share of the
  /// coupling's spring: its multiplier in the projection (`projection.h`) of ξ* on all tangent planes. Where this
  /// method jams the part short of its optimum, the shares do not add up to K ξ*. Unclear contacts are reported as
  /// vertex/vertex without feature numbers.
  const contact::SlidingResult& advance(const Eigen::Isometry3d& X_WG, double milliseconds = 1.0) override;

  const contact::SlidingResult& result() const override { return result_; }
  const contact::SlidingPart& part() const override { return collision_object_.part(); }
  const contact::CouplingStiffness& stiffness() const override { return stiffness_; }
  double margin() const override { return kHeldWithin * bracket_; }
  std::string trace() const override;

  /// The states of the last call in their order, `done` last; empty before the first call and while the part is
  /// released.
  std::span<const PaperState> states() const { return states_; }
  std::int64_t queries() const override { return collision_object_.queries(); }
  double bracket() const { return bracket_; }

  /// Largest distance, in brackets, between a part and a contact that holds it.
  static constexpr double kHeldWithin = 4.0;

 private:
  PaperEvent work(PaperState state);
  PaperEvent go(const geometry::Displacement& displacement);
  PaperEvent bisect();
  PaperEvent classify();
  PaperEvent choose_direction();
  PaperEvent evaluate_criterion();

  void place_visible(const Eigen::Isometry3d& X_WV, double length);
  void want();
  std::span<const contact::ConstraintRow> contact_rows(double room);
  void report_contacts();
  contact::SlidingState summary() const;
  double held_within() const { return kHeldWithin * bracket_; }
  void let_rest(contact::SlidingState state);

  CollisionObject collision_object_;
  contact::CouplingStiffness stiffness_;
  contact::Metaphor metaphor_;
  double bracket_;
  int max_cycles_;

  contact::SlidingResult result_;
  std::vector<PaperState> states_;
  std::vector<PaperContact> contacts_;
  std::vector<PaperContact> found_;
  std::vector<TouchingPair> touching_;
  std::vector<contact::ConstraintRow> rows_;
  std::vector<Eigen::Vector3d> normals_;
  contact::ProjectionSolver solver_;

  // Of this call.
  Eigen::Isometry3d X_WG_previous_ = Eigen::Isometry3d::Identity();
  double budget_ = 0.0;  // metres that the metaphor still allows
  double moved_ = 0.0;   // metres
  // Of this cycle, from one bisection to the next.
  geometry::Displacement attempt_;                          // the displacement that collided
  Eigen::Isometry3d X_WC_ = Eigen::Isometry3d::Identity();  // the colliding end of the bracket
  geometry::Displacement direction_;                        // the new displacement
  double moved_in_cycle_ = 0.0;                             // metres
  bool found_contact_ = false;                              // a new one
  int stalled_cycles_ = 0;                                  // in a row, without motion or new contact
};

}  // namespace glissade::reference
