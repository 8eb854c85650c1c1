#pragma once

/// Sliding contact of several parts at once, each held by a hand or by a script, i.e. by poses given over time (§3 of
/// the founding paper, *Natural Interaction in Virtual Environments*). The ghost of a part is the pose that the part
/// would have if nothing were in the way. Each visible part follows its ghost as closely as the obstacles and the other
/// parts allow. A part that starts apart from all other bodies never gets inside one, neither at rest nor on its way.
/// One that touches or overlaps a body at its start never gets deeper into it.
///
/// The method is sequential projection with a margin and a certificate. A call consists of cycles. Each cycle finds the
/// contacts with a gap below a search radius, the reach. It then projects the wanted displacements of the parts on the
/// displacements that these contacts allow, in the metric of the coupling stiffness. The result is a step. The parts
/// take the step only with a certificate: a proof that every triangle pair within reach stays apart on the whole path.
///
/// The bisection of the paper instead finds the instant of contact and derives a new direction from the contact. At
/// that instant the gap is zero: an exact intersection test, for which touching counts, already reports a collision,
/// and no further motion is possible. Therefore the contacts here stop parts at a positive gap, the margin.

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/contact/contact_body.h>
#include <glissade/contact/sliding_result.h>
#include <glissade/contact/sliding_rules.h>
#include <glissade/contact/spring.h>
#include <glissade/contact/statistics.h>
#include <glissade/geometry/displacement.h>

namespace glissade::contact {

class ContactScene;

/// How deep a part at X_BV is in a body, metres: by so much, all of its faces would have to move inwards until it were
/// free. 0 if the two are apart, or only touch. Where no such distance frees the part, or the part is an open surface,
/// instead the length of a translation that leads out of the body. Cost: some hundred collision queries.
double overlap_depth(const ContactBody& body, const SlidingPart& part_V, const Eigen::Isometry3d& X_BV);

/// The mesh of a part with all of its faces `depth` (metres) further inside; none of an open surface. Triangles keep
/// their numbers.
std::optional<geometry::TriangleMesh> inset_mesh(const SlidingPart& part_V, double depth);

/// Whether a part at X_BV is wholly inside the closed surface of a body, which it does not touch.
bool is_enclosed(const ContactBody& body, const SlidingPart& part_V, const Eigen::Isometry3d& X_BV);

/// The simulation of up to kMaxParts parts among fixed obstacles, and of riders: hands, for example, that are in the
/// way of parts or move with them. Deterministic: the same calls give the same bits. Not thread-safe; several
/// simulations may share bodies.
class MultiPartSliding {
 public:
  /// Nothing touches the riders of `chains` before they are placed. Throws std::invalid_argument for no part or more
  /// than kMaxParts parts, for a single part without obstacles and riders, for null pointers, for poses and numbers out
  /// of range, for parts so far from the origin (10⁷ m or more) that rounding exceeds the minimum clearance, and for
  /// overlaps at the start that `OverlapRule` refuses. Bodies closer than the rounding of their
  /// coordinates count as touching.
  MultiPartSliding(std::vector<Obstacle> obstacles, const std::vector<HeldPart>& parts, const SlidingRules& rules = {},
                   const std::vector<RiderChain>& chains = {});
  MultiPartSliding(MultiPartSliding&&) noexcept;
  MultiPartSliding& operator=(MultiPartSliding&&) noexcept;
  ~MultiPartSliding();

  /// As `Sliding::grasp` and `Sliding::release`; `part` is its number, below `part_count`. A released part stands still
  /// like an obstacle. Under force feedback, `grasp` does not move the target at once to the new ghost: if the part was
  /// released, the target starts at the pose of the part; if the part was already held, the target stays where it was.
  /// From there the target approaches the ghost by 0.1 mm a millisecond (half of kSlew_m, `spring.h`), so neither part
  /// nor force jumps. `part` must not be scripted.
  void grasp(std::size_t part, const Eigen::Isometry3d& X_WG);
  /// The same, and the compliance point is `p_Vref` (metres) instead of the part's own, until the part is released or
  /// taken anew; no farther from it than kFarthestPoint radii. A part already held by force feedback keeps the wrench
  /// of its coupling, so its target moves if the point does.
  void grasp(std::size_t part, const Eigen::Isometry3d& X_WG, const Eigen::Vector3d& p_Vref);
  void release(std::size_t part);

  /// Places the riders of a chain, one rigid pose X_WB for each. The caller must know that they are free on the way
  /// there. An attached chain stays so relative to its part from now on.
  void place_riders(std::size_t chain, std::span<const Eigen::Isometry3d> X_WB);
  /// Takes a chain away, and detaches it, until it is placed again.
  void remove_riders(std::size_t chain);
  /// From now on, the chain, which has been placed, moves with the part, as one rigid body: its contacts stop the part.
  /// While neither is attached to anything, riders and obstacles are no obstacles of each other.
  void attach(std::size_t chain, std::size_t part);
  /// From now on, the chain stands still again.
  void detach(std::size_t chain);

  /// As `Sliding::advance`, for all parts at once. X_WG must have one pose for each part; that of a scripted
  /// part is ignored. The scripts advance by `milliseconds` even while nothing else moves. A call whose work is used up
  /// (`SlidingRules::work_budget`) ends with the last poses that are proven free, and says so
  /// (`SlidingResult::ended_early`). If it ended within a cycle, the next call completes that cycle for the old ghosts,
  /// and then goes on with its own.
  void advance(std::span<const Eigen::Isometry3d> X_WG, double milliseconds = 1.0);
  /// Whether the last call ended within a cycle, which the next one completes. Other calls than `advance` give the
  /// cycle up, and the search for which it may be waiting.
  bool is_within_cycle() const;

  std::size_t part_count() const;
  std::size_t obstacle_count() const;
  /// The part with which a body, numbered as in `Contact::obstacle`, moves; −1: it stands still.
  std::int32_t part_of_body(std::int32_t body) const;
  // Result and properties of the part with the number `part`, which must be below `part_count`.
  const SlidingResult& result(std::size_t part) const;
  const SlidingPart& part(std::size_t part) const;
  /// The compliance point of the present hold, about which all displacements of the part are; the part's own while
  /// nobody holds it.
  const Eigen::Vector3d& p_Vref(std::size_t part) const;
  const CouplingStiffness& stiffness(std::size_t part) const;
  /// The gap (metres) at which contacts with obstacles that have no margin of their own stop the part.
  double margin(std::size_t part) const;
  /// Whether a script moves the part.
  bool is_scripted(std::size_t part) const;
  /// Displacement from the visible part to its target, by which the coupling's spring is stretched. Exactly zero when
  /// the part is at its target and while the part is released. (`devices::HapticPartState::lag` goes to the ghost.)
  geometry::Displacement lag(std::size_t part) const;

  const SearchStatistics& search_statistics() const;
  const CallStatistics& call_statistics() const;
  /// The number, from 1 on, of the call of `advance` whose ghosts the poses answer with at least one cycle: the last
  /// one, unless a call ended early. 0 before the first.
  std::int64_t answered_call() const;

 private:
  friend struct SceneAccess;
  class Cycle;

  const ContactScene& scene() const;

  std::unique_ptr<Cycle> cycle_;
};

}  // namespace glissade::contact
