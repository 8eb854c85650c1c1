#pragma once

/// The iteration of the founding paper (§4, Figure 10): how far the root and each flex value may go from their last
/// valid values towards the wanted ones.

#include <cstddef>
#include <vector>

#include <glissade/grasping/kinematic_chain.h>

#include "clasp/closing_rows.h"

namespace glissade::grasping {

/// All movers, i.e. the root and the flex values, are interpolated together until a contact stops them. The mover
/// highest in the chain that closes this contact is then fixed, and all others, its dependents among them, go on. In
/// the paper a bisection brackets these fractions, with a test for collisions at each; to first order the contacts give
/// them in closed form. At last each mover alone goes on as far as it can, so that none could come nearer to its wanted
/// value.
class Interpolation {
 public:
  explicit Interpolation(const KinematicChain& chain);

  /// The shares, 0 to 1, of the wanted step that each mover makes. Gains below `bracket` (metres) are not worth it.
  const std::vector<double>& find(const ClosingRows& rows, double bracket);

 private:
  void advance_together();
  void advance_alone(double bracket);
  double room_for(std::size_t mover) const;
  void advance(std::size_t mover, double share);

  const ClosingRows* rows_ = nullptr;
  std::vector<std::size_t> order_;  // movers, highest in the chain first
  std::vector<double> shares_;
  std::vector<char> is_fixed_;
  std::vector<double> rooms_;  // metres left to each contact
};

}  // namespace glissade::grasping
