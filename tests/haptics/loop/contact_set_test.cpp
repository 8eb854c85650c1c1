// What the haptic thread gets to know of the contacts.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/contact/multi_part_sliding.h>
#include <glissade/contact/spring.h>
#include <glissade/geometry/mesh_generators.h>
#include <glissade/haptics/contact_set.h>

#include "held_part.h"
#include "loop/answer.h"
#include "loop/contact_set_maker.h"
#include "one_hand_force.h"
#include "poses.h"

namespace glissade::haptics {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using std::chrono::milliseconds;
using test_support::at;
using test_support::pose;
using test_support::turn;

TEST(ContactSet, KeepsTheMarginOfAnObstacle) {
  contact::Obstacle block =
      test_support::obstacle_of(geometry::make_box({0.2, 0.2, 0.02}, 12), pose({0.0, 0.0, -0.01}));
  block.margin = 50e-6;
  contact::MultiPartSliding sliding({block},
                                    {{.part_V = test_support::cube(0.02), .X_WV_start = pose({0.0, 0.0, 0.011})}});
  for (int i = 0; i < 30; ++i)
    sliding.advance(std::vector{pose({0.0, 0.0, 0.005})});
  std::vector<UrgentContact> scratch;
  const ContactSet set = make_contact_set(sliding, 1, {}, scratch);
  ASSERT_GT(set.parts[0].pushing, 0);
  for (const ContactRow& row : set.rows()) {
    if (!row.pushes) continue;
    EXPECT_NEAR(row.bound, 0.0, 1e-8) << "no way towards the block is left";
  }
}

constexpr double kEdgeOfCube = 0.02;
constexpr double kStepOfCube = 0.2e-3;  // metres a millisecond

/// The greatest error of the force while the cube meets the wall, with sets that are 5 ms old.
double force_error(double contacts_ahead_ms) {
  contact::MultiPartSliding sliding({test_support::wall(0.5 * kEdgeOfCube)},
                                    {{.part_V = test_support::cube(kEdgeOfCube), .X_WV_start = at(-0.05)}},
                                    {.contacts_ahead_ms = contacts_ahead_ms});
  test_support::OneHandForce force(sliding.part(0).p_Vref(), sliding.part(0).radius(), sliding.stiffness(0), 100.0,
                                   at(-0.05));
  std::vector<ContactSet> sets;
  std::vector<UrgentContact> scratch;
  double greatest = 0.0;
  for (int i = 1; i <= 265; ++i) {
    const Isometry3d X_WG = at(-0.05 + i * kStepOfCube);
    sliding.advance({&X_WG, 1});
    sets.push_back(make_contact_set(sliding, i, milliseconds(i), scratch));
    const ContactSet& old = sets[static_cast<std::size_t>(std::max(0, i - 6))];
    const double felt = force.update(old, milliseconds(5), X_WG, 1e-3).f.norm();
    greatest =
        std::max(greatest, std::abs(felt - contact::spring_wrench(sliding.stiffness(0), sliding.lag(0)).f.norm()));
  }
  return greatest;
}

TEST(ContactSet, ContactsAheadMakeTheForceExactFromTheFirstTouch) {
  EXPECT_LT(force_error(6.0), 1e-9);
  EXPECT_GT(force_error(0.0), 0.1) << "without them, the force comes as late as the set";
}

/// A ghost that presses the ball on the block and rolls and drags it to and fro.
Isometry3d rolling_ghost(int call) {
  const double phase = 0.05 * call;
  return pose({0.01 * std::sin(phase), 0.005 * std::sin(1.7 * phase), 0.019},
              turn(1.0, Vector3d::UnitX()) * turn(phase, Vector3d::UnitY()));
}

TEST(ContactSet, HasTheTimeOfTheGhostsThatItAnswers) {
  const Isometry3d X_WV_start = pose({0.0, 0.0, 0.021}, turn(1.0, Vector3d::UnitX()));
  grasping::GraspSimulation sliding(
      {test_support::obstacle_of(geometry::make_box({0.1, 0.1, 0.05}, 6000), pose({0.0, 0.0, -0.025}))},
      {{.part_V = test_support::part_of(geometry::make_sphere(0.02, 2000)), .X_WV_start = X_WV_start}}, {},
      {.sliding = {.work_budget = 10'000}});
  Answerer answerer(sliding);
  int old = 0;
  std::chrono::nanoseconds last{0};
  for (int call = 1; call <= 300; ++call) {
    Ghosts ghosts;
    ghosts.time = std::chrono::milliseconds(call);
    ghosts.parts[0].X_WG = rolling_ghost(call);
    ghosts.parts[0].is_held = true;
    ghosts.parts[0].hold = 1;
    ContactSet set;
    answerer.answer(ghosts, kTickPeriod, set);
    EXPECT_GE(set.time, last) << call;
    const bool is_complete = !sliding.parts().result(0).ended_early;
    EXPECT_TRUE(!is_complete || set.time == ghosts.time) << call;
    old += set.time < ghosts.time ? 1 : 0;
    last = set.time;
  }
  EXPECT_GT(old, 20);
}

}  // namespace
}  // namespace glissade::haptics
