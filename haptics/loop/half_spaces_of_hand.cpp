#include "loop/half_spaces_of_hand.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace glissade::haptics {

devices::HalfSpaces half_spaces_of_hand(const Eigen::Isometry3d& X_WH, const Eigen::Isometry3d& X_WG,
                                        const PartAnswer& answer, std::span<const contact::ConstraintRow> rows,
                                        const Coupling& coupling) noexcept {
  const contact::CouplingStiffness& K = coupling.stiffness;
  // The target T is fixed in the hand, and coincides with the part when the hand is at B.
  const Eigen::Isometry3d X_HT = X_WH.inverse() * X_WG * answer.X_GT;
  devices::HalfSpaces half_spaces;
  half_spaces.X_WB = answer.X_WV_of_rows * X_HT.inverse();
  half_spaces.p_HR = X_HT * answer.p_Vref;
  half_spaces.count = std::min(rows.size(), devices::kMaxHalfSpaces);
  for (std::size_t i = 0; i < half_spaces.count; ++i)
    half_spaces.rows[i] = {rows[i].n, rows[i].r, rows[i].bound};
  half_spaces.stiffness = K.translational;
  half_spaces.rotational_stiffness = K.rotational;
  half_spaces.damping =
      std::min(coupling.damping.translational, coupling.damping.rotational * (K.translational / K.rotational));
  return half_spaces;
}

double spring_size(const contact::Wrench& wrench, const contact::CouplingStiffness& stiffness) noexcept {
  return std::sqrt(wrench.f.squaredNorm() + wrench.t.squaredNorm() * (stiffness.translational / stiffness.rotational));
}

}  // namespace glissade::haptics
