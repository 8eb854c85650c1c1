#include "cycle/energy.h"

#include <cmath>

namespace glissade::contact {

double energy(std::span<const HeldPartState> parts, const Displacements& errors) {
  double sum = 0.0;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const CouplingStiffness& k = parts[p].stiffness;
    sum += 0.5 * (k.translational * errors[p].v.squaredNorm() + k.rotational * errors[p].w.squaredNorm());
  }
  return sum;
}

double energy_allowance(std::span<const HeldPartState> parts, const Displacements& errors, double largest_margin) {
  double sum = 0.0;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    if (!parts[p].is_held()) continue;
    const CouplingStiffness& k = parts[p].stiffness;
    const double squared_pull =
        k.translational * (k.translational * errors[p].v.squaredNorm() + k.rotational * errors[p].w.squaredNorm());
    sum += 2.0 * largest_margin * std::sqrt(squared_pull) + k.translational * largest_margin * largest_margin;
  }
  return sum;
}

}  // namespace glissade::contact
