/// Which contacts of a hand the haptic thread gets to know, where there are more than it can hold.

#include "loop/finger_rows.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include <glissade/devices/simulated_glove.h>
#include <glissade/geometry/mesh_generators.h>
#include <glissade/grasping/hand_model.h>
#include <glissade/haptics/finger_forces.h>

#include "clasped_hand.h"
#include "poses.h"
#include "sanitizers.h"

namespace glissade::haptics {
namespace {

using grasping::LinkContact;
using grasping::Posture;
using hands::JointValues;
using test_support::at;
using test_support::bent_hand;
using test_support::ClaspedHand;
using test_support::hand_chain;
using test_support::hand_model;
using test_support::open_hand;

/// A fist round a ball with many small triangles. The palm is pressed 10 mm into it, the fingers 2 degrees.
class PressedPalm : public testing::Test {
 protected:
  PressedPalm() {
    constexpr double kTwoDegrees = 0.035;
    const Eigen::Vector3d pressed(0.0, 0.0, -0.01);
    hand_.clasp.advance(open_hand());
    for (int ms = 1; ms <= 300; ++ms)
      hand_.clasp.advance(fist(1.4 * std::min(1.0, ms / 150.0), pressed * std::min(1.0, ms / 100.0)));
    target_ = hand_.clasp.posture();
    const Posture closed = fist(1.4, pressed);
    for (std::size_t v = 0; v < target_.values.size(); ++v)
      target_.values[v] += std::clamp(closed.values[v] - target_.values[v], -kTwoDegrees, kTwoDegrees);
    target_.X_WR.translation() += pressed;
    for (int ms = 0; ms < 200; ++ms)
      hand_.clasp.advance(target_);
  }

  static Posture fist(double bend, const Eigen::Vector3d& p_WR) {
    Posture posture = bent_hand(bend);
    posture.X_WR.translation() = p_WR;
    return posture;
  }

  JointValues torques(std::span<const LinkContact> contacts) {
    HandAnswer answer;
    FingerRows().tell(hand_.clasp, contacts, 0, answer);
    JointValues angles{};
    std::copy(target_.values.begin(), target_.values.end(), angles.begin());
    FingerForces forces(finger_hand(*hand_model()), devices::simulated_glove_descriptor());
    return forces.update(angles, answer);
  }

  static constexpr int kTriangles = test_support::kSanitized ? 70'000 : 100'000;
  ClaspedHand hand_{geometry::make_sphere(0.035, kTriangles), at(0.08, 0.0, -0.055)};
  Posture target_;
};

TEST_F(PressedPalm, OmittedContactsDoNotChangeFingerTorques) {
  const std::vector<LinkContact>& contacts = hand_.clasp.contacts();
  ASSERT_GT(contacts.size(), kMaxFingerRows);
  // Each contact alone: a joint is pushed back by the strongest.
  JointValues expected{};
  for (const LinkContact& contact : contacts) {
    const JointValues of_one = torques({&contact, 1});
    for (std::size_t j = 0; j < expected.size(); ++j)
      if (std::abs(of_one[j]) > std::abs(expected[j])) expected[j] = of_one[j];
  }
  const JointValues torques_of_all = torques(contacts);
  int pushed = 0;
  for (std::size_t j = 0; j < expected.size(); ++j) {
    EXPECT_EQ(torques_of_all[j], expected[j]) << hand_chain()->values()[j].name;
    pushed += expected[j] != 0.0 ? 1 : 0;
  }
  EXPECT_GE(pushed, 8);
}

TEST_F(PressedPalm, LeavesEachSegmentAContact) {
  HandAnswer answer;
  FingerRows().tell(hand_.clasp, hand_.clasp.contacts(), 0, answer);
  EXPECT_EQ(answer.rows().size(), kMaxFingerRows);
  std::set<std::size_t> touching;
  std::set<std::size_t> told;
  for (const LinkContact& contact : hand_.clasp.contacts()) {
    touching.insert(contact.link);
    for (const FingerRow& row : answer.rows())
      if (row.p_W == contact.contact.p_W && row.n_W == contact.contact.n_W) told.insert(contact.link);
  }
  EXPECT_EQ(told, touching);
  EXPECT_GE(touching.size(), 5U);
}

}  // namespace
}  // namespace glissade::haptics
