// Sliding against optima known in closed form: a box pressed against a plane, into a groove and into a corner, and thin
// sheets at speed.

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <ostream>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/contact/sliding.h>
#include <glissade/contact/spring.h>
#include <glissade/geometry/mesh_generators.h>
#include <glissade/geometry/triangle_mesh.h>

#include "held_part.h"
#include "poses.h"
#include "sanitizers.h"

namespace glissade::contact {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using geometry::TriangleMesh;
using test_support::kBoxSize;
using test_support::pose;
using test_support::turn_from_to;

constexpr unsigned kSlidingSeed = 29;
constexpr std::int64_t kFinelyCut = test_support::kSanitized ? 240 : 1200;

/// How finely the faces are cut, and whether their triangles are turned at random.
struct Tessellation {
  std::int64_t triangles;
  bool flipped;

  friend void PrintTo(const Tessellation& tessellation, std::ostream* out) {
    *out << tessellation.triangles << (tessellation.flipped ? "Flipped" : "");
  }
};

std::vector<Obstacle> obstacle_of(const std::vector<geometry::TriangleMesh>& meshes, const Tessellation& tessellation) {
  geometry::TriangleMesh mesh = geometry::merge(meshes);
  if (tessellation.flipped) mesh = geometry::flip_randomly(mesh, 17);
  return {{std::make_shared<ContactBody>(std::make_shared<geometry::TriangleMesh>(std::move(mesh)))}};
}

std::shared_ptr<const SlidingPart> box_part(const Tessellation& tessellation) {
  geometry::TriangleMesh mesh = geometry::make_box(kBoxSize, tessellation.triangles);
  if (tessellation.flipped) mesh = geometry::flip_randomly(mesh, 18);
  return std::make_shared<SlidingPart>(std::make_shared<geometry::TriangleMesh>(std::move(mesh)));
}

/// A square sheet of 0.5 m through the origin, with the given normal.
geometry::TriangleMesh sheet(const Vector3d& normal, const Tessellation& tessellation) {
  const Vector3d axis = Vector3d::UnitZ().cross(normal);
  Isometry3d X = Isometry3d::Identity();
  if (!axis.isZero()) X.linear() = Eigen::AngleAxisd(std::acos(normal.z()), axis.normalized()).toRotationMatrix();
  return geometry::transformed(geometry::make_plate({0.5, 0.5}, tessellation.triangles), X);
}

/// Leads the ghost in a straight line through some calls, and lets `check` see every one of them.
template <typename Check>
void lead(Sliding& sliding, const Isometry3d& X_WG_to, int calls, const Check& check, double milliseconds = 1.0) {
  const Isometry3d X_WG_from = sliding.result().X_WG;
  const Eigen::Quaterniond q_from(X_WG_from.linear());
  for (int i = 1; i <= calls; ++i) {
    const double t = static_cast<double>(i) / calls;
    const Vector3d p = (1.0 - t) * X_WG_from.translation() + t * X_WG_to.translation();
    check(sliding.advance(pose(p, q_from.slerp(t, Eigen::Quaterniond(X_WG_to.linear()))), milliseconds));
  }
}

class BoxOnFaces : public ::testing::TestWithParam<Tessellation> {
 protected:
  const Tessellation& tessellation() const { return GetParam(); }
};

TEST_P(BoxOnFaces, PressedOnAPlaneItFollowsTheGhostAlongIt) {
  Sliding sliding(obstacle_of({sheet(Vector3d::UnitZ(), tessellation())}, tessellation()), box_part(tessellation()),
                  pose({-0.1, 0.0, 0.03}));
  lead(sliding, pose({-0.1, 0.0, 0.017}), 200, [](const SlidingResult&) {});  // 3 mm into the plane
  lead(sliding, pose({0.1, 0.05, 0.017}), 500, [&](const SlidingResult& result) {
    Vector3d optimum = result.X_WG.translation();
    optimum.z() = 0.5 * kBoxSize.z();
    ASSERT_LT((result.X_WV.translation() - optimum).norm(), 2.0 * sliding.margin());
    ASSERT_LT(Eigen::AngleAxisd(result.X_WV.linear()).angle(), 1e-4);
  });
}

TEST_P(BoxOnFaces, PressedIntoAGrooveItFollowsTheGhostAlongIt) {
  const Vector3d left = Vector3d(1.0, 0.0, 1.0).normalized();
  const Vector3d right = Vector3d(-1.0, 0.0, 1.0).normalized();
  const Eigen::Quaterniond q_45(Eigen::AngleAxisd(std::numbers::pi / 4, Vector3d::UnitY()));
  // With two faces flush in the groove, the box's centre is half its height and half its length away from its sides.
  const Vector3d seat = 0.5 * kBoxSize.z() * left + 0.5 * kBoxSize.x() * right;
  const auto along = [&](double y) { return Vector3d(seat.x(), y, seat.z()); };
  Sliding sliding(obstacle_of({sheet(left, tessellation()), sheet(right, tessellation())}, tessellation()),
                  box_part(tessellation()), pose(along(-0.1) + Vector3d(0, 0, 0.01), q_45));
  lead(sliding, pose(along(-0.1) + Vector3d(0.001, 0, -0.003), q_45), 200, [](const SlidingResult&) {});
  lead(sliding, pose(along(0.1) + Vector3d(0.001, 0, -0.003), q_45), 500, [&](const SlidingResult& result) {
    const Vector3d optimum = along(result.X_WG.translation().y());
    ASSERT_LT((result.X_WV.translation() - optimum).norm(), 2.0 * sliding.margin());
  });
}

TEST_P(BoxOnFaces, PressedIntoACornerItStopsThere) {
  Sliding sliding(obstacle_of({sheet(Vector3d::UnitX(), tessellation()), sheet(Vector3d::UnitY(), tessellation()),
                               sheet(Vector3d::UnitZ(), tessellation())},
                              tessellation()),
                  box_part(tessellation()), pose({0.06, 0.04, 0.03}));
  const Vector3d seat = 0.5 * kBoxSize;
  lead(sliding, pose(seat - Vector3d(2e-3, 3e-3, 4e-3)), 200, [](const SlidingResult&) {});
  lead(sliding, pose(seat - Vector3d(4e-3, 2e-3, 1e-3)), 200, [&](const SlidingResult& result) {
    ASSERT_LT((result.X_WV.translation() - seat).norm(), 2.0 * sliding.margin());
    ASSERT_LT(Eigen::AngleAxisd(result.X_WV.linear()).angle(), 1e-4);
    const Wrench wrench = spring_wrench(
        sliding.stiffness(), geometry::displacement_between(result.X_WV, result.X_WG, sliding.part().p_Vref()));
    // The springs of the three axes, each shortened by the margin at most.
    const Vector3d expected = sliding.stiffness().translational * (seat - result.X_WG.translation());
    ASSERT_LT((wrench.f - expected).norm(), sliding.stiffness().translational * 2.0 * sliding.margin());
  });
}

TEST_P(BoxOnFaces, ObstaclesMayShareABodyAndLieAnywhere) {
  // The corner of before, of one sheet in three poses, and the same sheet once more out of reach.
  geometry::TriangleMesh mesh = geometry::make_plate({0.5, 0.5}, tessellation().triangles);
  if (tessellation().flipped) mesh = geometry::flip_randomly(mesh, 17);
  const auto sheet_O = std::make_shared<ContactBody>(std::make_shared<geometry::TriangleMesh>(std::move(mesh)));
  const auto facing = [](const Vector3d& normal) {
    return pose(Vector3d::Zero(), turn_from_to(Vector3d::UnitZ(), normal));
  };
  const std::vector<Obstacle> obstacles{{sheet_O, pose({0.0, 0.0, -1.0})},
                                        {sheet_O, facing(Vector3d::UnitX())},
                                        {sheet_O, facing(Vector3d::UnitY())},
                                        {sheet_O, facing(-Vector3d::UnitZ())}};
  Sliding sliding(obstacles, box_part(tessellation()), pose({0.06, 0.04, 0.03}));
  const Vector3d seat = 0.5 * kBoxSize;
  lead(sliding, pose(seat - Vector3d(2e-3, 3e-3, 4e-3)), 200, [](const SlidingResult&) {});
  EXPECT_LT((sliding.result().X_WV.translation() - seat).norm(), 2.0 * sliding.margin());
  std::vector<bool> pushes(obstacles.size(), false);
  for (const Contact& contact : sliding.result().contacts) {
    const auto number = static_cast<std::size_t>(contact.obstacle);
    const Vector3d normal = obstacles[number].X_WO.linear().col(2);
    EXPECT_GT(std::abs(normal.dot(contact.n_W)), 0.999) << "the normal is that of the obstacle named";
    if (contact.force > 0.0) pushes[number] = true;
  }
  EXPECT_EQ(pushes, (std::vector<bool>{false, true, true, true}));
}

TEST_P(BoxOnFaces, TheWrenchIsExactlyZeroWheneverNothingIsInTheWay) {
  Sliding sliding(obstacle_of({sheet(Vector3d::UnitZ(), tessellation())}, tessellation()), box_part(tessellation()),
                  pose({-0.1, 0.0, 0.03}));
  const auto no_wrench = [&](const SlidingResult& result) {
    const Wrench wrench = spring_wrench(
        sliding.stiffness(), geometry::displacement_between(result.X_WV, result.X_WG, sliding.part().p_Vref()));
    ASSERT_EQ(result.state, SlidingState::kFree);
    ASSERT_EQ(wrench.f, Vector3d::Zero());
    ASSERT_EQ(wrench.t, Vector3d::Zero());
  };
  const Eigen::Quaterniond q_tilted(Eigen::AngleAxisd(0.4, Vector3d(1.0, 2.0, 3.0).normalized()));
  lead(sliding, pose({0.1, 0.02, 0.06}, q_tilted), 300, no_wrench);
  lead(sliding, pose({0.0, 0.0, 0.03}), 300, no_wrench);
  lead(sliding, pose({0.0, 0.0, 0.01}), 100, [](const SlidingResult&) {});
  EXPECT_EQ(sliding.result().state, SlidingState::kResting);
  lead(sliding, pose({0.0, 0.0, 0.03}), 300, [](const SlidingResult&) {});
  lead(sliding, pose({0.02, 0.0, 0.03}), 10, no_wrench);
}

INSTANTIATE_TEST_SUITE_P(Tessellations, BoxOnFaces,
                         ::testing::Values(Tessellation{12, false}, Tessellation{kFinelyCut, false},
                                           Tessellation{kFinelyCut, true}),
                         ::testing::PrintToStringParamName());

TEST(Sliding, AThinSheetAtFiveMetresPerSecondIsNeverCrossed) {
  const Tessellation tessellation{400, true};
  const auto obstacle = obstacle_of({sheet(Vector3d::UnitZ(), tessellation)}, tessellation);
  geometry::TriangleMesh plate = geometry::flip_randomly(geometry::make_plate({0.1, 0.06}, 200), 3);
  const auto part = std::make_shared<SlidingPart>(std::make_shared<geometry::TriangleMesh>(std::move(plate)));
  for (const Metaphor metaphor : {Metaphor::kForceFeedback, Metaphor::kRubberBandSpring}) {
    for (const double side : {1.0, -1.0}) {
      for (const double tilt : {0.0, 0.02, 0.7, std::numbers::pi / 2}) {
        if (test_support::kSanitized && tilt > 0.02) continue;
        const Eigen::Quaterniond q(Eigen::AngleAxisd(tilt, Vector3d::UnitX()));
        Sliding sliding(obstacle, part, pose({0.0, 0.0, 0.1 * side}, q), {.metaphor = metaphor});
        lead(sliding, pose({0.01, 0.02, -0.3 * side}, q), 80, [&](const SlidingResult& result) {
          for (const Vector3d& x_V : part->tree.mesh().vertices)
            ASSERT_GT(side * (result.X_WV * x_V).z(), 0.0);
        });
        EXPECT_NE(sliding.result().state, SlidingState::kFree);
        EXPECT_GT(sliding.result().pushing, 0);
      }
    }
  }
}

/// By how much the part's lag changes in one call, beyond the ghost's own motion, when a box that is pressed 5 mm too
/// deep is drawn over the rim of a plate and snaps off it. Each metre is 1000 N of force.
double greatest_catch_up(Metaphor metaphor, double milliseconds = 1.0) {
  const Tessellation tessellation{12, false};
  const auto plate =
      std::make_shared<ContactBody>(std::make_shared<geometry::TriangleMesh>(geometry::make_plate({0.2, 0.2}, 100)));
  Sliding sliding({{plate}}, box_part(tessellation), pose({0.0, 0.0, 0.03}), {.metaphor = metaphor});
  lead(sliding, pose({0.0, 0.0, 0.015}), 200, [](const SlidingResult&) {});
  double greatest = 0.0;
  Isometry3d X_WG = sliding.result().X_WG;
  geometry::Displacement lag = sliding.lag();
  lead(
      sliding, pose({0.17, 0.0, 0.015}), 500,
      [&](const SlidingResult& result) {
        const Vector3d& p_Vref = sliding.part().p_Vref();
        const double radius = sliding.part().radius();
        const double ghost = geometry::motion_bound(geometry::displacement_between(X_WG, result.X_WG, p_Vref), radius);
        const geometry::Displacement now = sliding.lag();
        greatest = std::max(greatest, (now.v - lag.v).norm() + radius * (now.w - lag.w).norm() - ghost);
        X_WG = result.X_WG;
        lag = now;
      },
      milliseconds);
  EXPECT_EQ(sliding.result().state, SlidingState::kFree);  // it has left the plate
  return greatest;
}

TEST(Sliding, UnderForceFeedbackThePartCatchesUpNoFasterThanTheSlew) {
  EXPECT_LE(greatest_catch_up(Metaphor::kForceFeedback), kSlew_m * (1.0 + 1e-9));
}

TEST(Sliding, LateCallCatchesUpForItsElapsedTime) {
  const double catch_up = greatest_catch_up(Metaphor::kForceFeedback, 3.0);
  EXPECT_LE(catch_up, 3.0 * kSlew_m * (1.0 + 1e-9));
  EXPECT_GT(catch_up, 2.0 * kSlew_m);
}

TEST(Sliding, OnARubberBandThePartCatchesUpAtOnce) {
  EXPECT_GT(greatest_catch_up(Metaphor::kRubberBandSpring), 2.0 * kSlew_m);
}

TEST(Sliding, AGhostThatTurnsFarInOneCallDoesNotCarryThePartThroughAWall) {
  // A rod beside a wall, 4 mm away; its ends would sweep through.
  Isometry3d X_wall = Isometry3d::Identity();
  X_wall.linear() = Eigen::AngleAxisd(std::numbers::pi / 2, Vector3d::UnitX()).toRotationMatrix();
  X_wall.translation().y() = 9e-3;
  const auto wall = std::make_shared<ContactBody>(
      std::make_shared<geometry::TriangleMesh>(geometry::transformed(geometry::make_plate({0.3, 0.3}, 2), X_wall)));
  const auto rod = std::make_shared<SlidingPart>(
      std::make_shared<geometry::TriangleMesh>(geometry::make_box({0.2, 0.01, 0.01}, 12)));
  for (const Metaphor metaphor : {Metaphor::kForceFeedback, Metaphor::kRubberBandSpring}) {
    for (const double angle : {0.3, 1.5, 3.0}) {
      Sliding sliding({{wall}}, rod, Isometry3d::Identity(), {.metaphor = metaphor});
      const Isometry3d X_WG(Eigen::AngleAxisd(angle, Vector3d::UnitZ()));
      bool touched = false;
      for (int i = 0; i < 50; ++i) {
        touched = sliding.advance(X_WG).pushing > 0 || touched;
        for (const Vector3d& x_V : rod->tree.mesh().vertices)
          ASSERT_LT((sliding.result().X_WV * x_V).y(), 9e-3);
      }
      EXPECT_TRUE(touched);
    }
  }
}

TEST(Sliding, AGhostThatJumpsOutOfANarrowSlotLeavesThePartInside) {
  // A plate-like box between two oblique sheets with half a margin of room on each side.
  const Eigen::Quaterniond q(Eigen::AngleAxisd(0.7, Vector3d(1.0, 2.0, 0.5).normalized()));
  const Vector3d normal = q * Vector3d::UnitZ();
  const Vector3d middle(0.6, -0.4, 0.8);
  constexpr double kHalfSlot = 2e-3 + 3e-6;
  const geometry::TriangleMesh plate = geometry::make_plate({0.5, 0.5}, 2);
  const auto slot = obstacle_of({geometry::transformed(plate, pose(middle + kHalfSlot * normal, q)),
                                 geometry::transformed(plate, pose(middle - kHalfSlot * normal, q))},
                                {2, false});
  const auto part = std::make_shared<SlidingPart>(
      std::make_shared<geometry::TriangleMesh>(geometry::make_box({0.1, 0.06, 0.004}, 12)));
  std::mt19937 generator(kSlidingSeed);
  SCOPED_TRACE("seed " + std::to_string(kSlidingSeed));
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto random_vector = [&] { return Vector3d(uniform(generator), uniform(generator), uniform(generator)); };
  for (const Metaphor metaphor : {Metaphor::kForceFeedback, Metaphor::kRubberBandSpring}) {
    for (int trial = 0; trial < 10; ++trial) {
      Sliding sliding(slot, part, pose(middle, q), {.metaphor = metaphor});
      const double distance = trial == 0 ? 1e6 : 0.3;
      const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.3, random_vector().normalized()));
      for (int i = 0; i < 5; ++i) {
        sliding.advance(pose(middle + distance * random_vector(), turn * q));
        for (const Vector3d& x_V : part->tree.mesh().vertices) {
          ASSERT_LT(std::abs(normal.dot(sliding.result().X_WV * x_V - middle)), kHalfSlot);
        }
      }
    }
  }
}

