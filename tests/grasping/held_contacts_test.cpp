/// Which contacts of a hand with a held part go on.

#include "life/held_contacts.h"

#include <array>
#include <vector>

#include <gtest/gtest.h>

#include "poses.h"

namespace glissade::grasping {
namespace {

using Eigen::Vector3d;
using test_support::at;

constexpr std::int32_t kHeldBody = 2;

/// A link 0 at the origin, which touches a part below it with its own origin.
class HeldPart : public ::testing::Test {
 protected:
  /// The links that touch after the target has gone this far.
  std::vector<LinkContact> touching_at(double x, double z, const std::vector<LinkContact>& contacts = {}) {
    held_.update(contacts, kHeldBody, at(0.0), std::array{at(0.0)}, std::array{at(x, 0.0, z)});
    return {held_.contacts().begin(), held_.contacts().end()};
  }
  static std::vector<LinkContact> touch() {
    LinkContact touch{};
    touch.contact.n_W = Vector3d::UnitZ();
    touch.contact.p_W = Vector3d::Zero();
    touch.contact.obstacle = kHeldBody;
    touch.depth = 1e-3;
    return {touch};
  }
  HeldContacts held_{1};
};

TEST_F(HeldPart, IsTouchedOnByALinkThatHasHardlyLeftIt) {
  EXPECT_TRUE(touching_at(0.0, 1e-3).empty()) << "it has never touched";
  touching_at(0.0, -1e-3, touch());
  const std::vector<LinkContact> contacts = touching_at(0.0, 1e-3);
  ASSERT_EQ(contacts.size(), 1U);
  EXPECT_EQ(contacts[0].depth, 0.0);
  EXPECT_NEAR(contacts[0].contact.gap, 1e-3, 1e-12) << "the load of the part fades with it";
  EXPECT_TRUE(held_.left().empty());
}

TEST_F(HeldPart, IsPlainlyLeftAtAFewMillimetres) {
  touching_at(0.0, -1e-3, touch());
  EXPECT_TRUE(touching_at(0.0, 3e-3).empty()) << "between both, the contact of before only fades";
  EXPECT_TRUE(held_.left().empty());
  touching_at(0.0, 5e-3);
  EXPECT_EQ(std::vector<std::size_t>(held_.left().begin(), held_.left().end()), std::vector<std::size_t>{0});
  EXPECT_TRUE(touching_at(0.0, 0.0).empty()) << "it must touch anew";
}

TEST_F(HeldPart, IsLeftSidewaysToo) {
  touching_at(0.0, -1e-3, touch());
  touching_at(20e-3, 0.0);
  EXPECT_EQ(held_.left().size(), 1U);
}

// A glove without torques lets its fingers go deep into the part, and there anywhere.
TEST_F(HeldPart, IsNotLeftByATargetDeepWithinIt) {
  touching_at(0.0, -1e-3, touch());
  EXPECT_EQ(touching_at(20e-3, -10e-3).size(), 1U);
  EXPECT_TRUE(held_.left().empty());
}

}  // namespace
}  // namespace glissade::grasping
