// Poses of the bodies during a step.

#include "certificate/moving_bodies.h"

#include <vector>

#include <gtest/gtest.h>

#include <glissade/geometry/mesh_generators.h>

#include "held_part.h"
#include "poses.h"

namespace glissade::haptics {
namespace {

using Eigen::Vector3d;

// In the first step of all, too: nothing is known of its motion yet.
TEST(MovingBodies, ThatDoNotMoveStandWhereTheyAreAllAlong) {
  const auto part = test_support::part_of(geometry::make_box({0.02, 0.02, 0.02}, 12));
  ContactScene scene({}, {part, part}, std::vector<double>{1e-5, 1e-5});
  scene.place(0, test_support::pose({0.1, 0.2, 0.3}, test_support::turn(0.7, Vector3d::UnitX())));
  scene.place(1, test_support::pose({0.4, 0.1, 0.2}, test_support::turn(0.3, Vector3d::UnitZ())));
  MovingBodies bodies(scene);
  bodies.begin_step(std::vector<geometry::Displacement>{{}, {Vector3d(1e-3, 0.0, 0.0), Vector3d(0.0, 0.0, 0.1)}});
  for (int moment = 0; moment <= MovingBodies::kMoments; ++moment)
    EXPECT_EQ(bodies.pose(0, moment).matrix(), scene.bodies()[0].X_WB.matrix()) << "moment " << moment;
  EXPECT_NE(bodies.pose(1, MovingBodies::kMoments).matrix(), scene.bodies()[1].X_WB.matrix());
}

}  // namespace
}  // namespace glissade::haptics
