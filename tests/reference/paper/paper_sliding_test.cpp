// The founding paper's sliding method: what it does well, and the states it goes through.

#include "paper/paper_sliding.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/contact/spring.h>
#include <glissade/contact/tracked_contacts.h>
#include <glissade/geometry/mesh_generators.h>
#include <glissade/geometry/triangle_mesh.h>
#include <glissade/reference/brute_force.h>

#include "held_part.h"
#include "poses.h"
#include "sanitizers.h"

namespace glissade::reference {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using geometry::TriangleMesh;
using enum PaperState;
using test_support::kBoxSize;
using test_support::obstacle_of;
using test_support::part_of;
using test_support::pose;
using test_support::turn_from_to;

constexpr unsigned kPaperSlidingSeed = 31;

/// A sheet of two triangles through the origin with the given normal.
contact::Obstacle sheet_of_two(const Vector3d& normal) {
  return obstacle_of(geometry::make_plate({0.5, 0.5}, 2),
                     pose(Vector3d::Zero(), turn_from_to(Vector3d::UnitZ(), normal)));
}

PaperSliding box_among(const std::vector<contact::Obstacle>& obstacles, const Vector3d& start,
                       contact::Metaphor metaphor = contact::Metaphor::kForceFeedback) {
  return {obstacles, part_of(geometry::make_box(kBoxSize, 12)), pose(start), {.metaphor = metaphor}};
}

/// Leads the ghost straight and evenly turning through some calls, and lets `check` see every one of them.
void lead(
    PaperSliding& sliding, const Isometry3d& X_WG_to, int calls,
    const std::function<void(const contact::SlidingResult&)>& check = [](const contact::SlidingResult&) {}) {
  const Isometry3d X_WG_from = sliding.result().X_WG;
  const Eigen::Quaterniond q_from(X_WG_from.linear());
  for (int i = 1; i <= calls; ++i) {
    const double t = static_cast<double>(i) / calls;
    const Vector3d p = (1.0 - t) * X_WG_from.translation() + t * X_WG_to.translation();
    check(sliding.advance(pose(p, q_from.slerp(t, Eigen::Quaterniond(X_WG_to.linear())))));
  }
}

std::vector<PaperState> states_of(const PaperSliding& sliding) {
  return {sliding.states().begin(), sliding.states().end()};
}

TEST(PaperSliding, InFreeSpaceFollowsTheGhostToTheBit) {
  PaperSliding sliding = box_among({sheet_of_two(Vector3d::UnitZ())}, {0.0, 0.0, 0.1});
  lead(sliding, pose({0.05, 0.02, 0.12}, Eigen::Quaterniond(Eigen::AngleAxisd(0.5, Vector3d::UnitX()))), 100,
       [&](const contact::SlidingResult& result) {
         EXPECT_EQ(result.X_WV.matrix(), result.X_WG.matrix());
         EXPECT_EQ(result.state, contact::SlidingState::kFree);
         EXPECT_EQ(states_of(sliding), (std::vector{kMoving, kDone}));
         const contact::Wrench wrench = contact::spring_wrench(sliding.stiffness(), sliding.lag());
         EXPECT_EQ(wrench.f, Vector3d::Zero());
         EXPECT_EQ(wrench.t, Vector3d::Zero());
       });
}

TEST(PaperSliding, GoesThroughTheStatesOfThePaper) {
  PaperSliding sliding = box_among({sheet_of_two(Vector3d::UnitZ())}, {0.0, 0.0, 0.0203});
  sliding.advance(pose({0.001, 0.0, 0.017}));
  const std::vector<PaperState> states = states_of(sliding);
  const std::vector first{kMoving, kBisecting, kClassifying, kNewDirection, kCriterion, kSliding};
  ASSERT_GE(states.size(), first.size());
  EXPECT_EQ(std::vector(states.begin(), states.begin() + 6), first);
  EXPECT_EQ(std::count(states.begin(), states.end(), kDone), 1);
  EXPECT_EQ(states.back(), kDone);
  EXPECT_EQ(states[states.size() - 2], kCriterion) << "pressed on the plane, the criterion ends it";
  EXPECT_EQ(std::count(states.begin(), states.end(), kBisecting), sliding.result().cycles);
}

TEST(PaperSliding, OnAPlaneOfTwoTrianglesItFollowsTheGhostAlongIt) {
  PaperSliding sliding = box_among({sheet_of_two(Vector3d::UnitZ())}, {-0.1, 0.0, 0.03});
  lead(sliding, pose({-0.1, 0.0, 0.017}), 200);  // 3 mm into the plane
  lead(sliding, pose({0.1, 0.05, 0.017}), 500, [&](const contact::SlidingResult& result) {
    Vector3d optimum = result.X_WG.translation();
    optimum.z() = 0.5 * kBoxSize.z();
    ASSERT_LT((result.X_WV.translation() - optimum).norm(), 2.0 * sliding.bracket());
    ASSERT_GT(result.X_WV.translation().z(), optimum.z()) << "before the contact";
    ASSERT_GT(result.pushing, 0);
    // The shares of the spring along the normals are all there is: the ghost is 3 mm too deep.
    Vector3d sum = Vector3d::Zero();
    for (const contact::Contact& contact : result.contacts)
      sum += contact.force * contact.n_W;
    ASSERT_LT((sum - Vector3d(0.0, 0.0, 3.0)).norm(), 0.01);
  });
  EXPECT_EQ(sliding.result().state, contact::SlidingState::kSliding);
}

TEST(PaperSliding, TellsTheVerticesThatPressOnAPlane) {
  PaperSliding sliding = box_among({sheet_of_two(Vector3d::UnitZ())}, {0.0, 0.01, 0.03});
  lead(sliding, pose({0.0, 0.01, 0.017}), 200);
  contact::ContactTracker tracker(sliding.margin());
  std::set<std::int32_t> vertices;
  for (const contact::TrackedContact& tracked : tracker.update(sliding.result())) {
    if (tracked.contact.kind == contact::ContactKind::kVertexFace) vertices.insert(tracked.contact.part_feature);
  }
  EXPECT_EQ(vertices.size(), 4u) << "the lower corners of the box";
  for (const std::int32_t vertex : vertices)
    EXPECT_LT(sliding.part().tree.mesh().vertices[static_cast<std::size_t>(vertex)].z(), 0.0);
}

TEST(PaperSliding, InACornerItStops) {
  PaperSliding sliding =
      box_among({sheet_of_two(Vector3d::UnitX()), sheet_of_two(Vector3d::UnitY()), sheet_of_two(Vector3d::UnitZ())},
                {0.06, 0.04, 0.03});
  const Vector3d seat = 0.5 * kBoxSize;
  lead(sliding, pose(seat - Vector3d(2e-3, 3e-3, 4e-3)), 200);
  lead(sliding, pose(seat - Vector3d(2e-3, 3e-3, 4e-3)), 20);
  lead(sliding, pose(seat - Vector3d(4e-3, 2e-3, 1e-3)), 200, [&](const contact::SlidingResult& result) {
    ASSERT_LT((result.X_WV.translation() - seat).norm(), 20.0 * sliding.bracket());
  });
  EXPECT_EQ(sliding.result().state, contact::SlidingState::kResting);
}

TEST(PaperSliding, LaysATiltedBoxOnThePlane) {
  const Eigen::Quaterniond tilted(Eigen::AngleAxisd(0.05, Vector3d::UnitY()));
  PaperSliding sliding({sheet_of_two(Vector3d::UnitZ())}, part_of(geometry::make_box(kBoxSize, 12)),
                       pose({0.0, 0.0, 0.03}, tilted));
  lead(sliding, pose({0.0, 0.0, 0.019}), 300);
  lead(sliding, pose({0.0, 0.0, 0.019}), 300);
  EXPECT_NEAR(sliding.result().X_WV.translation().z(), 0.02, 20e-6);
  EXPECT_LT(Eigen::AngleAxisd(sliding.result().X_WV.linear()).angle(), 1e-3);
}

/// The ghost walks at random, up to `step` metres a call, in a box about the origin.
template <typename Check>
void random_walk(PaperSliding& sliding, double reach, double step, int calls, const Check& check) {
  std::mt19937 random(kPaperSlidingSeed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto direction = [&] { return Vector3d{uniform(random), uniform(random), uniform(random)}; };
  Vector3d p = sliding.result().X_WG.translation();
  Eigen::Quaterniond q(sliding.result().X_WG.linear());
  Vector3d heading = Vector3d::Zero();
  for (int i = 0; i < calls; ++i) {
    heading = (0.95 * heading + 0.3 * direction()).cwiseMin(1.0).cwiseMax(-1.0);
    p = (p + step * heading - 0.01 * step / reach * p).cwiseMin(reach).cwiseMax(-reach);
    q = (q * Eigen::Quaterniond(Eigen::AngleAxisd(10.0 * step * uniform(random), direction().normalized())))
            .normalized();
    check(sliding.advance(pose(p, q)));
  }
}

TEST(PaperSliding, NoVisiblePoseEverCollides) {
  RecordProperty("seed", static_cast<int>(kPaperSlidingSeed));
  const geometry::TriangleMesh clutter = geometry::flip_randomly(
      geometry::merge(std::vector{geometry::transformed(geometry::make_torus(0.06, 0.015, 200), pose({0, 0, -0.05})),
                                  geometry::transformed(geometry::make_plate({0.2, 0.2}, 8), pose({0, 0, -0.08})),
                                  geometry::transformed(geometry::make_tube(0.03, 0.08, 100), pose({0.08, 0, 0}))}),
      kPaperSlidingSeed);
  const geometry::TriangleMesh box = geometry::make_box({0.04, 0.03, 0.02}, 12);
  constexpr int kMilliseconds = test_support::kSanitized ? 500 : 1500;
  for (const contact::Metaphor metaphor : {contact::Metaphor::kForceFeedback, contact::Metaphor::kRubberBand,
                                           contact::Metaphor::kRubberBandSpring, contact::Metaphor::kIncremental}) {
    PaperSliding sliding({obstacle_of(clutter)}, part_of(box), pose({0.0, 0.0, 0.05}), {.metaphor = metaphor});
    int in_contact = 0;
    random_walk(sliding, 0.05, 2e-3, kMilliseconds, [&](const contact::SlidingResult& result) {
      ASSERT_FALSE(reference::brute_force_intersects(clutter, box, result.X_WV)) << name_of(metaphor);
      ASSERT_TRUE(result.X_WV.matrix().allFinite());
      in_contact += result.pushing > 0 ? 1 : 0;
    });
    EXPECT_GT(in_contact, kMilliseconds / 60) << name_of(metaphor) << " hardly met anything";
  }
}

TEST(PaperSliding, ASheetIsMetFromEitherSideWhateverTheOrderOfVertices) {
  for (const double side : {1.0, -1.0}) {
    const geometry::TriangleMesh plate = geometry::flip_randomly(geometry::make_plate({0.5, 0.5}, 2), 3);
    const geometry::TriangleMesh box = geometry::flip_randomly(geometry::make_box(kBoxSize, 12), 4);
    PaperSliding sliding({obstacle_of(plate)}, part_of(box), pose({0.0, 0.0, side * 0.025}));
    lead(sliding, pose({0.0, 0.0, side * 0.017}), 80);
    lead(sliding, pose({0.05, 0.05, side * 0.017}), 200, [&](const contact::SlidingResult& result) {
      ASSERT_NEAR(result.X_WV.translation().z(), side * 0.02, 2.0 * sliding.bracket());
      ASSERT_NEAR(result.X_WV.translation().x(), result.X_WG.translation().x(), 2.0 * sliding.bracket());
    });
  }
}

TEST(PaperSliding, FastPartPassesThroughAThinSheet) {
  const geometry::TriangleMesh plate = geometry::make_plate({0.1, 0.1}, 2);
  PaperSliding sliding({obstacle_of(plate)}, part_of(plate), pose({0.0, 0.0, 0.0025}));
  for (int i = 1; i <= 5; ++i)
    sliding.advance(pose({0.0, 0.0, 0.0025 - 0.005 * i}));  // 5 m/s
  EXPECT_LT(sliding.result().X_WV.translation().z(), 0.0) << "then docs/sliding.md says something wrong";
}

TEST(PaperSliding, TheSameGhostGivesTheSameBits) {
  const auto run = [] {
    PaperSliding sliding = box_among(
        {sheet_of_two(Vector3d::UnitX()), sheet_of_two(Vector3d(0.1, 0.2, 1.0).normalized())}, {0.1, 0.0, 0.08});
    std::vector<double> all;
    random_walk(sliding, 0.12, 1e-3, 300, [&](const contact::SlidingResult& result) {
      all.insert(all.end(), result.X_WV.data(), result.X_WV.data() + 16);
      for (const contact::Contact& contact : result.contacts)
        all.push_back(contact.force);
    });
    return all;
  };
  EXPECT_EQ(run(), run());
}

TEST(PaperSliding, RubberBandKeepsOrientationAndIncrementalDiscardsBlockedMotion) {
  PaperSliding band = box_among({sheet_of_two(Vector3d::UnitZ())}, {0.0, 0.0, 0.1}, contact::Metaphor::kRubberBand);
  lead(band, pose({0.05, 0.0, 0.12}, Eigen::Quaterniond(Eigen::AngleAxisd(0.5, Vector3d::UnitY()))), 50);
  EXPECT_EQ(band.result().X_WV.linear(), Eigen::Matrix3d::Identity());
  EXPECT_EQ(band.lag().v, Vector3d::Zero());

  PaperSliding incremental =
      box_among({sheet_of_two(Vector3d::UnitZ())}, {0.0, 0.0, 0.021}, contact::Metaphor::kIncremental);
  lead(incremental, pose({0.0, 0.0, 0.017}), 40);  // 1 mm to the sheet, 3 mm refused
  EXPECT_NEAR(incremental.result().X_WV.translation().z(), 0.02, 2.0 * incremental.bracket());
  lead(incremental, pose({0.02, 0.0, 0.018}), 40);  // back by 1 mm, and aside
  EXPECT_NEAR(incremental.result().X_WV.translation().z(), 0.021, 4.0 * incremental.bracket());
}

TEST(PaperSliding, ReleasedPartStaysAndRegraspIsSpeedLimited) {
  PaperSliding sliding = box_among({sheet_of_two(Vector3d::UnitZ())}, {0.0, 0.0, 0.03});
  sliding.release();
  EXPECT_EQ(sliding.advance(pose({0.05, 0.0, 0.03})).state, contact::SlidingState::kReleased);
  EXPECT_EQ(sliding.result().X_WV.matrix(), pose({0.0, 0.0, 0.03}).matrix());
  sliding.grasp(pose({0.01, 0.0, 0.03}));
  EXPECT_EQ(sliding.lag().v, Vector3d::Zero()) << "taking hold does not pull";
  EXPECT_EQ(sliding.advance(pose({0.01, 0.0, 0.03})).state, contact::SlidingState::kCatchingUp);
  EXPECT_NEAR(sliding.result().X_WV.translation().x(), 0.2e-3, 1e-12);
}

TEST(PaperSliding, RefusesACollidingStartAndAZeroBracket) {
  EXPECT_THROW(box_among({sheet_of_two(Vector3d::UnitZ())}, {0.0, 0.0, 0.01}), std::invalid_argument);
  EXPECT_THROW(box_among({}, {0.0, 0.0, 0.01}), std::invalid_argument);
  EXPECT_THROW(PaperSliding({sheet_of_two(Vector3d::UnitZ())}, part_of(geometry::make_box(kBoxSize, 12)),
                            pose({0.0, 0.0, 0.03}), {.bracket = 0.0}),
               std::invalid_argument);
}

}  // namespace
}  // namespace glissade::reference
