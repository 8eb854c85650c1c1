#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Cholesky>

#include <glissade/haptics/projection.h>

namespace glissade::haptics {
namespace {

/// Violations below this many metres, and below this part of what is wanted, count as met: far below any margin, far
/// above rounding. Whoever takes the displacement proves it free all the same.
constexpr double kTolerance_m = 1e-12;
constexpr double kRelativeTolerance = 1e-9;
/// A normal whose part outside the span of the active ones is below this fraction adds no direction of its own.
constexpr double kDependent = 1e-9;

using ActiveMatrix = Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::ColMajor, 6, kMaxActive>;
using ActiveVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMaxActive, 1>;
using ActiveSquare = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kMaxActive, kMaxActive>;

class DualActiveSet {
 public:
  DualActiveSet(const Displacement& wanted, const CouplingStiffness& stiffness, std::span<const ConstraintRow> rows)
      : rows_(rows), root_t_(std::sqrt(stiffness.translational)), root_r_(std::sqrt(stiffness.rotational)) {
    y_ << root_t_ * wanted.v, root_r_ * wanted.w;
    double lever = 0.0;
    for (const ConstraintRow& row : rows)
      lever = std::max(lever, row.r.squaredNorm());
    tolerance_ = std::max(kTolerance_m, kRelativeTolerance * (wanted.v.norm() + wanted.w.norm() * std::sqrt(lever)));
  }

  Projection solve() noexcept {
    Projection result;
    const auto limit = static_cast<std::int64_t>(32 + 4 * rows_.size());
    for (std::int64_t iteration = 0; iteration < limit; ++iteration) {
      const std::int32_t violated = most_violated();
      if (violated < 0) return finished(result);
      if (!activate(violated)) {
        result.status = ProjectionStatus::kInfeasible;
        return result;
      }
    }
    result.status = ProjectionStatus::kIterationLimit;
    return result;
  }

 private:
  Vector6d normal(std::int32_t row) const {
    const ConstraintRow& c = rows_[static_cast<std::size_t>(row)];
    return (Vector6d() << c.n / root_t_, c.r.cross(c.n) / root_r_).finished();
  }

  Displacement displacement() const { return {y_.head<3>() / root_t_, y_.tail<3>() / root_r_}; }

  double slack(std::int32_t row) const {
    const ConstraintRow& c = rows_[static_cast<std::size_t>(row)];
    return c.velocity(displacement()) - c.bound;
  }

  std::int32_t most_violated() const {
    const Displacement d = displacement();
    std::int32_t worst = -1;
    double worst_slack = -tolerance_;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const double slack = rows_[i].velocity(d) - rows_[i].bound;
      if (slack < worst_slack) {
        worst_slack = slack;
        worst = static_cast<std::int32_t>(i);
      }
    }
    return worst;
  }

  /// Moves to the optimum with `row` among the active ones, dropping those that no longer push. False if there is none.
  bool activate(std::int32_t row) noexcept {
    const Vector6d a = normal(row);
    double multiplier = 0.0;
    // Each pass but the last drops an active row, of which there are at most six.
    for (int pass = 0; pass <= kMaxActive; ++pass) {
      const ActiveMatrix normals = normals_.leftCols(count_);
      const ActiveSquare gram = normals.transpose() * normals;
      const ActiveVector r = gram.llt().solve(normals.transpose() * a);
      const Vector6d z = a - normals * r;

      double dual_step = std::numeric_limits<double>::infinity();  // until an active row stops pushing
      int leaving = -1;
      for (int j = 0; j < count_; ++j) {
        if (r[j] > 0.0 && multipliers_[j] / r[j] < dual_step) {
          dual_step = multipliers_[j] / r[j];
          leaving = j;
        }
      }
      const bool independent = count_ < kMaxActive && z.norm() > kDependent * a.norm();
      const double full_step =
          independent ? std::max(0.0, -slack(row)) / z.squaredNorm() : std::numeric_limits<double>::infinity();
      const double step = std::min(dual_step, full_step);
      if (step == std::numeric_limits<double>::infinity()) return false;

      if (independent) y_ += step * z;
      multipliers_.head(count_) -= step * r;
      multiplier += step;
      if (full_step <= dual_step) {
        normals_.col(count_) = a;
        multipliers_[count_] = multiplier;
        active_[static_cast<std::size_t>(count_)] = row;
        ++count_;
        return true;
      }
      drop(leaving);
    }
    return false;
  }

  void drop(int leaving) {
    for (int j = leaving; j + 1 < count_; ++j) {
      normals_.col(j) = normals_.col(j + 1).eval();
      multipliers_[j] = multipliers_[j + 1];
      active_[static_cast<std::size_t>(j)] = active_[static_cast<std::size_t>(j) + 1];
    }
    --count_;
  }

  Projection finished(Projection result) const {
    result.displacement = displacement();
    result.active_count = count_;
    result.active = active_;
    for (int j = 0; j < count_; ++j)
      result.force[static_cast<std::size_t>(j)] = multipliers_[j];
    return result;
  }

  std::span<const ConstraintRow> rows_;
  double root_t_;
  double root_r_;
  double tolerance_ = kTolerance_m;  // metres
  Vector6d y_;
  int count_ = 0;
  Eigen::Matrix<double, 6, kMaxActive> normals_;
  Eigen::Matrix<double, kMaxActive, 1> multipliers_;
  std::array<std::int32_t, kMaxActive> active_{};
};

}  // namespace

Projection project(const Displacement& wanted, const CouplingStiffness& stiffness,
                   std::span<const ConstraintRow> rows) noexcept {
  return DualActiveSet(wanted, stiffness, rows).solve();
}

}  // namespace glissade::haptics
