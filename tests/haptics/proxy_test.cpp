#include "loop/proxy.h"

#include <gtest/gtest.h>

#include "poses.h"

namespace glissade::haptics {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using test_support::at;

/// The set of a part at the origin whose lowest point may sink by `depth` before it meets a floor.
ContactSet floor_below(double depth) {
  ContactSet set;
  set.sequence = 1;
  set.reach = 5e-3;
  set.row_count = 1;
  set.row_array[0] = {Vector3d::UnitZ(), Vector3d::Zero(), -depth};
  return set;
}

Proxy proxy_at_origin() {
  return {Vector3d::Zero(), 0.1, {1000.0, 10.0}, Isometry3d::Identity()};
}

/// Brings the ghost to its place slowly enough for the slew limit.
const Isometry3d& settle(Proxy& proxy, const ContactSet& set, const Isometry3d& X_WG) {
  for (int i = 0; i < 100; ++i)
    proxy.update(set, X_WG);
  return proxy.pose();
}

TEST(Proxy, IsTheGhostBitForBitWhereNothingIsInTheWay) {
  Proxy proxy = proxy_at_origin();
  Isometry3d X_WG = at(1e-4, 0.0, -1e-4);
  X_WG.rotate(Eigen::AngleAxisd(1e-3, Vector3d(1.0, 2.0, 3.0).normalized()));
  EXPECT_EQ(proxy.update(floor_below(1e-3), X_WG).matrix(), X_WG.matrix());
}

TEST(Proxy, IsTheGhostAsLongAsTheSimulationHasNotAnswered) {
  Proxy proxy = proxy_at_origin();
  EXPECT_EQ(settle(proxy, ContactSet{}, at(0.0, 0.0, -0.05)).matrix(), at(0.0, 0.0, -0.05).matrix());
}

TEST(Proxy, StaysOnTheFloorAndFollowsTheGhostAlongItWithAnOldSet) {
  Proxy proxy = proxy_at_origin();
  const ContactSet set = floor_below(1e-3);
  settle(proxy, set, at(0.0, 0.0, -3e-3));
  for (int i = 1; i <= 20; ++i) {
    const Isometry3d& X_WP = proxy.update(set, at(i * 1e-4, 0.0, -3e-3));
    EXPECT_NEAR(X_WP.translation().x(), i * 1e-4, 1e-12);
    EXPECT_NEAR(X_WP.translation().z(), -1e-3, 1e-12);
  }
}

TEST(Proxy, DoesNotLeaveTheReachOfTheSetAlongAContact) {
  Proxy proxy = proxy_at_origin();
  const Isometry3d& X_WP = settle(proxy, floor_below(1e-3), at(0.1, 0.0, -3e-3));
  EXPECT_LE(X_WP.translation().norm(), 5e-3 * (1.0 + 1e-12));
}

TEST(Proxy, FollowsANewContactNoFasterThanTheSlew) {
  Proxy proxy = proxy_at_origin();
  settle(proxy, floor_below(5e-3), at(0.0, 0.0, -3e-3));
  // A floor appears 2 mm above the ghost, which stands still.
  double height = -3e-3;
  for (int i = 0; i < 20; ++i) {
    const double next = proxy.update(floor_below(1e-3), at(0.0, 0.0, -3e-3)).translation().z();
    EXPECT_LE(next - height, kSlew_m * (1.0 + 1e-9));
    height = next;
  }
  EXPECT_NEAR(height, -1e-3, 1e-12);
}

}  // namespace
}  // namespace glissade::haptics
