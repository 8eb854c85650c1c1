// A call ends with the contacts where it has led, and with their forces.

#include <algorithm>

#include <gtest/gtest.h>

#include <glissade/contact/sliding.h>
#include <glissade/geometry/mesh_generators.h>

#include "held_part.h"
#include "poses.h"

namespace glissade::contact {
namespace {

using Eigen::Vector3d;

// Facet follows facet here, and no step tells what the next one finds.
TEST(SlidingOverFacets, ContactForcesBalanceTheSpringAtTheFinalPose) {
  constexpr double kSphere = 0.1;
  constexpr double kBall = 0.02;
  constexpr double kPressed = 3e-3;  // metres, of the ghost below
  constexpr double kPerTick = 0.2e-3;
  constexpr double kLeft = 1e-6;  // metres: what a call may leave of its way
  Sliding sliding({test_support::obstacle_of(geometry::make_sphere(kSphere, 8000))},
                  test_support::part_of(geometry::make_sphere(kBall, 800)),
                  test_support::at(-0.01, 0.0, kSphere + kBall));
  int pushed = 0;
  int snapping = 0;
  for (int tick = 1; tick <= 100; ++tick) {
    const double down = std::min(1.0, tick / 20.0) * kPressed;
    const SlidingResult& result =
        sliding.advance(test_support::at(-0.01 + kPerTick * tick, 0.0, kSphere + kBall - down));
    if (result.pushing == 0) continue;
    ++pushed;
    const double behind = (result.X_WV.translation() - result.X_WV_of_contacts.translation()).norm();
    ASSERT_LT(behind, 0.1 * sliding.margin()) << "tick " << tick;  // a step that was too short to look again
    Vector3d force = Vector3d::Zero();
    for (const Contact& contact : result.contacts)
      force += contact.force * contact.n_W;
    const double stiffness = sliding.stiffness().translational;
    const Vector3d spring = stiffness * sliding.lag().v;
    snapping += (force + spring).norm() > 2.0 * stiffness * kLeft ? 1 : 0;
  }
  EXPECT_LE(snapping, 3) << "past a corner, no faster than the slew allows";
  EXPECT_GT(pushed, 70);
}

}  // namespace
}  // namespace glissade::contact
