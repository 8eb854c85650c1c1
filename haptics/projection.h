#pragma once

/// The quadratic programme at the heart of sliding: the displacement nearest to a wanted one, in the metric of the
/// coupling, that half-space constraints allow.

#include <array>
#include <cstdint>
#include <span>

#include <Eigen/Core>

#include <glissade/haptics/motion.h>

namespace glissade::haptics {

/// The spring that ties hand and part: stiffness against translation (N/m) and rotation (Nm/rad) of the reference
/// point. It is the metric of the projection too, so that the coupling wrench is exactly a sum of contact normals.
struct CouplingStiffness {
  double translational;
  double rotational;
};

/// A constraint n·(v + w × r) ≥ bound on a displacement.
struct ConstraintRow {
  Eigen::Vector3d n;  ///< unit normal, from the obstacle to the part, world axes
  Eigen::Vector3d r;  ///< from the reference point to the contact point, world axes, metres
  double bound;       ///< metres; not positive where standing still is allowed

  double velocity(const Displacement& d) const { return n.dot(d.v + d.w.cross(r)); }
};

inline constexpr int kMaxActive = 6;  ///< a displacement has six degrees of freedom

enum class ProjectionStatus : std::uint8_t { kSolved, kInfeasible, kIterationLimit };

struct Projection {
  ProjectionStatus status = ProjectionStatus::kSolved;
  Displacement displacement;
  int active_count = 0;
  std::array<std::int32_t, kMaxActive> active{};  ///< the rows that hold with equality and push
  std::array<double, kMaxActive> force{};  ///< newtons along the normal of each of them: its share of K (ξ* − ξ)
};

/// Minimises ½ (ξ − wanted)ᵀ K (ξ − wanted) subject to the rows, by the dual active-set method of Goldfarb and Idnani
/// (1983) in the six whitened coordinates K^½ ξ.
///
/// Bounded work: at most 32 + 4 rows changes of the active set, O(rows) each; no allocation. `displacement` is valid
/// only when solved. Thread-safe.
Projection project(const Displacement& wanted, const CouplingStiffness& stiffness,
                   std::span<const ConstraintRow> rows) noexcept;

}  // namespace glissade::haptics
