/// Which contacts of a hand with a held part go on.

#include "life/held_contacts.h"

#include <array>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "poses.h"

namespace glissade::grasping {
namespace {

using Eigen::Vector3d;
using test_support::at;

constexpr std::int32_t kHeldBody = 2;

constexpr std::size_t kPalmOfFinger = 1;
constexpr std::size_t kTip = 4;
constexpr std::array<std::size_t, 2> kFlexions{2, 3};

/// A hand whose wrist turns the palm. Its finger swings aside and bends down a metre from the tip, and curls 5 cm from
/// it.
std::shared_ptr<const KinematicChain> hand_with_a_finger() {
  const auto joint = [](std::size_t number, double x, const Vector3d& axis) {
    return ChainLink{.name = std::to_string(number),
                     .parent = number - 1,
                     .X_PJ = at(x),
                     .axis_J = axis,
                     .terms = {{number - 1, 1.0}}};
  };
  std::vector<FlexValue> values;
  for (const char* name : {"wrist", "swing", "bend", "curl"})
    values.push_back({.name = name, .lower = -4.0, .upper = 4.0});
  return std::make_shared<const KinematicChain>(values,
                                                std::vector<ChainLink>{{.name = "forearm"},
                                                                       joint(kPalmOfFinger, 0.0, Vector3d::UnitY()),
                                                                       joint(2, 0.0, Vector3d::UnitZ()),
                                                                       joint(3, 0.0, Vector3d::UnitY()),
                                                                       joint(kTip, 0.95, Vector3d::UnitY())});
}

/// The tip touches a part below it, at the origin, where all angles are 0.
class HeldPart : public ::testing::Test {
 protected:
  /// The links that touch after the target has gone this far: metres aside and up, and rad.
  std::vector<LinkContact> touching_at(double y, double z, const std::vector<LinkContact>& contacts = {},
                                       double curl = 0.0) {
    held_.update(contacts, kHeldBody, at(0.0), {at(-1.0), {0.0, 0.0, 0.0, 0.0}}, {at(-1.0), {0.0, y, -z, curl}});
    return {held_.contacts().begin(), held_.contacts().end()};
  }
  static std::vector<LinkContact> touch() {
    LinkContact touch{};
    touch.link = kTip;
    touch.contact.n_W = Vector3d::UnitZ();
    touch.contact.p_W = Vector3d::Zero();
    touch.contact.obstacle = kHeldBody;
    touch.depth = 1e-3;
    return {touch};
  }
  HeldContacts held_{hand_with_a_finger(), kPalmOfFinger, kFlexions};
};

TEST_F(HeldPart, ContactContinuesAcrossA1MillimetreGap) {
  EXPECT_TRUE(touching_at(0.0, 1e-3).empty()) << "it has never touched";
  touching_at(0.0, -1e-3, touch());
  const std::vector<LinkContact> contacts = touching_at(0.0, 1e-3);
  ASSERT_EQ(contacts.size(), 1U);
  EXPECT_EQ(contacts[0].depth, 0.0);
  EXPECT_NEAR(contacts[0].contact.gap, 1e-3, 1e-12) << "the load of the part fades with it";
  EXPECT_TRUE(held_.left().empty());
}

TEST_F(HeldPart, LinkHasLeftAt5Millimetres) {
  touching_at(0.0, -1e-3, touch());
  EXPECT_TRUE(touching_at(0.0, 3e-3).empty()) << "between both, the contact of before only fades";
  EXPECT_TRUE(held_.left().empty());
  touching_at(0.0, 5e-3);
  EXPECT_EQ(std::vector<std::size_t>(held_.left().begin(), held_.left().end()), std::vector<std::size_t>{kTip});
  EXPECT_TRUE(touching_at(0.0, 0.0).empty()) << "it must touch anew";
}

TEST_F(HeldPart, LinkHasLeftAfterSidewaysMotion) {
  touching_at(0.0, -1e-3, touch());
  touching_at(20e-3, 0.0);
  EXPECT_EQ(held_.left().size(), 1U);
}

// A glove without torques lets its fingers go deep into the part, and there anywhere.
TEST_F(HeldPart, TargetDeepInsideHasNotLeft) {
  touching_at(0.0, -1e-3, touch());
  EXPECT_EQ(touching_at(20e-3, -10e-3).size(), 1U);
  EXPECT_TRUE(held_.left().empty());
}

TEST_F(HeldPart, FingerClosingThroughItHasNotLeft) {
  touching_at(0.0, 0.0, touch());
  EXPECT_EQ(touching_at(0.0, 0.0, {}, 3.2).size(), 1U) << "the tip is a decimetre behind and 3 mm above the contact";
  EXPECT_TRUE(held_.left().empty());
  touching_at(0.0, 0.0, {}, -0.1);
  EXPECT_EQ(held_.left().size(), 1U) << "now it is 5 mm more open than it was";
}

// The tip touches from below, and where the finger bends at its root, it goes down from there.
TEST_F(HeldPart, ClosingHookedFingerHasNotLeft) {
  std::vector<LinkContact> below = touch();
  below.front().contact.n_W = -Vector3d::UnitZ();
  touching_at(0.0, 0.0, below);
  EXPECT_EQ(touching_at(0.0, -10e-3).size(), 1U);
  touching_at(0.0, 5e-3);
  EXPECT_EQ(held_.left().size(), 1U);
}

TEST_F(HeldPart, ContactsCountFromTheStartOfTheGrasp) {
  held_.begin(touch(), kHeldBody, at(0.0), {at(-1.0), {0.0, 0.0, 0.0, 0.0}});
  EXPECT_EQ(touching_at(0.0, 0.0, {}, 3.2).size(), 1U);
}

// What the wrist does, palm and part do together.
TEST_F(HeldPart, WristMotionDoesNotEndContacts) {
  touching_at(0.0, -1e-3, touch());
  const Posture bent{at(-1.0) * test_support::turn(0.5, Vector3d::UnitY()), {-0.5, 0.0, 0.0, 0.0}};
  held_.update({}, kHeldBody, at(0.0), bent, bent);
  EXPECT_EQ(held_.contacts().size(), 1U);
}

}  // namespace
}  // namespace glissade::grasping
