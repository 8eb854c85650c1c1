#pragma once

/// The stiffness that is passive at a distance from the device.

#include <algorithm>
#include <cmath>

#include <glissade/contact/spring.h>

namespace glissade::haptics {

/// A spring of stiffness K against translation and K_r against rotation, whose point is a distance l from that of the
/// device. About the device's point, across l, its matrix is [K, K l; K l, K_r + K l²]. It is passive if that is no
/// greater than diag(L, L_r), in the sense of definite matrices, where L and L_r are the limits (`passive_limit`) of a
/// spring at the device's point:
///   (L − K) (L_r − K_r) ≥ K L l², i.e. 1/K ≥ 1/L + l² / (L_r − K_r).
struct LeverLimit {
  double translational;  ///< L, N/m
  double rotational;     ///< L_r, Nm/rad
  double lever;          ///< l, metres

  /// The largest share s ≤ 1 of such a spring that is passive.
  double share_of(const contact::CouplingStiffness& K) const noexcept {
    const double both = translational * rotational;
    const double sum = K.translational * rotational + K.rotational * translational + of_lever(K.translational);
    return smaller_root(K.translational * K.rotational, sum, both);
  }

  /// The largest share d ≤ 1 of the second spring that is passive beside the first one, which is.
  double share_of_damping(const contact::CouplingStiffness& K,
                          const contact::CouplingStiffness& second) const noexcept {
    const double left = translational - K.translational;
    const double left_r = rotational - K.rotational;
    const double sum = left * second.rotational + left_r * second.translational + of_lever(second.translational);
    return smaller_root(second.translational * second.rotational, sum,
                        std::max(0.0, left * left_r - of_lever(K.translational)));
  }

 private:
  double of_lever(double stiffness) const noexcept { return stiffness * translational * lever * lever; }

  /// The smaller root of a x² − b x + c with a, b, c ≥ 0, at most 1.
  static double smaller_root(double a, double b, double c) noexcept {
    const double sum = b + std::sqrt(std::max(0.0, b * b - 4.0 * a * c));
    if (sum == 0.0) return 1.0;
    const double root = 2.0 * c / sum;
    return root >= 0.0 ? std::min(1.0, root) : 0.0;  // nothing where a number is not finite
  }
};

}  // namespace glissade::haptics
