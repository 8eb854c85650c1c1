#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/grasping/hand_model.h>
#include <glissade/grasping/kinematic_chain.h>

#include "poses.h"
#include "random_chain.h"
#include "random_numbers.h"

namespace glissade::grasping {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using test_support::at;
using test_support::poses_of;
using test_support::RandomNumbers;

constexpr std::uint64_t kReachSeed = 20261126;

/// Checks every point of every link against every joint before it. Returns the greatest share of a reach that was used.
double greatest_share(const KinematicChain& chain, const std::vector<double>& values) {
  const std::vector<Isometry3d> X_RL = poses_of(chain, values);
  double share = 0.0;
  for (std::size_t link = 0; link < X_RL.size(); ++link) {
    if (!chain.links()[link].mesh) continue;
    for (std::size_t joint = 0; joint <= link; ++joint) {
      if (!chain.hangs_on(link, joint)) continue;
      for (const Vector3d& p_L : chain.links()[link].mesh->vertices) {
        const double distance = (X_RL[link] * p_L - X_RL[joint].translation()).norm();
        share = std::max(share, distance / chain.reach(link, joint));
      }
    }
  }
  return share;
}

TEST(Reach, IsNeverExceededByAHandOrByAnyChain) {
  RandomNumbers random(kReachSeed);
  const KinematicChain hand = make_hand().chain;
  for (int run = 0; run < 300; ++run) {
    ASSERT_LE(greatest_share(hand, test_support::random_values(random, hand)), 1.0) << "seed " << kReachSeed;
    const KinematicChain chain = test_support::random_chain(random, 12, 5);
    ASSERT_LE(greatest_share(chain, test_support::random_values(random, chain)), 1.0) << "seed " << kReachSeed;
  }
}

TEST(Reach, IsTightForAStretchedArm) {
  geometry::TriangleMesh mesh;
  mesh.vertices = {{0.0, 0.0, 0.0}, {0.5, 0.0, 0.0}};
  const auto stick = std::make_shared<const geometry::TriangleMesh>(mesh);
  const KinematicChain arm({{.name = "bend", .upper = 1.0}},
                           {{.name = "root"},
                            {.name = "a", .parent = 0, .X_PJ = at(1.0), .axis_J = Vector3d::UnitZ(), .terms = {{0}}},
                            {.name = "b", .parent = 1, .X_PJ = at(2.0), .mesh = stick}});
  EXPECT_NEAR(arm.reach(2, 2), 0.5, 1e-11);
  EXPECT_NEAR(arm.reach(2, 1), 2.5, 1e-11);
  EXPECT_NEAR(arm.reach(2, 0), 3.5, 1e-11);
  EXPECT_EQ(arm.reach(1, 0), 0.0) << "nothing that could touch";
}

// What clasping relies on: a joint that turns by `angle` moves no point of a link farther than 2 sin(angle / 2) reach.
TEST(Reach, BoundsTheMotionThatOneJointCauses) {
  RandomNumbers random(kReachSeed);
  const KinematicChain hand = make_hand().chain;
  for (int run = 0; run < 200; ++run) {
    const std::vector<double> values = test_support::random_values(random, hand);
    const auto value =
        static_cast<std::size_t>(random.integer(0, 18));  // each moves one joint only, except those below
    if (value == 14) continue;                            // ring and little finger
    std::vector<double> turned = values;
    turned[value] += random.uniform(-1.0, 1.0);
    const double chord = 2.0 * std::sin(std::abs(turned[value] - values[value]) / 2.0);
    std::size_t joint = 0;
    while (!hand.moves(value, joint))
      ++joint;
    const std::vector<Isometry3d> before = poses_of(hand, values);
    const std::vector<Isometry3d> after = poses_of(hand, turned);
    for (std::size_t link = joint; link < before.size(); ++link) {
      if (!hand.moves(value, link) || !hand.links()[link].mesh) continue;
      for (const Vector3d& p_L : hand.links()[link].mesh->vertices)
        ASSERT_LE((after[link] * p_L - before[link] * p_L).norm(), chord * hand.reach(link, joint) + 1e-15)
            << "seed " << kReachSeed << ", run " << run << ", value " << value << ", link " << link;
    }
  }
}

}  // namespace
}  // namespace glissade::grasping
