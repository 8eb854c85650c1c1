#pragma once

/// Sliding contact of several parts that two hands or scripts hold at once (paper §3): each visible part follows its
/// ghost as closely as obstacles and the other parts allow. No part is ever inside anything, neither at rest nor on its
/// way.
///
/// The method is sequential projection with a margin and a certificate. Each cycle finds the contacts within reach,
/// projects the wanted displacements on the constraints in the metric of the couplings, and takes the step only when
/// every triangle pair within reach is certified apart on its whole path. The paper's bisection finds the instant of
/// contact instead and derives a new direction from it. At that instant the gap is zero, where a closed predicate
/// already reports a collision and no further motion is possible; therefore contacts here hold parts one margin away.

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/haptics/contact_body.h>
#include <glissade/haptics/coupling.h>
#include <glissade/haptics/sliding_result.h>
#include <glissade/haptics/sliding_rules.h>
#include <glissade/haptics/sliding_simulation.h>

namespace glissade::haptics {

class ContactScene;

/// The simulation of up to kMaxParts parts among fixed obstacles. Deterministic: the same calls give the same bits.
/// Not thread-safe; several simulations may share bodies.
class MultiPartSliding {
 public:
  /// Throws std::invalid_argument when there is no part or too many, when there is nothing to touch, for null pointers,
  /// for poses and numbers out of range, when parts overlap each other at their start, and when a part overlaps an
  /// obstacle unless the rules depenetrate it. Bodies closer than the rounding of their coordinates count as
  /// overlapping.
  MultiPartSliding(std::vector<Obstacle> obstacles, const std::vector<HeldPart>& parts, const SlidingRules& rules = {});
  MultiPartSliding(MultiPartSliding&&) noexcept;
  MultiPartSliding& operator=(MultiPartSliding&&) noexcept;
  ~MultiPartSliding();

  /// As in `SlidingSimulation`, for one part, which must be below `part_count`. A released part stands still like an
  /// obstacle. Where a ghost takes hold at an offset under force feedback, the part's target starts where it was, or
  /// where the part is, and approaches the ghost by half of kSlew_m a millisecond: neither part nor force jumps.
  void grasp(std::size_t part, const Eigen::Isometry3d& X_WG);
  void release(std::size_t part);

  /// As `SlidingSimulation::advance`, for all parts at once; X_WG must have one pose for each.
  void advance(std::span<const Eigen::Isometry3d> X_WG, double milliseconds = 1.0);

  std::size_t part_count() const;
  // Of one part, which must be below `part_count`.
  const SlidingResult& result(std::size_t part) const;
  const SlidingPart& part(std::size_t part) const;
  const CouplingStiffness& stiffness(std::size_t part) const;
  /// Metres at which contacts hold the part away from obstacles without a margin of their own.
  double margin(std::size_t part) const;

  const SearchAccount& search_account() const;
  /// The bodies and their poses, for tests; the type is private.
  const ContactScene& scene() const;

 private:
  class Cycle;
  std::unique_ptr<Cycle> cycle_;
};

}  // namespace glissade::haptics
