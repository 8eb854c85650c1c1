#pragma once

/// The constraints of contacts on the displacements of parts, and the quadratic programme of a sliding step. The
/// programme finds the displacement nearest to the wanted displacement among the displacements that half-space
/// constraints allow. Distances are measured in the metric of the coupling stiffness.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <glissade/base/export.h>
#include <glissade/contact/sliding_rules.h>
#include <glissade/contact/spring.h>
#include <glissade/geometry/displacement.h>

namespace glissade::contact {

/// The constraint of one contact, n·(v + w × r) ≥ bound, on a displacement (v, w) of the part. v is the translation of
/// the part's reference point in metres. w is the rotation vector about that point in radians.
struct ConstraintRow {
  Eigen::Vector3d n;  ///< unit normal, from the obstacle to the part, world axes
  Eigen::Vector3d r;  ///< from the reference point to the contact point, world axes, metres
  double bound;       ///< right side of the constraint, metres; at most 0 if standing still is allowed

  /// The left side of the constraint: the motion of the contact point along n, in metres.
  double velocity(const geometry::Displacement& d) const { return n.dot(d.v + d.w.cross(r)); }
};

/// A constraint on the displacement of `part`. For a contact of two parts, the row constrains the displacement of
/// `part` relative to `other`.
struct CoupledRow : ConstraintRow {
  std::int32_t part = 0;
  std::int32_t other = -1;                            ///< number of the other part; −1 for an obstacle
  Eigen::Vector3d r_other = Eigen::Vector3d::Zero();  ///< like r, for the other part

  double velocity(std::span<const geometry::Displacement> d) const {
    const double own = ConstraintRow::velocity(d[static_cast<std::size_t>(part)]);
    return other < 0 ? own : own - ConstraintRow{n, r_other, 0.0}.velocity(d[static_cast<std::size_t>(other)]);
  }
};

/// The outcome of a projection on half-spaces.
enum class ProjectionStatus : std::uint8_t { kSolved, kInfeasible, kIterationLimit };

inline constexpr std::size_t kMaxActive = 6;  ///< a displacement has six degrees of freedom

/// `active` has the indices of the active rows, i.e. the rows that hold with equality and push. `force` has the
/// multiplier (newtons) of each active row. The multiplier is the row's share of K (ξ − ξ*), i.e. a force along the
/// row's normal. `displacements` is valid only with kSolved.
template <std::size_t kParts>
struct Projection {
  ProjectionStatus status = ProjectionStatus::kSolved;
  std::array<geometry::Displacement, kParts> displacements{};
  int active_count = 0;
  std::array<std::int32_t, kMaxActive * kParts> active{};
  std::array<double, kMaxActive * kParts> force{};

  const geometry::Displacement& displacement() const { return displacements[0]; }
};

using CoupledProjection = Projection<kMaxParts>;

/// Minimises ½ (ξ − wanted)ᵀ K (ξ − wanted) subject to rows. The method is the dual active-set method of Goldfarb and
/// Idnani (1983) in the whitened coordinates K^½ ξ. Each part has six coordinates. The normals of the active rows are
/// stored as an orthonormal basis and a triangular factor, so a change of the active set costs some hundred operations.
///
/// The work is bounded: the active set changes at most 32 + 4 · rows times, and each change costs O(rows).
/// Deterministic. Not thread-safe.
class GLISSADE_EXPORT ProjectionSolver {
 public:
  /// Allocates memory for `rows` rows of one part. A call allocates only if it has more rows than any earlier call.
  explicit ProjectionSolver(std::size_t rows = 0);

  Projection<1> project(const geometry::Displacement& wanted, const CouplingStiffness& stiffness,
                        std::span<const ConstraintRow> rows);

  /// Like the other `project`, for up to kMaxParts parts. `wanted` and `stiffness` have one entry for each part. A part
  /// of infinite stiffness stands still.
  CoupledProjection project(std::span<const geometry::Displacement> wanted,
                            std::span<const CouplingStiffness> stiffness, std::span<const CoupledRow> rows);

 private:
  template <std::size_t kParts, typename Row>
  Projection<kParts> solve(std::span<const geometry::Displacement> wanted, std::span<const CouplingStiffness> stiffness,
                           std::span<const Row> rows);

  std::vector<double> normals_;  // column-major, one row for each normal
  std::vector<double> bounds_;
  std::vector<double> slacks_;
};

}  // namespace glissade::contact
