#pragma once

/// Sliding contact of several parts at once (§3 of the founding paper, *Natural Interaction in Virtual Environments*).
/// A hand or a script (poses given over time) holds each part. The ghost of a part is the pose that the part would have
/// if nothing were in the way. Each visible part follows its ghost as closely as the obstacles and the other parts
/// allow. A part that touches no other body at the start never penetrates another body, at rest or in motion. If a part
/// touches or overlaps a body at the start, the part gets hardly any deeper into this body (see `OverlapRule`).
///
/// The method is sequential projection with a margin and a certificate. A call consists of cycles. Each cycle finds the
/// contacts whose gaps are below a limit, the reach. The cycle then projects the wanted displacements of the parts on
/// the displacements that these contacts allow, in the metric of the coupling stiffness. The result is a step. The
/// parts take the step only with a certificate, i.e. a proof that every triangle pair within reach stays apart on the
/// whole path.
///
/// The paper instead finds the instant of contact by bisection, and derives a new direction from the contact. At this
/// instant the gap is zero. An exact intersection test already reports a collision at gap zero, so no further motion is
/// possible. Therefore the contacts here stop parts at a positive gap, the margin.

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/base/export.h>
#include <glissade/contact/contact_body.h>
#include <glissade/contact/sliding_result.h>
#include <glissade/contact/sliding_rules.h>
#include <glissade/contact/spring.h>
#include <glissade/contact/statistics.h>
#include <glissade/geometry/displacement.h>

namespace glissade::contact {

class ContactScene;

/// The depth (metres) of the overlap of a part at X_BV with a body. The depth is the least distance by which all faces
/// of the part must move inwards until the part is free. The depth is 0 if part and body are apart or only touch. If no
/// distance frees the part, or if the part is an open surface, the result is the length of a translation that separates
/// part and body. Cost: some hundred collision queries.
GLISSADE_EXPORT double overlap_depth(const ContactBody& body, const SlidingPart& part_V, const Eigen::Isometry3d& X_BV);

/// The mesh of a part with all faces moved inwards by `depth` (metres); std::nullopt for an open surface. Triangles
/// keep their numbers.
GLISSADE_EXPORT std::optional<geometry::TriangleMesh> inset_mesh(const SlidingPart& part_V, double depth);

/// Whether a part at X_BV is wholly inside the closed surface of a body, without touching the surface.
GLISSADE_EXPORT bool is_enclosed(const ContactBody& body, const SlidingPart& part_V, const Eigen::Isometry3d& X_BV);

/// The simulation of up to kMaxParts parts among fixed obstacles and riders. Riders are bodies that obstruct parts or
/// move with a part, for example the segments of a hand. Deterministic: the same calls give bit-identical results. Not
/// thread-safe. However, several simulations may share bodies.
class GLISSADE_EXPORT MultiPartSliding {
 public:
  /// The riders of `chains` are absent until `place_riders`. Bodies whose distance is below the rounding error of their
  /// coordinates count as touching. Throws std::invalid_argument for:
  /// - no part, or more than kMaxParts parts
  /// - a single part without obstacles and riders
  /// - null pointers
  /// - poses and numbers out of range
  /// - parts so far from the origin (10⁷ m or more) that rounding exceeds the minimum clearance
  /// - overlaps at the start that `OverlapRule` refuses
  MultiPartSliding(std::vector<Obstacle> obstacles, const std::vector<HeldPart>& parts, const SlidingRules& rules = {},
                   const std::vector<RiderChain>& chains = {});
  MultiPartSliding(MultiPartSliding&&) noexcept;
  MultiPartSliding& operator=(MultiPartSliding&&) noexcept;
  ~MultiPartSliding();

