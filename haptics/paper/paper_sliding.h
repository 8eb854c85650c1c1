#pragma once

/// Sliding contact as the founding paper tells it (§3): bisect to the contact, classify it, go on in a new direction.
/// For comparison; `sliding.h` is the method to use. What this one cannot do, and why, is in docs/sliding.md.
///
/// The collision object (`collision_object.h`) is put where the metaphor wants the part. Where it collides, the path to
/// there, straight and evenly turning, is halved by static exact checks until the first contact on it is known to a
/// fraction of a micrometre. The visible object is put at the free end of that bracket, so it stays a small distance
/// before the contact, and never at a colliding pose. The polygons that touch at the other end are classified
/// (`paper_classification.h`), the contacts turn what is left of the motion (`paper_direction.h`), and the collision
/// object goes that way, until a stopping criterion ends it: a finite state machine (`paper_states.h`).
///
/// Only poses are checked, not the paths between them: a thin sheet can be passed. Contacts hold while the part stays
/// within some brackets of them, but for one call at most.

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/haptics/sliding_rules.h>
#include <glissade/haptics/sliding_simulation.h>

#include "paper/collision_object.h"
#include "paper/paper_classification.h"
#include "paper/paper_direction.h"
#include "paper/paper_states.h"

namespace glissade::haptics {

struct PaperSlidingOptions {
  Metaphor metaphor = Metaphor::kForceFeedback;
  /// By default that of `default_stiffness`.
  std::optional<CouplingStiffness> stiffness{};
  /// Metres that any point of the part moves at most between the two ends of a bisection.
  double bracket = 0.5e-6;
  /// Bisections in one call.
  int max_cycles = 20;
};

/// The simulation of one part among fixed obstacles. Deterministic: the same calls give the same bits.
/// Not thread-safe; several simulations may share bodies.
class PaperSliding final : public SlidingSimulation {
 public:
  /// The margins of obstacles are of no concern here. Throws std::invalid_argument when there is no obstacle, when the
  /// part collides with one at X_WV_start, and for a bracket that is not positive.
  PaperSliding(std::vector<Obstacle> obstacles, std::shared_ptr<const SlidingPart> part_V,
               const Eigen::Isometry3d& X_WV_start, const PaperSlidingOptions& options = {});

  void grasp(const Eigen::Isometry3d& X_WG) override;
  void release() override;
  /// The result's contacts are those that hold the part at the end; the force of each is its share of the coupling's
  /// spring: the part of K ξ* along contact normals that the projection of `projection.h` on their tangent planes takes
  /// away. Where the part is jammed short of its optimum, as this method may be, the shares do not add up to K ξ*.
  /// Contacts that are unclear are told as those of two vertices without numbers.
  const SlidingResult& advance(const Eigen::Isometry3d& X_WG, double milliseconds = 1.0) override;

  const SlidingResult& result() const override { return result_; }
  const SlidingPart& part() const override { return collision_object_.part(); }
  const CouplingStiffness& stiffness() const override { return stiffness_; }
  double margin() const override { return kHeldWithin * bracket_; }
  std::string trace() const override;

  /// The states of the last call, in the order they were in, `done` last; none before the first call and while
  /// released.
  std::span<const PaperState> states() const { return states_; }
  /// Checks for collision since construction.
  std::int64_t queries() const { return collision_object_.queries(); }
  double bracket() const { return bracket_; }

  /// Brackets that the part may be from a contact that holds it.
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
  std::span<const ConstraintRow> contact_rows(double room);
  void tell_contacts();
  SlidingState summary() const;
  double held_within() const { return kHeldWithin * bracket_; }
  void let_rest(SlidingState state);

  CollisionObject collision_object_;
  CouplingStiffness stiffness_;
  Metaphor metaphor_;
  double bracket_;
  int max_cycles_;

  SlidingResult result_;
  std::vector<PaperState> states_;
  std::vector<PaperContact> contacts_;
  std::vector<PaperContact> found_;
  std::vector<TouchingPair> touching_;
  std::vector<ConstraintRow> rows_;
  std::vector<Eigen::Vector3d> normals_;
  ProjectionSolver solver_;

  // Of this call.
  Eigen::Isometry3d X_WG_previous_ = Eigen::Isometry3d::Identity();
  double budget_ = 0.0;  // metres that the metaphor lets the part move yet
  double moved_ = 0.0;   // metres
  // Of this cycle, from one bisection to the next.
  geometry::Displacement attempt_;                          // that collided
  Eigen::Isometry3d X_WC_ = Eigen::Isometry3d::Identity();  // the colliding end of the bracket
  geometry::Displacement direction_;                        // the new one
  double moved_in_cycle_ = 0.0;                             // metres
  bool found_contact_ = false;                              // that was not known
  int stalled_cycles_ = 0;                                  // in a row, without any of both
};

}  // namespace glissade::haptics
