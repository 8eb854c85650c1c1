#pragma once

/// The dual active-set method of Goldfarb and Idnani for the Euclidean projection of a point on half-spaces.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include <Eigen/Core>

#include <glissade/contact/projection.h>

namespace glissade::contact {

/// The half-spaces a_i·y ≥ b_i, i < count.
template <int kDof>
struct HalfSpaces {
  Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, kDof>> normals;  ///< one row for each half-space
  Eigen::Map<const Eigen::VectorXd> bounds;
};

/// Projects y on half-spaces. Each object serves one projection.
template <int kDof>
class DualActiveSet {
 public:
  using Vector = Eigen::Matrix<double, kDof, 1>;

  /// A half-space counts as met if it is violated by at most `tolerance`. `slacks` is scratch memory with one entry for
  /// each half-space.
  DualActiveSet(const Vector& y, const HalfSpaces<kDof>& half_spaces, double tolerance,
                const Eigen::Map<Eigen::VectorXd>& slacks)
      : half_spaces_(half_spaces), slacks_(slacks), tolerance_(tolerance), y_(y) {}

  ProjectionStatus solve() noexcept {
    const std::int64_t limit = 32 + 4 * half_spaces_.bounds.size();
    for (std::int64_t iteration = 0; iteration < limit; ++iteration) {
      const std::int32_t violated = most_violated();
      if (violated < 0) return ProjectionStatus::kSolved;
      if (!activate(violated)) return ProjectionStatus::kInfeasible;
    }
    return ProjectionStatus::kIterationLimit;
  }

  const Vector& point() const { return y_; }
  int active_count() const { return count_; }
  std::int32_t active(int i) const { return active_[static_cast<std::size_t>(i)]; }
  double multiplier(int i) const { return multipliers_[i]; }

 private:
  static constexpr auto kSize = static_cast<std::size_t>(kDof);
  /// A normal depends on the active ones if less than this fraction of it lies outside their span.
  static constexpr double kDependent = 1e-9;

  std::int32_t most_violated() noexcept {
    if (slacks_.size() == 0) return -1;
    slacks_ = -half_spaces_.bounds;
    slacks_.noalias() += half_spaces_.normals * y_;
    // Finds the minimum first, then its place: a search with branches would cost more than the products.
    const double worst = slacks_.minCoeff();
    if (!(worst < -tolerance_)) return -1;
    return static_cast<std::int32_t>(std::find(slacks_.begin(), slacks_.end(), worst) - slacks_.begin());
  }

  /// Moves to the optimum with half-space `i` active as well, and drops active ones that no longer push. Returns false
  /// if there is no such optimum.
  bool activate(std::int32_t i) noexcept {
    const Vector a = half_spaces_.normals.row(i).transpose();
    const double length = a.norm();
    double multiplier = 0.0;
    // Each pass except the last drops one active half-space.
    for (int pass = 0; pass <= kDof; ++pass) {
      // a = basis c + z; the active normals are basis · triangle. Orthogonalised twice, otherwise rounding would tilt
      // the basis.
      std::array<double, kSize> c{};
      Vector z = a;
      for (int sweep = 0; sweep < 2; ++sweep) {
        for (int j = 0; j < count_; ++j) {
          const double along = basis_.col(j).dot(z);
          z -= along * basis_.col(j);
          c[static_cast<std::size_t>(j)] += along;
        }
      }
      std::array<double, kSize> r = c;                             // triangle r = c: the active normals' shares of a
      double dual_step = std::numeric_limits<double>::infinity();  // until an active half-space stops pushing
      int leaving = -1;
      for (int j = count_ - 1; j >= 0; --j) {
        double& share = r[static_cast<std::size_t>(j)];
        for (int k = j + 1; k < count_; ++k)
          share -= triangle_(j, k) * r[static_cast<std::size_t>(k)];
        share /= triangle_(j, j);
        if (share > 0.0 && multipliers_[j] <= dual_step * share) {
          dual_step = multipliers_[j] / share;
          leaving = j;
        }
      }
      const double outside = z.norm();
      const bool independent = count_ < kDof && outside > kDependent * length;
      const double full_step = independent ? std::max(0.0, half_spaces_.bounds[i] - a.dot(y_)) / (outside * outside)
                                           : std::numeric_limits<double>::infinity();
      const double step = std::min(dual_step, full_step);
      if (step == std::numeric_limits<double>::infinity()) return false;

      if (independent) y_ += step * z;
      for (int j = 0; j < count_; ++j)
        multipliers_[j] -= step * r[static_cast<std::size_t>(j)];
      multiplier += step;
      if (full_step <= dual_step) {
        for (int j = 0; j < count_; ++j)
          triangle_(j, count_) = c[static_cast<std::size_t>(j)];
        triangle_(count_, count_) = outside;
        basis_.col(count_) = z / outside;
        multipliers_[count_] = multiplier;
        active_[static_cast<std::size_t>(count_)] = i;
        ++count_;
        return true;
      }
      drop(leaving);
    }
    return false;
  }

  /// Removes a column of the triangular factor, and makes it triangular again by Givens rotations of the basis.
  void drop(int leaving) noexcept {
    --count_;
    for (int j = leaving; j < count_; ++j) {
      triangle_.col(j) = triangle_.col(j + 1).eval();
      multipliers_[j] = multipliers_[j + 1];
      active_[static_cast<std::size_t>(j)] = active_[static_cast<std::size_t>(j) + 1];
    }
    for (int j = leaving; j < count_; ++j) {
      const double length = std::sqrt(triangle_(j, j) * triangle_(j, j) + triangle_(j + 1, j) * triangle_(j + 1, j));
      const double cosine = triangle_(j, j) / length;
      const double sine = triangle_(j + 1, j) / length;
      triangle_(j, j) = length;
      for (int k = j + 1; k < count_; ++k) {
        const double upper = triangle_(j, k);
        const double lower = triangle_(j + 1, k);
        triangle_(j, k) = cosine * upper + sine * lower;
        triangle_(j + 1, k) = cosine * lower - sine * upper;
      }
      const Vector first = basis_.col(j);
      basis_.col(j) = cosine * first + sine * basis_.col(j + 1);
      basis_.col(j + 1) = cosine * basis_.col(j + 1) - sine * first;
    }
  }

  HalfSpaces<kDof> half_spaces_;
  Eigen::Map<Eigen::VectorXd> slacks_;
  double tolerance_;
  Vector y_;
  int count_ = 0;
  Eigen::Matrix<double, kDof, kDof> basis_;
  Eigen::Matrix<double, kDof, kDof> triangle_;
  Vector multipliers_;
  std::array<std::int32_t, kSize> active_{};
};

}  // namespace glissade::contact
