// First contacts of motions whose time has a closed form, and motions without a contact.

#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/collision/dop_query.h>
#include <glissade/geometry/mesh_generators.h>

#include "poses.h"
#include "trees.h"

namespace glissade::collision {
namespace {

using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Translation3d;
using Eigen::Vector3d;
using test_support::at;
using test_support::tree_of;

constexpr double kTolerance = 1e-6;
constexpr double kPi = std::numbers::pi;

DopTree cube() {
  return tree_of(geometry::make_box({1.0, 1.0, 1.0}, 12));
}

/// A triangle in the plane z = 0 with corners (0, 0), (1, 0) and (0, 1).
DopTree triangle() {
  return tree_of({{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}}, {{0, 1, 2}}});
}

TEST(FirstContact, CubesThatMeetFaceToFace) {
  const std::optional<FirstContact> contact = first_contact(cube(), cube(), {at(3, 0, 0), at(-1, 0, 0)}, kTolerance);
  ASSERT_TRUE(contact);
  EXPECT_NEAR(contact->t, 0.5, kTolerance / 4.0) << "a gap of 2 m, and a way of 4 m";
  EXPECT_LE(contact->t, 0.5);
  EXPECT_LE(contact->close.distance, kTolerance);
  EXPECT_GT(contact->close.distance, kTolerance / 2.0);
  EXPECT_NEAR(contact->close.p_A.x(), 0.5, 1e-12);
  EXPECT_NEAR(contact->close.p_B.x(), 0.5, kTolerance);
}

/// Both poses at the ends are free.
TEST(FirstContact, NoSheetIsPassed) {
  const DopTree sheet = tree_of(geometry::make_plate({1.0, 1.0}, 2));
  const DopTree ball = tree_of(geometry::make_sphere(1e-3, 200));
  const std::optional<FirstContact> contact = first_contact(sheet, ball, {at(0.2, 0.1, 500.0), at(0.2, 0.1, -500.0)});
  ASSERT_TRUE(contact);
  EXPECT_NEAR(contact->t, 0.5 - 1e-6, 1e-7) << "the ball of 1 mm is as far away as its radius";
}

/// A rod of 1 m along x turns about its end until it meets a rod across at 30°.
TEST(FirstContact, ARodThatTurns) {
  const DopTree rod = tree_of({{{0.0, 0.0, -1e-3}, {1.0, 0.0, 0.0}, {0.0, 0.0, 1e-3}}, {{0, 1, 2}}});
  const Vector3d p(0.9 * std::cos(kPi / 6.0), 0.9 * std::sin(kPi / 6.0), 0.0);
  const DopTree post = tree_of({{p, p + Vector3d(0.1, 0.1, 0.0), p + Vector3d(0.1, 0.1, 0.5)}, {{0, 1, 2}}});
  RigidMotion motion;
  motion.X_AB_end.linear() = AngleAxisd(kPi / 2.0, Vector3d::UnitZ()).toRotationMatrix();
  const std::optional<FirstContact> contact = first_contact(post, rod, motion, kTolerance);
  ASSERT_TRUE(contact);
  EXPECT_NEAR(contact->t, 1.0 / 3.0, kTolerance);
  EXPECT_LE(contact->t, 1.0 / 3.0);
}

/// A corner on a circle about the reference point touches a plane only if the circle reaches it.
TEST(FirstContact, AGrazingCornerMeetsOrPasses) {
  const DopTree floor = tree_of({{{-5.0, -5.0, 0.0}, {5.0, -5.0, 0.0}, {0.0, 9.0, 0.0}}, {{0, 1, 2}}});
  const DopTree blade = tree_of({{{1.0, 0.0, 0.0}, {0.5, 0.0, 0.1}, {0.5, 0.1, 0.1}}, {{0, 1, 2}}});
  const auto contact_at_height = [&](double height) {
    RigidMotion motion{at(0.0, 0.0, height), at(0.0, 0.0, height)};
    motion.X_AB_end.linear() = AngleAxisd(0.9 * kPi, Vector3d::UnitY()).toRotationMatrix();
    return first_contact(floor, blade, motion, kTolerance);
  };
  const std::optional<FirstContact> lowest = contact_at_height(1.0 + 0.4e-6);
  ASSERT_TRUE(lowest);
  EXPECT_NEAR(lowest->t, 0.5 / 0.9, 1e-3) << "when the corner is lowest";
  EXPECT_FALSE(contact_at_height(1.0 + 1.1e-6));
}

TEST(FirstContact, WithoutMotionOnlyTheBeginCounts) {
  EXPECT_FALSE(first_contact(cube(), cube(), {at(2, 0, 0), at(2, 0, 0)}));
  const std::optional<FirstContact> contact = first_contact(cube(), cube(), {at(0.9, 0, 0), at(0.9, 0, 0)});
  ASSERT_TRUE(contact);
  EXPECT_EQ(contact->t, 0.0);
  EXPECT_EQ(contact->close.distance, 0.0);
}

TEST(FirstContact, PartsThatMoveApartHaveNone) {
  EXPECT_FALSE(first_contact(cube(), cube(), {at(1.00001, 0, 0), at(3, 0, 0)}));
  const std::optional<FirstContact> sliding = first_contact(triangle(), triangle(), {at(0, 0, 2e-6), at(1, 1, 2e-6)});
  EXPECT_FALSE(sliding) << "the triangles slide past each other, twice the tolerance apart";
}

TEST(FirstContact, AMotionGoesThroughItsEnds) {
  RigidMotion motion{at(1, 2, 3), at(-1, 0, 2), Vector3d(0.5, 0.1, -0.2)};
  motion.X_AB_begin.linear() = AngleAxisd(0.3, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  motion.X_AB_end.linear() = AngleAxisd(2.9, Vector3d(-1, 1, 2).normalized()).toRotationMatrix();
  EXPECT_LT((motion.X_AB(0.0).matrix() - motion.X_AB_begin.matrix()).norm(), 1e-14);
  EXPECT_LT((motion.X_AB(1.0).matrix() - motion.X_AB_end.matrix()).norm(), 1e-14);
  const Vector3d middle = 0.5 * (motion.X_AB_begin * motion.p_Bref + motion.X_AB_end * motion.p_Bref);
  EXPECT_LT((motion.X_AB(0.5) * motion.p_Bref - middle).norm(), 1e-14);
}

TEST(FirstContact, BadMotionsAndTolerancesAreRefused) {
  const RigidMotion motion{at(3, 0, 0), at(2, 0, 0)};
  EXPECT_THROW(first_contact(cube(), cube(), motion, 0.0), std::invalid_argument);
  EXPECT_THROW(first_contact(cube(), cube(), motion, 1e-15), std::invalid_argument);
  EXPECT_THROW(first_contact(cube(), cube(), motion, std::nan("")), std::invalid_argument);
  EXPECT_NO_THROW(first_contact(cube(), cube(), motion, 1e-11));
  RigidMotion scaled = motion;
  scaled.X_AB_end.linear() *= 1.0 + 1e-6;
  EXPECT_THROW(first_contact(cube(), cube(), scaled), std::invalid_argument);
  RigidMotion nowhere = motion;
  nowhere.X_AB_end.translation().x() = std::nan("");
  EXPECT_THROW(first_contact(cube(), cube(), nowhere), std::invalid_argument);
  nowhere = motion;
  nowhere.p_Bref.x() = std::nan("");
  EXPECT_THROW(first_contact(cube(), cube(), nowhere), std::invalid_argument);
}

/// The boxes of a tree belong to its fit.
TEST(FirstContact, ARefittedTreeHasNewBoxes) {
  const auto mesh = std::make_shared<geometry::TriangleMesh>(geometry::make_box({1.0, 1.0, 1.0}, 12));
  DopTree moved(mesh);
  const DopTree copy = moved;
  EXPECT_EQ(moved.obb_tree(), moved.obb_tree());
  EXPECT_NE(copy.obb_tree(), moved.obb_tree()) << "the copy was made before";
  EXPECT_EQ(DopTree(moved).obb_tree(), moved.obb_tree());
  for (Vector3d& vertex : mesh->vertices)
    vertex.x() += 0.5;
  moved.refit();
  const std::optional<FirstContact> contact = first_contact(cube(), moved, {at(3, 0, 0), at(-1, 0, 0)});
  ASSERT_TRUE(contact);
  EXPECT_NEAR(contact->t, 2.5 / 4.0, 1e-6);
}

TEST(FirstContact, ThreadsShareTheBoxes) {
  const DopTree tree = tree_of(geometry::make_sphere(0.5, 5000));
  std::vector<std::thread> threads;
  std::vector<double> times(4);
  for (std::size_t i = 0; i < times.size(); ++i) {
    threads.emplace_back([&, i] { times[i] = first_contact(tree, tree, {at(3, 0, 0), at(-1, 0, 0)})->t; });
  }
  for (std::thread& thread : threads)
    thread.join();
  EXPECT_EQ(times, std::vector<double>(times.size(), times[0]));
}

}  // namespace
}  // namespace glissade::collision