  /// Like `Sliding::grasp` and `Sliding::release`, for the part with the number `part`, which must be below
  /// `part_count`. A released part stands still like an obstacle. Under force feedback, `grasp` does not move the
  /// target to the new ghost at once. If the part was released, the target starts at the pose of the part. If the part
  /// is already held, the target starts at its last pose. The target then approaches the ghost by 0.1 mm a millisecond
  /// (half of kSlew_m, `spring.h`), so neither part nor force jumps. The part must not be scripted.
  void grasp(std::size_t part, const Eigen::Isometry3d& X_WG);
  /// Like the other `grasp`. `p_Vref` (metres) replaces the part's own compliance point until the part is released or
  /// grasped anew. `p_Vref` must be within kFarthestPoint radii of the part's own point. If the part is already held
  /// under force feedback, a new `p_Vref` moves the target such that the wrench of the coupling stays the same.
  void grasp(std::size_t part, const Eigen::Isometry3d& X_WG, const Eigen::Vector3d& p_Vref);
  void release(std::size_t part);

  /// Places the bodies of a rider chain: one pose X_WB for each body. The caller must ensure that the riders collide
  /// with nothing on their way. From now on, the riders of an attached chain keep these poses relative to their part.
  void place_riders(std::size_t chain, std::span<const Eigen::Isometry3d> X_WB);
  /// Detaches and removes a chain. The chain is absent until the next `place_riders`.
  void remove_riders(std::size_t chain);
  /// Attaches a chain that has been placed. From now on, chain and part move as one rigid body. Contacts of the chain
  /// stop the part. Riders of a chain that is not attached have no contacts with obstacles.
  void attach(std::size_t chain, std::size_t part);
  /// Detaches a chain. From now on, the chain stands still.
  void detach(std::size_t chain);

  /// Like `Sliding::advance`, for all parts at once. X_WG must have one pose for each part. The poses of scripted parts
  /// are ignored. The scripts advance by `milliseconds` even while nothing else moves. A call that uses up its budget
  /// (`SlidingRules::work_budget`) leaves the parts at the last certified poses and sets `SlidingResult::ended_early`.
  /// If such a call ends within a cycle, the next call first completes this cycle with the old ghosts, and then goes on
  /// with the new ghosts.
  void advance(std::span<const Eigen::Isometry3d> X_WG, double milliseconds = 1.0);
  /// Whether the last call ended within a cycle. The next `advance` completes this cycle. Any other call that changes
  /// the simulation abandons this cycle.
  bool is_within_cycle() const;

  std::size_t part_count() const;
  std::size_t obstacle_count() const;
  /// The number of the part with which a body moves; −1 if the body stands still. `body` is a number as in
  /// `Contact::obstacle`.
  std::int32_t part_of_body(std::int32_t body) const;
  // Result and properties of the part with the number `part`, which must be below `part_count`.
  const SlidingResult& result(std::size_t part) const;
  const SlidingPart& part(std::size_t part) const;
  /// The compliance point of the present grasp, which is the reference point of all displacements of the part. While
  /// the part is released, the result is the part's own compliance point.
  const Eigen::Vector3d& p_Vref(std::size_t part) const;
  const CouplingStiffness& stiffness(std::size_t part) const;
  /// The gap (metres) at which contacts stop the part, except contacts with obstacles that have their own margin.
  double margin(std::size_t part) const;
  /// Whether a script moves the part.
  bool is_scripted(std::size_t part) const;
  /// Displacement from the visible part to its target, i.e. the extension of the coupling spring. Exactly zero while
  /// the part is at its target or is released. (`devices::HapticPartState::lag` is the displacement to the ghost.)
  geometry::Displacement lag(std::size_t part) const;

  const SearchStatistics& search_statistics() const;
  const CallStatistics& call_statistics() const;
  /// The number (from 1) of the newest call of `advance` whose ghosts have had a complete cycle; 0 before the first
  /// call. It is the number of the last call unless a call ended early.
  std::int64_t answered_call() const;

 private:
  friend struct SceneAccess;
  class Cycle;

  const ContactScene& scene() const;

  std::unique_ptr<Cycle> cycle_;
};

}  // namespace glissade::contact
