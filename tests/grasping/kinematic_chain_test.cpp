#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/grasping/kinematic_chain.h>

#include "expect_bad_input.h"
#include "poses.h"
#include "random_chain.h"
#include "random_numbers.h"

namespace glissade::grasping {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using std::numbers::pi;
using test_support::at;
using test_support::expect_bad_input;
using test_support::poses_of;
using test_support::random_chain;
using test_support::random_values;
using test_support::RandomNumbers;

constexpr std::uint64_t kChainSeed = 20261125;

/// Two arms of lengths 2 and 1 in the plane z = 0, the second of which bends half as much as the first.
KinematicChain coupled_arm() {
  return {{{.name = "bend", .lower = 0.0, .upper = pi / 2}},
          {{.name = "base"},
           {.name = "upper", .parent = 0, .axis_J = Vector3d::UnitZ(), .terms = {{0, 1.0}}},
           {.name = "lower", .parent = 1, .X_PJ = at(2.0), .axis_J = Vector3d::UnitZ(), .terms = {{0, 0.5}}},
           {.name = "tip", .parent = 2, .X_PJ = at(1.0)}}};
}

TEST(KinematicChain, PlacesACoupledArmAsDrawnByHand) {
  const std::vector<Isometry3d> X_RL = poses_of(coupled_arm(), {pi / 2});
  EXPECT_TRUE(X_RL[2].translation().isApprox(Vector3d(0.0, 2.0, 0.0), 1e-15));
  EXPECT_TRUE(X_RL[3].translation().isApprox(Vector3d(-std::sqrt(0.5), 2.0 + std::sqrt(0.5), 0.0), 1e-15));
}

TEST(KinematicChain, MovesWithItsRoot) {
  const Isometry3d X_WR = test_support::pose({1.0, 2.0, 3.0}, test_support::turn(0.7, {1.0, -1.0, 2.0}));
  const std::vector<Isometry3d> X_RL = poses_of(coupled_arm(), {0.4});
  const std::vector<Isometry3d> X_WL = poses_of(coupled_arm(), {0.4}, X_WR);
  for (std::size_t i = 0; i < X_RL.size(); ++i)
    EXPECT_TRUE(X_WL[i].isApprox(X_WR * X_RL[i], 1e-14)) << i;
}

/// A rotation about an axis through a point.
Isometry3d screw(const Vector3d& point, const Vector3d& axis, double angle) {
  return Eigen::Translation3d(point) * Eigen::AngleAxisd(angle, axis) * Eigen::Translation3d(-point);
}

/// Product of exponentials (R. W. Brockett, 1984): all joints at angle 0, then the turns about axes that stand still,
/// the outermost first.
Isometry3d by_exponentials(const KinematicChain& chain, const std::vector<double>& values, std::size_t link) {
  std::vector<Isometry3d> X_R0;
  for (const ChainLink& each : chain.links())
    X_R0.push_back(each.parent ? X_R0[*each.parent] * each.X_PJ : Isometry3d::Identity());
  Isometry3d X = X_R0[link];
  for (std::size_t i = link; chain.links()[i].parent; i = *chain.links()[i].parent) {
    const ChainLink& joint = chain.links()[i];
    double angle = joint.offset;
    for (const JointTerm& term : joint.terms)
      angle += term.factor * values[term.value];
    X = screw(X_R0[i].translation(), X_R0[i].linear() * joint.axis_J, angle) * X;
  }
  return X;
}

TEST(KinematicChain, AgreesWithTheProductOfExponentials) {
  RandomNumbers random(kChainSeed);
  for (int run = 0; run < 200; ++run) {
    const KinematicChain chain = random_chain(random, 12, 5);
    const std::vector<double> values = random_values(random, chain);
    const std::vector<Isometry3d> X_RL = poses_of(chain, values);
    for (std::size_t i = 0; i < X_RL.size(); ++i)
      ASSERT_TRUE(X_RL[i].isApprox(by_exponentials(chain, values, i), 1e-13))
          << "seed " << kChainSeed << ", run " << run;
  }
}

TEST(KinematicChain, RatesEqualFiniteDifferences) {
  constexpr double kStep = 1e-6;
  RandomNumbers random(kChainSeed);
  for (int run = 0; run < 50; ++run) {
    const KinematicChain chain = random_chain(random, 12, 5);
    const std::vector<double> values = random_values(random, chain);
    const std::vector<Isometry3d> X_RL = poses_of(chain, values);
    const std::size_t link = X_RL.size() - 1;
    const Vector3d p_R = X_RL[link] * Vector3d(0.1, -0.2, 0.3);
    const Vector3d n_R = Vector3d(2.0, 1.0, -2.0) / 3.0;
    std::vector<double> rates(values.size(), 0.0);
    chain.add_rates(link, p_R, n_R, X_RL, rates);
    for (std::size_t v = 0; v < values.size(); ++v) {
      std::vector<double> moved = values;
      moved[v] += kStep;
      const Vector3d way_R = poses_of(chain, moved)[link] * (X_RL[link].inverse() * p_R) - p_R;
      ASSERT_NEAR(rates[v], n_R.dot(way_R) / kStep, 1e-4) << "run " << run << ", value " << v;
    }
  }
}

TEST(KinematicChain, KnowsWhichLinksAValueMoves) {
  RandomNumbers random(kChainSeed);
  for (int run = 0; run < 50; ++run) {
    const KinematicChain chain = random_chain(random, 12, 5);
    const std::vector<double> values = random_values(random, chain);
    const std::vector<Isometry3d> X_RL = poses_of(chain, values);
    for (std::size_t value = 0; value < values.size(); ++value) {
      std::vector<double> changed = values;
      changed[value] += 0.3;
      const std::vector<Isometry3d> X_RL_changed = poses_of(chain, changed);
      for (std::size_t i = 0; i < X_RL.size(); ++i)
        ASSERT_EQ(chain.moves(value, i), !X_RL[i].isApprox(X_RL_changed[i], 1e-9))
            << "seed " << kChainSeed << ", run " << run << ", value " << value << ", link " << i;
    }
  }
}

TEST(KinematicChain, KnowsWhatHangsOnALink) {
  const KinematicChain tree({}, {{.name = "root"},
                                 {.name = "a", .parent = 0},
                                 {.name = "b", .parent = 0},
                                 {.name = "a1", .parent = 1},
                                 {.name = "a11", .parent = 3}});
  EXPECT_TRUE(tree.hangs_on(4, 4) && tree.hangs_on(4, 3) && tree.hangs_on(4, 1) && tree.hangs_on(4, 0));
  EXPECT_TRUE(tree.hangs_on(2, 0));
  EXPECT_FALSE(tree.hangs_on(4, 2) || tree.hangs_on(2, 1) || tree.hangs_on(1, 3));
}

TEST(KinematicChain, KeepsValuesWithinTheirLimits) {
  const KinematicChain chain = coupled_arm();
  std::vector<double> values{-0.1};
  chain.clamp(values);
  EXPECT_EQ(values[0], 0.0);
  values[0] = 3.0;
  chain.clamp(values);
  EXPECT_EQ(values[0], pi / 2);
  values[0] = 0.5;
  chain.clamp(values);
  EXPECT_EQ(values[0], 0.5);
}

TEST(KinematicChain, RefusesBadValues) {
  const std::vector<ChainLink> root{{.name = "root"}};
  expect_bad_input([&] { KinematicChain({{.name = "", .upper = 1.0}}, root); }, {"Flex value ''", "name is empty"});
  expect_bad_input([&] { KinematicChain({{.name = "a"}, {.name = "a"}}, root); }, {"'a'", "twice"});
  expect_bad_input([&] { KinematicChain({{.name = "a", .lower = 1.0}}, root); }, {"'a'", "lower limit is above"});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  expect_bad_input([&] { KinematicChain({{.name = "a", .upper = nan}}, root); }, {"'a'", "not finite"});
}

TEST(KinematicChain, RefusesBadLinks) {
  const auto with = [](const ChainLink& link) {
    return [link] { KinematicChain({{.name = "value"}}, {{.name = "root"}, link}); };
  };
  expect_bad_input([] { KinematicChain({}, {}); }, {"at least one link"});
  expect_bad_input([] { KinematicChain({}, {{.name = "r", .offset = 0.1}}); }, {"'r'", "root has no joint"});
  expect_bad_input([] { KinematicChain({}, {{.name = "r", .parent = 0}}); }, {"'r'", "no parent"});
  expect_bad_input(with({.name = "", .parent = 0}), {"name is empty"});
  expect_bad_input(with({.name = "root", .parent = 0}), {"'root'", "twice"});
  expect_bad_input(with({.name = "a"}), {"'a'", "only link 0 may be the root"});
  expect_bad_input(with({.name = "a", .parent = 1}), {"'a'", "must come before it", "link 1"});
  expect_bad_input(with({.name = "a", .parent = 0, .axis_J = {1.0, 1.0, 0.0}}), {"'a'", "unit length"});
  expect_bad_input(with({.name = "a", .parent = 0, .terms = {{1, 1.0}}}), {"'a'", "no flex value 1"});
  Isometry3d X_stretched = Isometry3d::Identity();
  X_stretched.linear() *= 2.0;
  expect_bad_input(with({.name = "a", .parent = 0, .X_PJ = X_stretched}), {"'a'", "no rigid pose"});
  expect_bad_input(with({.name = "a", .parent = 0, .mesh = std::make_shared<const geometry::TriangleMesh>()}),
                   {"'a'", "no vertices"});
}

}  // namespace
}  // namespace glissade::grasping