TEST(Sliding, AGhostThatIsNotFiniteChangesNothing) {
  const Tessellation tessellation{12, false};
  const auto obstacle = obstacle_of({sheet(Vector3d::UnitZ(), tessellation)}, tessellation);
  Sliding sliding(obstacle, box_part(tessellation), pose({0.0, 0.0, 0.03}));
  const Isometry3d X_WV = sliding.advance(pose({0.001, 0.0, 0.03})).X_WV;
  EXPECT_EQ(sliding.advance(pose({0.0, 0.0, std::numeric_limits<double>::quiet_NaN()})).X_WV.matrix(), X_WV.matrix());
  EXPECT_EQ(sliding.advance(pose({0.002, 0.0, 0.03})).X_WV.translation().x(), 0.002);
}

TEST(Sliding, WillNotStartInsideAnything) {
  const Tessellation tessellation{12, false};
  const auto obstacle = obstacle_of({sheet(Vector3d::UnitZ(), tessellation)}, tessellation);
  EXPECT_THROW(Sliding(obstacle, box_part(tessellation), pose({0.0, 0.0, 0.01})), std::invalid_argument);
  EXPECT_THROW(Sliding({}, box_part(tessellation), pose({0.0, 0.0, 0.01})), std::invalid_argument)
      << "nothing to touch";
}

TEST(Sliding, TheSameGhostGivesTheSameBits) {
  const Tessellation tessellation{1200, true};
  const auto obstacle =
      obstacle_of({sheet(Vector3d::UnitZ(), tessellation), sheet(Vector3d::UnitX(), tessellation)}, tessellation);
  const auto part = box_part(tessellation);
  const auto run = [&] {
    std::vector<Eigen::Matrix4d> poses;
    Sliding sliding(obstacle, part, pose({0.1, 0.0, 0.03}));
    lead(sliding, pose({0.03, 0.02, 0.01}, Eigen::Quaterniond(Eigen::AngleAxisd(0.3, Vector3d::UnitY()))), 200,
         [&](const SlidingResult& result) { poses.push_back(result.X_WV.matrix()); });
    return poses;
  };
  EXPECT_EQ(run(), run());
}

}  // namespace
}  // namespace glissade::contact
