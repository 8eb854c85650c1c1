#include "cycle/allowed_fraction.h"

#include <algorithm>
#include <cmath>

#include "cycle/sliding_constants.h"

namespace glissade::contact {
namespace {

/// The largest fraction of a displacement `d` for which the lag of the part, `now` before the displacement, differs
/// from the `previous` lag by at most `most` metres, or by as much as it does already.
double fraction_with_lag(const geometry::Displacement& previous, const geometry::Displacement& now,
                         const geometry::Displacement& d, double radius, double most) {
  // Rotations are compared by the angle between them: rotation vectors may change faster than the rotations themselves.
  const Eigen::Quaterniond q_previous = geometry::rotation_by(previous.w);
  const Eigen::Quaterniond q_now = geometry::rotation_by(now.w);
  const auto changed = [&](double fraction) {
    const Eigen::Quaterniond q = q_now * geometry::rotation_by(fraction * d.w).conjugate();
    return (now.v - fraction * d.v - previous.v).norm() + radius * q.angularDistance(q_previous);
  };
  most = std::max(most, changed(0.0));
  if (changed(1.0) <= most) return 1.0;
  double allowed = 0.0;
  double refused = 1.0;
  for (int i = 0; i < 30; ++i) {
    const double middle = 0.5 * (allowed + refused);
    (changed(middle) <= most ? allowed : refused) = middle;
  }
  return allowed;
}

}  // namespace

AllowedFractions allowed_fractions(const SimulatedParts& shared, const Displacements& d, const ContactRows& rows,
                                   double reach) {
  AllowedFractions allowed;
  const double share = (reach - shared.largest_margin) / static_cast<double>(shared.count());
  for (std::size_t p = 0; p < shared.count(); ++p) {
    const HeldPartState& part = shared.states[p];
    double fraction = 1.0;
    if (part.slew != kUnbounded && part.is_held())
      fraction = fraction_with_lag(part.previous_lag, part.lag(), d[p], part.part_V->radius(), part.slew);
    const double angle = d[p].w.norm();
    const double largest_angle = std::sqrt(part.margin / part.lever);
    if (rows.is_anything_near() && angle * fraction > largest_angle) fraction = largest_angle / angle;
    allowed.beyond_reach[p] = fraction;
    allowed.of_parts[p] = std::min(fraction, geometry::fraction_within(d[p], part.lever, share));
  }
  for (std::size_t pass = 1; pass < shared.count(); ++pass) {
    for (const CoupledRow& row : rows.rows()) {
      if (row.other < 0) continue;
      for (std::array<double, kMaxParts>* fractions : {&allowed.of_parts, &allowed.beyond_reach}) {
        double& a = (*fractions)[static_cast<std::size_t>(row.part)];
        double& b = (*fractions)[static_cast<std::size_t>(row.other)];
        a = b = std::min(a, b);
      }
    }
  }
  return allowed;
}

}  // namespace glissade::contact
