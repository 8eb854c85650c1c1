// Poses of the bodies during a step.

#include "certificate/moving_bodies.h"

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/geometry/mesh_generators.h>

#include "held_part.h"
#include "poses.h"

namespace glissade::contact {
namespace {

using Eigen::Vector3d;

/// Its reference point is not the origin of its frame.
std::shared_ptr<const SlidingPart> box_beside_its_origin() {
  geometry::TriangleMesh mesh = geometry::make_box({0.02, 0.02, 0.02}, 12);
  for (Vector3d& vertex : mesh.vertices)
    vertex += Vector3d(0.03, 0.07, 0.11);
  return test_support::part_of(std::move(mesh));
}

class BodiesInStep : public testing::Test {
 protected:
  BodiesInStep() {
    const Vector3d oblique = Vector3d(1.0, 2.0, 3.0).normalized();
    scene_.place(0, test_support::pose({0.1, 0.2, 0.3}, test_support::turn(0.7, oblique)));
    scene_.place(1, test_support::pose({0.4, 0.1, 0.2}, test_support::turn(0.3, oblique)));
  }

  void expect_that_it_stands(MovingBodies& bodies, std::int32_t body) {
    for (int moment = 0; moment <= MovingBodies::kMoments; ++moment)
      EXPECT_EQ(bodies.pose(body, moment).matrix(), pose_of(body)) << "moment " << moment;
  }

  Eigen::Matrix4d pose_of(std::int32_t body) { return scene_.bodies()[static_cast<std::size_t>(body)].X_WB.matrix(); }

  ContactScene scene_{{}, {box_beside_its_origin(), box_beside_its_origin()}, std::vector<double>{1e-5, 1e-5}};
  geometry::Displacement way_{Vector3d(1e-3, 0.0, 0.0), Vector3d(0.0, 0.0, 0.1)};
};

TEST_F(BodiesInStep, ZeroDisplacementKeepsThePose) {
  MovingBodies bodies(scene_);
  bodies.begin_step(std::vector<geometry::Displacement>{{}, way_});  // the first has never moved
  expect_that_it_stands(bodies, 0);
  EXPECT_NE(bodies.pose(1, MovingBodies::kMoments).matrix(), pose_of(1));
  bodies.begin_step(std::vector<geometry::Displacement>{way_, {}});
  EXPECT_NE(bodies.pose(0, MovingBodies::kMoments).matrix(), pose_of(0));
  expect_that_it_stands(bodies, 1);  // it has moved in the last step
}

}  // namespace
}  // namespace glissade::contact
