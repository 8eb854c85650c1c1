#include "loop/usable_set.h"

#include <algorithm>
#include <cmath>

namespace glissade::haptics {
namespace {

template <typename Numbers>
bool are_small(const Eigen::MatrixBase<Numbers>& numbers) {
  constexpr double kGreatest = 1e12;
  return (numbers.array().abs() < kGreatest).all();
}

bool are_numbers(const hands::JointValues& values) {
  return std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
}

bool is_usable_part(const PartAnswer& part) {
  const auto is_pose = [](const Eigen::Isometry3d& X) { return are_small(X.matrix()); };
  return are_small(part.p_Vref) && is_pose(part.X_WV) && is_pose(part.X_WV_of_rows) && is_pose(part.X_WG) &&
         is_pose(part.X_GT);
}

bool is_usable_row(const ContactRow& row) {
  return are_small(row.n) && are_small(row.r) && are_small(row.r_other) && are_small(row.friction_ratio_W) &&
         are_small(Eigen::Vector2d(row.bound, row.approach)) && !std::isnan(row.range);
}

bool is_usable_hand(const HandAnswer& hand) {
  const auto has_numbers = [](const FingerRow& row) {
    return are_numbers(row.rates) && std::isfinite(row.gap) && are_small(row.n_W) && are_small(row.p_W);
  };
  return are_small(hand.visible.X_WH.matrix()) && are_numbers(hand.visible.angles) &&
         std::all_of(hand.rows().begin(), hand.rows().end(), has_numbers);
}

}  // namespace

bool is_usable(std::span<const PartAnswer> parts, std::span<const ContactRow> rows,
               std::span<const HandAnswer> hands) noexcept {
  return std::all_of(parts.begin(), parts.end(), is_usable_part) &&
         std::all_of(rows.begin(), rows.end(), is_usable_row) &&
         std::all_of(hands.begin(), hands.end(), is_usable_hand);
}

}  // namespace glissade::haptics
