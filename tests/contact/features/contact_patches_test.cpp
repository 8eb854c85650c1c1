// Contacts merged for display: how many arrows a person would draw.

#include <algorithm>
#include <memory>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/contact/sliding.h>
#include <glissade/contact/tracked_contacts.h>
#include <glissade/geometry/mesh_generators.h>
#include <glissade/geometry/triangle_mesh.h>

#include "poses.h"

namespace glissade::contact {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using geometry::TriangleMesh;
using test_support::pose;
using test_support::turn_from_to;

constexpr unsigned kPatchesSeed = 43;

TrackedContact contact(std::int64_t id, const Vector3d& p_W, const Vector3d& n_W, double force = 0.0) {
  return {id, 0, {ContactKind::kVertexFace, 0, 0, 0, n_W, p_W, 5e-6, force, 0, 0}};
}

TEST(ContactPatches, CoplanarContactsFormOnePatch) {
  std::vector<TrackedContact> contacts{contact(4, {0, 0, 0}, Vector3d::UnitZ(), 1.0),
                                       contact(7, {0.1, 0, 0}, Vector3d::UnitZ(), 3.0)};
  contacts[1].contact.friction_W = Vector3d(0.5, 0, 0);
  ContactPatches patches(0.1);
  const auto merged = patches.merge(contacts);
  ASSERT_EQ(merged.size(), 1u);
  EXPECT_EQ(merged[0].id, 4);
  EXPECT_EQ(merged[0].count, 2);
  EXPECT_TRUE(merged[0].p_W.isApprox(Vector3d(0.075, 0, 0)));  // nearer to the one that pushes more
  EXPECT_TRUE(merged[0].force_on_part_W.isApprox(Vector3d(0.5, 0, 4.0)));
  EXPECT_NEAR(merged[0].extent, 0.075, 1e-15);
}

TEST(ContactPatches, WhereNothingPushesTheCentreIsTheMeanPoint) {
  const std::vector<TrackedContact> contacts{contact(1, {0, 0, 0}, Vector3d::UnitZ()),
                                             contact(2, {0.1, 0, 0}, Vector3d::UnitZ())};
  ContactPatches patches(0.1);
  EXPECT_TRUE(patches.merge(contacts)[0].p_W.isApprox(Vector3d(0.05, 0, 0)));
}

TEST(ContactPatches, AStepASlopeAndAnotherObstacleArePatchesOfTheirOwn) {
  const double angle = 11.0 * std::numbers::pi / 180.0;
  std::vector<TrackedContact> contacts{contact(1, {0, 0, 0}, Vector3d::UnitZ()),
                                       contact(2, {0.1, 0, 2e-3}, Vector3d::UnitZ()),  // 2 % of the part's radius
                                       contact(3, {0, 0, 0}, {std::sin(angle), 0.0, std::cos(angle)}),
                                       contact(4, {0, 0, 0}, Vector3d::UnitZ())};
  contacts[3].contact.obstacle = 1;
  ContactPatches patches(0.1);
  EXPECT_EQ(patches.merge(contacts).size(), 4u);
}

TEST(ContactPatches, IndependentOfContactOrder) {
  RecordProperty("seed", static_cast<int>(kPatchesSeed));
  SCOPED_TRACE("seed " + std::to_string(kPatchesSeed));
  std::mt19937 random(kPatchesSeed);
  std::uniform_real_distribution<double> coordinate(-0.05, 0.05);
  std::vector<TrackedContact> contacts;
  for (int i = 0; i < 60; ++i) {
    const Vector3d n_W = Vector3d(coordinate(random), coordinate(random), 0.1).normalized();
    contacts.push_back(contact(100 - i, {coordinate(random), coordinate(random), 1e-2 * coordinate(random)}, n_W, 1.0));
  }
  ContactPatches patches(0.1);
  const auto first = patches.merge(contacts);
  const std::vector<ContactPatch> expected(first.begin(), first.end());
  ASSERT_GT(expected.size(), 3u);
  for (int trial = 0; trial < 20; ++trial) {
    std::shuffle(contacts.begin(), contacts.end(), random);
    const auto merged = patches.merge(contacts);
    ASSERT_EQ(merged.size(), expected.size());
    for (std::size_t i = 0; i < merged.size(); ++i) {
      ASSERT_EQ(merged[i].id, expected[i].id);
      ASSERT_EQ(merged[i].count, expected[i].count);
      ASSERT_TRUE(merged[i].p_W.isApprox(expected[i].p_W, 1e-12));
    }
  }
}

/// The patches of a part that is led from one pose to another in 0.3 s and pressed there for 0.1 s.
std::vector<ContactPatch> patches_after(const std::vector<geometry::TriangleMesh>& obstacles,
                                        const geometry::TriangleMesh& part, const Isometry3d& X_WG_from,
                                        const Isometry3d& X_WG_to) {
  std::vector<Obstacle> bodies;
  for (const geometry::TriangleMesh& mesh : obstacles)
    bodies.push_back({std::make_shared<ContactBody>(std::make_shared<geometry::TriangleMesh>(mesh))});
  Sliding sliding(bodies, std::make_shared<SlidingPart>(std::make_shared<geometry::TriangleMesh>(part)), X_WG_from);
  ContactTracker tracker(sliding.margin());
  const Eigen::Quaterniond q_from(X_WG_from.linear());
  for (int i = 0; i <= 400; ++i) {
    const double t = std::min(1.0, i / 300.0);
    Isometry3d X_WG(q_from.slerp(t, Eigen::Quaterniond(X_WG_to.linear())));
    X_WG.translation() = (1.0 - t) * X_WG_from.translation() + t * X_WG_to.translation();
    tracker.update(sliding.advance(X_WG));
  }
  ContactPatches patches(sliding.part().radius());
  const auto merged = patches.merge(tracker.contacts());
  return {merged.begin(), merged.end()};
}

geometry::TriangleMesh sheet(const Vector3d& normal) {
  return geometry::transformed(geometry::make_plate({0.5, 0.5}, 5000),
                               pose(Vector3d::Zero(), turn_from_to(Vector3d::UnitZ(), normal)));
}

TEST(ContactPatches, AFinelyCutBoxOnAFinelyCutPlaneIsOnePatch) {
  const auto patches = patches_after({sheet(Vector3d::UnitZ())}, geometry::make_box({0.1, 0.06, 0.04}, 1200),
                                     pose({0, 0, 0.025}), pose({0.01, 0.02, 0.017}));
  ASSERT_EQ(patches.size(), 1u);
  EXPECT_GE(patches[0].count, 4);
  EXPECT_TRUE(patches[0].n_W.isApprox(Vector3d::UnitZ(), 1e-3));
  // The spring's 3 mm at 1000 N/m, in the middle.
  EXPECT_NEAR(patches[0].force_on_part_W.z(), 3.0, 0.02);
  EXPECT_LT((patches[0].p_W - Vector3d(0.01, 0.02, 0.0)).norm(), 1e-3);
  EXPECT_NEAR(patches[0].extent, Vector3d(0.05, 0.03, 0).norm(), 1e-3);
}

TEST(ContactPatches, BoxInAGrooveHasTwoPatches) {
  const Vector3d left = Vector3d(1.0, 0.0, 1.0).normalized();
  const Vector3d right = Vector3d(-1.0, 0.0, 1.0).normalized();
  const Eigen::Quaterniond q_45(Eigen::AngleAxisd(std::numbers::pi / 4, Vector3d::UnitY()));
  const Vector3d seat = 0.02 * left + 0.05 * right;
  const auto patches =
      patches_after({sheet(left), sheet(right)}, geometry::make_box({0.1, 0.06, 0.04}, 1200),
                    pose(seat + Vector3d(0, 0, 0.01), q_45), pose(seat + Vector3d(0.0, 0.01, -0.003), q_45));
  ASSERT_EQ(patches.size(), 2u);
  EXPECT_TRUE(patches[0].n_W.isApprox(left, 1e-3) || patches[1].n_W.isApprox(left, 1e-3));
}

TEST(ContactPatches, TiltedPegInAHoleHasTwoToEightPatches) {
  // A peg of 8 mm in a tube with 50 µm of play, tilted as far as that lets it.
  const std::vector<Eigen::Vector2d> profile{{0.0, -0.01}, {0.00795, -0.01}, {0.00795, 0.01}, {0.0, 0.01}};
  const geometry::TriangleMesh peg = geometry::make_revolution(profile, false, 48);
  const Eigen::Quaterniond q_tilted(Eigen::AngleAxisd(0.03, Vector3d::UnitX()));
  const auto patches = patches_after({geometry::make_tube(0.008, 0.03, 2000)}, peg, pose(Vector3d::Zero()),
                                     pose({0, 0, 0.001}, q_tilted));
  EXPECT_GE(patches.size(), 2u);
  EXPECT_LE(patches.size(), 8u);
}

}  // namespace
}  // namespace glissade::contact
