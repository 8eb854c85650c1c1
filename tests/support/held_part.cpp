#include "held_part.h"

#include <cmath>

#include "poses.h"

namespace glissade::test_support {

using Eigen::Isometry3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

Isometry3d between(const Isometry3d& X_from, const Isometry3d& X_to, double t) {
  const Quaterniond q = Quaterniond(X_from.linear()).slerp(t, Quaterniond(X_to.linear()));
  return pose((1.0 - t) * X_from.translation() + t * X_to.translation(), q);
}

void lead(haptics::SlidingSimulation& sliding, const Isometry3d& X_WG, int calls,
          const std::function<void(const haptics::SlidingResult&)>& see) {
  const Isometry3d X_WG_from = sliding.result().X_WG;
  for (int i = 1; i <= calls; ++i) {
    // The last pose is X_WG to the bit.
    const haptics::SlidingResult& result =
        sliding.advance(i == calls ? X_WG : between(X_WG_from, X_WG, static_cast<double>(i) / calls));
    if (see) see(result);
  }
}

int hold_until_rest(haptics::SlidingSimulation& sliding, int most_calls) {
  const Isometry3d X_WG = sliding.result().X_WG;
  int still = 0;
  for (int call = 1; call <= most_calls; ++call) {
    const Isometry3d X_WV = sliding.result().X_WV;
    sliding.advance(X_WG);
    const geometry::Displacement moved =
        geometry::displacement_between(X_WV, sliding.result().X_WV, sliding.part().p_Vref());
    still = geometry::motion_bound(moved, sliding.part().radius()) < 1e-12 ? still + 1 : 0;
    if (still == 20) return call;
  }
  return -1;
}

haptics::Wrench sum_of_contacts(const haptics::SlidingSimulation& sliding) {
  const haptics::SlidingResult& result = sliding.result();
  const Vector3d p_Wref = result.X_WV_of_contacts * sliding.part().p_Vref();
  haptics::Wrench sum;
  for (const haptics::Contact& contact : result.contacts) {
    const Vector3d f = contact.force * contact.n_W + contact.friction_W;
    sum.f += f;
    sum.t += (contact.p_W - p_Wref).cross(f);
  }
  return sum;
}

haptics::Wrench spring_on_part(const haptics::SlidingSimulation& sliding) {
  const haptics::Wrench on_hand = haptics::spring_wrench(sliding.stiffness(), sliding.error());
  return {-on_hand.f, -on_hand.t};
}

double imbalance(const haptics::SlidingSimulation& sliding) {
  const haptics::CouplingStiffness& K = sliding.stiffness();
  const auto norm = [&](const Vector3d& f, const Vector3d& t) {
    return std::sqrt(f.squaredNorm() / K.translational + t.squaredNorm() / K.rotational);
  };
  const haptics::Wrench spring = spring_on_part(sliding);
  const haptics::Wrench contacts = sum_of_contacts(sliding);
  return norm(spring.f + contacts.f, spring.t + contacts.t) / norm(spring.f, spring.t);
}

double length_in(const haptics::CouplingStiffness& stiffness, const geometry::Displacement& d) {
  return std::sqrt(stiffness.translational * d.v.squaredNorm() + stiffness.rotational * d.w.squaredNorm());
}

}  // namespace glissade::test_support
