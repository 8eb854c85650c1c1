#include "loop/contact_force.h"

#include <algorithm>

#include <glissade/contact/spring.h>

#include "loop/loop_settings.h"
#include "loop/smooth.h"

namespace glissade::haptics {

namespace {

/// N: the force or, if greater, the force at the radius that has this torque.
double size_of(const contact::Wrench& wrench, double radius) {
  return std::max(wrench.f.norm(), wrench.t.norm() / radius);
}

/// Scaled down as a whole, so that its size is at most `most`.
contact::Wrench limited(const contact::Wrench& wrench, double most, double radius) {
  const double size = size_of(wrench, radius);
  return size > most ? scaled(wrench, most / size) : wrench;
}

}  // namespace

double force_share(std::chrono::nanoseconds age) noexcept {
  using Seconds = std::chrono::duration<double>;
  return smoothly_down(Seconds(age).count(), Seconds(kFullForce).count(), Seconds(kForceless).count());
}

const contact::Wrench& ContactForce::update(const PartContacts& contacts, std::chrono::nanoseconds age,
                                            double ghost_motion, double dt) noexcept {
  const contact::Wrench all = limited(contacts.wrench, max_force_, radius_);
  const double share_of_age = force_share(age);
  share_ = std::min(share_of_age * contacts.known, share_ + dt / kLoop.return_s);
  const contact::Wrench wanted = scaled(all, share_);

  constexpr double kSlew_m_per_s = contact::kSlew_m / 1e-3;
  double longest =
      stiffness_.translational * (kSlew_m_per_s * dt + 2.0 * std::min(ghost_motion, kLoop.fastest_ghost_m_per_s * dt));
  if (size_of(wanted, radius_) < size_of(wrench_, radius_)) {
    longest = std::max(longest, max_force_ * dt / std::chrono::duration<double>(kLongestFall).count());
  }
  const contact::Wrench change{wanted.f - wrench_.f, wanted.t - wrench_.t};
  const double size = size_of(change, radius_);
  if (size <= longest) {
    wrench_ = wanted;
  } else {
    const contact::Wrench step = scaled(change, longest / size);
    wrench_ = {wrench_.f + step.f, wrench_.t + step.t};
  }
  wrench_ = limited(wrench_, share_of_age * max_force_, radius_);
  withheld_ = share_ < 1.0 ? contact::Wrench{all.f - wrench_.f, all.t - wrench_.t} : contact::Wrench{};
  return wrench_;
}

}  // namespace glissade::haptics
