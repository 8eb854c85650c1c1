#pragma once

/// The quadratic programme at the heart of sliding: among the displacements that half-space constraints allow, the one
/// nearest to a wanted displacement, in the metric of the coupling.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <glissade/geometry/displacement.h>
#include <glissade/haptics/contact_set.h>
#include <glissade/haptics/coupling.h>
#include <glissade/haptics/sliding_rules.h>

#include "solver/projection_status.h"

namespace glissade::haptics {

inline constexpr std::size_t kMaxActive = 6;  ///< a displacement has six degrees of freedom

/// `active` are the rows that hold with equality and push. `force` (newtons) is the multiplier of each, along its
/// normal: its share of K (ξ − ξ*). Displacements are valid only when solved.
template <std::size_t kParts>
struct ProjectionOf {
  ProjectionStatus status = ProjectionStatus::kSolved;
  std::array<geometry::Displacement, kParts> displacements{};
  int active_count = 0;
  std::array<std::int32_t, kMaxActive * kParts> active{};
  std::array<double, kMaxActive * kParts> force{};

  const geometry::Displacement& displacement() const { return displacements[0]; }
};

using Projection = ProjectionOf<1>;
using CoupledProjection = ProjectionOf<kMaxParts>;

/// Minimises ½ (ξ − wanted)ᵀ K (ξ − wanted) subject to rows, by the dual active-set method of Goldfarb and Idnani
/// (1983) in the whitened coordinates K^½ ξ, six for each part. The normals of the active rows are kept as an
/// orthonormal basis and a triangular factor, so that a change of the active set costs some hundred operations.
///
/// Bounded work: at most 32 + 4 · rows changes of the active set, O(rows) each. Deterministic. Not thread-safe.
class ProjectionSolver {
 public:
  /// Allocates memory for `rows` rows of one part. A call allocates only for more rows than any call before.
  explicit ProjectionSolver(std::size_t rows = 0);

  Projection project(const geometry::Displacement& wanted, const CouplingStiffness& stiffness,
                     std::span<const ConstraintRow> rows);

  /// The same for up to kMaxParts parts; `wanted` and `stiffness` have one entry for each part. A part of infinite
  /// stiffness stands still, whatever its wanted displacement.
  CoupledProjection project(std::span<const geometry::Displacement> wanted,
                            std::span<const CouplingStiffness> stiffness, std::span<const CoupledRow> rows);

 private:
  template <std::size_t kParts, typename Row>
  ProjectionOf<kParts> solve(std::span<const geometry::Displacement> wanted,
                             std::span<const CouplingStiffness> stiffness, std::span<const Row> rows);

  std::vector<double> normals_;  // column-major, one row for each normal
  std::vector<double> bounds_;
  std::vector<double> slacks_;
};

}  // namespace glissade::haptics
