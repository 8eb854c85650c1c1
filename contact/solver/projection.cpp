#include <algorithm>
#include <cmath>

#include <glissade/base/assert.h>
#include <glissade/contact/projection.h>

#include "solver/dual_active_set.h"

namespace glissade::contact {
namespace {

/// Violations below this many metres, or below this fraction of the wanted motion, count as met: far below any margin,
/// far above rounding. The step is certified afterwards all the same.
constexpr double kTolerance_m = 1e-12;
constexpr double kRelativeTolerance = 1e-9;

/// Square roots of a part's stiffnesses, which give K^½ ξ the unit √J in each coordinate, and their reciprocals.
struct Whitening {
  Whitening() = default;
  explicit Whitening(const CouplingStiffness& k)
      : t(std::sqrt(k.translational)), r(std::sqrt(k.rotational)), inverse_t(1.0 / t), inverse_r(1.0 / r) {}
  double t;
  double r;
  double inverse_t;
  double inverse_r;
};

/// Writes the normal of row `i` in the six coordinates of a part.
template <typename Normals>
void write_normal(Normals& normals, Eigen::Index i, int part, const Whitening& whitening, const Eigen::Vector3d& n,
                  const Eigen::Vector3d& r) {
  const Eigen::Vector3d lever = r.cross(n);
  for (int k = 0; k < 3; ++k) {
    normals(i, 6 * part + k) = n[k] * whitening.inverse_t;
    normals(i, 6 * part + 3 + k) = lever[k] * whitening.inverse_r;
  }
}

template <typename Normals>
void write_row(Normals& normals, Eigen::Index i, const Whitening* whitening, const ConstraintRow& row) {
  write_normal(normals, i, 0, whitening[0], row.n, row.r);
}

template <typename Normals>
void write_row(Normals& normals, Eigen::Index i, const Whitening* whitening, const CoupledRow& row) {
  normals.row(i).setZero();
  write_normal(normals, i, row.part, whitening[row.part], row.n, row.r);
  if (row.other >= 0) write_normal(normals, i, row.other, whitening[row.other], -row.n, row.r_other);
}

CoupledProjection widened(const auto& projection) {
  CoupledProjection wide;
  wide.status = projection.status;
  wide.active_count = projection.active_count;
  std::copy(projection.displacements.begin(), projection.displacements.end(), wide.displacements.begin());
  std::copy(projection.active.begin(), projection.active.end(), wide.active.begin());
  std::copy(projection.force.begin(), projection.force.end(), wide.force.begin());
  return wide;
}

}  // namespace

ProjectionSolver::ProjectionSolver(std::size_t rows) : normals_(kMaxActive * rows), bounds_(rows), slacks_(rows) {}

template <std::size_t kParts, typename Row>
Projection<kParts> ProjectionSolver::solve(std::span<const geometry::Displacement> wanted,
                                           std::span<const CouplingStiffness> stiffness, std::span<const Row> rows) {
  constexpr auto kDof = static_cast<int>(kMaxActive * kParts);
  if (bounds_.size() < rows.size()) {
    bounds_.resize(rows.size());
    slacks_.resize(rows.size());
  }
  const std::size_t size = kMaxActive * kParts * rows.size();
  if (normals_.size() < size) normals_.resize(size);

  std::array<Whitening, kParts> whitening;
  Eigen::Matrix<double, kDof, 1> y;
  double reach = 0.0;
  double turn = 0.0;
  for (std::size_t part = 0; part < kParts; ++part) {
    const auto first = static_cast<Eigen::Index>(6 * part);
    whitening[part] = Whitening(stiffness[part]);
    y.template segment<6>(first).setZero();
    if (!std::isfinite(stiffness[part].translational)) continue;
    y.template segment<3>(first) = whitening[part].t * wanted[part].v;
    y.template segment<3>(first + 3) = whitening[part].r * wanted[part].w;
    reach = std::max(reach, wanted[part].v.norm());
    turn = std::max(turn, wanted[part].w.norm());
  }
  const auto count = static_cast<Eigen::Index>(rows.size());
  Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, kDof>> normals(normals_.data(), count, kDof);
  double lever = 0.0;
  for (Eigen::Index i = 0; i < count; ++i) {
    const Row& row = rows[static_cast<std::size_t>(i)];
    write_row(normals, i, whitening.data(), row);
    bounds_[static_cast<std::size_t>(i)] = row.bound;
    lever = std::max(lever, row.r.squaredNorm());
  }
  const double tolerance = std::max(kTolerance_m, kRelativeTolerance * (reach + turn * std::sqrt(lever)));

  DualActiveSet<kDof> set(y, {{normals_.data(), count, kDof}, {bounds_.data(), count}}, tolerance,
                          {slacks_.data(), count});
  Projection<kParts> result;
  result.status = set.solve();
  if (result.status != ProjectionStatus::kSolved) return result;
  for (std::size_t part = 0; part < kParts; ++part) {
    const auto first = static_cast<Eigen::Index>(6 * part);
    result.displacements[part] = {set.point().template segment<3>(first) * whitening[part].inverse_t,
                                  set.point().template segment<3>(first + 3) * whitening[part].inverse_r};
  }
  result.active_count = set.active_count();
  for (int i = 0; i < result.active_count; ++i) {
    result.active[static_cast<std::size_t>(i)] = set.active(i);
    result.force[static_cast<std::size_t>(i)] = set.multiplier(i);
  }
  return result;
}

Projection<1> ProjectionSolver::project(const geometry::Displacement& wanted, const CouplingStiffness& stiffness,
                                        std::span<const ConstraintRow> rows) {
  return solve<1, ConstraintRow>({&wanted, 1}, {&stiffness, 1}, rows);
}

CoupledProjection ProjectionSolver::project(std::span<const geometry::Displacement> wanted,
                                            std::span<const CouplingStiffness> stiffness,
                                            std::span<const CoupledRow> rows) {
  static_assert(kMaxParts == 4);
  GLISSADE_ASSERT(!wanted.empty() && wanted.size() <= kMaxParts && stiffness.size() == wanted.size());
  switch (wanted.size()) {
    case 1:
      return widened(solve<1, CoupledRow>(wanted, stiffness, rows));
    case 2:
      return widened(solve<2, CoupledRow>(wanted, stiffness, rows));
    case 3:
      return widened(solve<3, CoupledRow>(wanted, stiffness, rows));
    default:
      return solve<4, CoupledRow>(wanted, stiffness, rows);
  }
}

}  // namespace glissade::contact
