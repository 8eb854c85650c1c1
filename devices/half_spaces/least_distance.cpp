#include "half_spaces/least_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <Eigen/QR>

namespace glissade::devices {
namespace {

constexpr int kMostColumns = kMaxHalfSpaces;
constexpr int kMostRounds =
    3 * kMostColumns;  // Lawson and Hanson, page 161: usual cases need about half as many rounds as rows
constexpr double kNoGain = 1e-13;

using Vector7d = Eigen::Matrix<double, 7, 1>;
using Columns = Eigen::Matrix<double, 7, Eigen::Dynamic, Eigen::ColMajor, 7, kMostColumns>;
using Unknowns = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMostColumns, 1>;

/// Minimises |E u − f| over u ≥ 0, by an active set.
class NonNegativeLeastSquares {
 public:
  NonNegativeLeastSquares(const Columns& E, const Vector7d& f) noexcept : E_(E), f_(f), u_(Unknowns::Zero(E.cols())) {}

  Unknowns solve() noexcept {
    for (int round = 0; round < kMostRounds; ++round) {
      const int next = steepest();
      if (next < 0) break;
      is_free_[static_cast<std::size_t>(next)] = true;
      if (!settle(next)) is_refused_[static_cast<std::size_t>(next)] = true;
    }
    return u_;
  }

 private:
  /// The unknown at zero whose growth reduces the residual most; −1 if none does.
  int steepest() const noexcept {
    const Unknowns gain = E_.transpose() * (f_ - E_ * u_);
    int best = -1;
    for (int j = 0; j < static_cast<int>(gain.size()); ++j) {
      const auto at = static_cast<std::size_t>(j);
      if (is_free_[at] || is_refused_[at] || gain[j] <= kNoGain * E_.col(j).norm()) continue;
      if (best < 0 || gain[j] > gain[best]) best = j;
    }
    return best;
  }

  /// Solves for the free unknowns, and lets go of those that would become negative. Returns whether `added` stayed free
  /// at first: a column that depends on others cannot grow.
  bool settle(int added) noexcept {
    for (int i = 0; i <= kMostColumns; ++i) {
      const Unknowns wanted = unbounded();
      if (i == 0 && wanted[added] <= 0.0) {
        is_free_[static_cast<std::size_t>(added)] = false;
        return false;
      }
      double share = 1.0;
      for (int j = 0; j < static_cast<int>(u_.size()); ++j) {
        if (is_free_[static_cast<std::size_t>(j)] && wanted[j] <= 0.0)
          share = std::min(share, u_[j] / (u_[j] - wanted[j]));
      }
      u_ += share * (wanted - u_);
      if (share == 1.0) break;
      for (int j = 0; j < static_cast<int>(u_.size()); ++j) {
        if (wanted[j] > 0.0 || u_[j] > kNoGain) continue;
        is_free_[static_cast<std::size_t>(j)] = false;
        u_[j] = 0.0;
      }
    }
    is_refused_ = {};
    return true;
  }

  /// The free unknowns of least squares, whatever their signs.
  Unknowns unbounded() const noexcept {
    std::array<int, kMostColumns> free{};
    int count = 0;
    for (int j = 0; j < static_cast<int>(u_.size()); ++j) {
      if (is_free_[static_cast<std::size_t>(j)]) free[static_cast<std::size_t>(count++)] = j;
    }
    Columns columns(7, count);
    for (int i = 0; i < count; ++i)
      columns.col(i) = E_.col(free[static_cast<std::size_t>(i)]);
    const Unknowns solution = columns.colPivHouseholderQr().solve(f_);
    Unknowns wanted = Unknowns::Zero(u_.size());
    for (int i = 0; i < count; ++i)
      wanted[free[static_cast<std::size_t>(i)]] = solution[i];
    return wanted;
  }

  const Columns& E_;
  const Vector7d& f_;
  Unknowns u_;
  std::array<bool, kMostColumns> is_free_{};
  std::array<bool, kMostColumns> is_refused_{};
};

}  // namespace

std::optional<geometry::Vector6d> least_distance(const Inequalities& inequalities) noexcept {
  const double scale = inequalities.h.size() > 0 ? inequalities.h.maxCoeff() : 0.0;
  if (!(scale > 0.0)) return geometry::Vector6d(geometry::Vector6d::Zero());
  Columns E(7, inequalities.h.size());
  E.topRows<6>() = inequalities.G.transpose();
  E.bottomRows<1>() = inequalities.h.transpose() / scale;
  const Vector7d f = Vector7d::Unit(6);
  const Unknowns u = NonNegativeLeastSquares(E, f).solve();
  const Vector7d residual = E * u - f;
  // The residual is 1 / (1 + |x|²): so small only if x is a million times what one inequality demands.
  if (!(residual[6] < -1e-12)) return std::nullopt;
  return geometry::Vector6d(residual.head<6>() * (-scale / residual[6]));
}

}  // namespace glissade::devices
