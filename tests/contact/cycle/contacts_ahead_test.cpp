// Contacts that the ghost will meet soon, for a haptic thread that waits for the next contact set.

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/contact/sliding.h>

#include "held_part.h"
#include "poses.h"

namespace glissade::contact {
namespace {

using Eigen::Isometry3d;
using test_support::at;

constexpr double kEdge = 0.02;
constexpr double kStep = 0.2e-3;  // metres a millisecond

/// A cube on its way to a wall, which its face meets when its centre is at x = 0.
Sliding cube_before_the_wall(double contacts_ahead_ms) {
  return Sliding({test_support::wall(0.5 * kEdge)}, test_support::cube(kEdge), at(-0.05),
                 {.rules = {.contacts_ahead_ms = contacts_ahead_ms}});
}

/// The greatest gap of a contact that the simulation reports while the cube goes from 0.05 m before the wall to 3 mm
/// into it.
double farthest_contact(double contacts_ahead_ms) {
  Sliding sliding = cube_before_the_wall(contacts_ahead_ms);
  double farthest = 0.0;
  test_support::lead(sliding, at(3e-3), 265, [&](const SlidingResult& result) {
    for (const Contact& contact : result.contacts) {
      EXPECT_LE(contact.gap, result.reach);
      farthest = std::max(farthest, contact.gap);
    }
  });
  return farthest;
}

TEST(ContactsAhead, ReachAsFarAsTheGhostGoesInTheirTime) {
  EXPECT_LT(farthest_contact(0.0), 2.0 * kStep);
  EXPECT_GT(farthest_contact(6.0), 5.0 * kStep);
  EXPECT_LT(farthest_contact(6.0), 6.5 * kStep);
}

TEST(ContactsAhead, ChangeNoPoseAndNoForce) {
  Sliding with = cube_before_the_wall(6.0);
  Sliding without = cube_before_the_wall(0.0);
  for (int i = 1; i <= 265; ++i) {
    const Isometry3d X_WG = at(-0.05 + i * kStep);
    ASSERT_EQ(with.advance(X_WG).X_WV.matrix(), without.advance(X_WG).X_WV.matrix()) << i;
    ASSERT_EQ(with.result().pushing, without.result().pushing) << i;
    ASSERT_EQ(with.result().state, without.result().state) << i;
  }
}

/// Metres: how far a ball came in a call, in the mean over the last of many, while its ghost went by 1 mm in each over
/// a finely meshed ball: more at one edge, less at another. No cycle goes farther than a search looks.
double way_on_fine_meshes(std::size_t affordable) {
  Sliding sliding({test_support::obstacle_of(geometry::make_sphere(0.1, 20'000))},
                  test_support::part_of(geometry::make_sphere(0.02, 5000)), at(-0.03, 0.0, 0.118),
                  {.rules = {.max_cycles = 3, .affordable_pairs = affordable}});
  constexpr int kCalls = 60;
  constexpr int kLast = 20;
  double way = 0.0;
  for (int i = 0; i < kCalls; ++i) {
    const Eigen::Vector3d before = sliding.result().X_WV.translation();
    const double of_call = (sliding.advance(at(-0.03 + 1e-3 * i, 0.0, 0.11)).X_WV.translation() - before).norm();
    if (i >= kCalls - kLast) way += of_call / kLast;
  }
  return way;
}

TEST(AffordablePairs, LowLimitShortensTheReachOnFineMeshes) {
  EXPECT_NEAR(way_on_fine_meshes(30'000), 1e-3, 0.1e-3);
  EXPECT_LE(way_on_fine_meshes(10), 3 * 0.2e-3) << "the least that a cycle looks";
  EXPECT_GE(way_on_fine_meshes(10), 2 * 0.2e-3);
}

}  // namespace
}  // namespace glissade::contact
