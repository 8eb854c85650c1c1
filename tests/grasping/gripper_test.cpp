/// The clasp knows nothing of hands: grippers with three fingers, from URDF files, close round a ball and a box.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/geometry/mesh_generators.h>
#include <glissade/grasping/clasp.h>
#include <glissade/grasping/kinematic_chain.h>

#include "clasped_hand.h"
#include "poses.h"
#include "temporary_folder.h"

namespace glissade::grasping {
namespace {

using std::numbers::pi;
using test_support::at;
using test_support::ClaspedHand;

/// One of three fingers round the gripper's axis z: two joints that bend inwards. `mimic` goes into the outer joint.
std::string gripper_finger(int number, const std::string& mimic_inner, const std::string& mimic_outer) {
  const std::string n = std::to_string(number);
  const double angle = number * 2.0 * pi / 3.0;
  const std::string xyz =
      std::to_string(0.05 * std::cos(angle)) + " " + std::to_string(0.05 * std::sin(angle)) + " 0.1";
  return "<link name='inner_" + n +
         "'><collision><origin xyz='0 0 0.03'/><geometry><box size='0.012 0.02 0.044'/></geometry></collision></link>"
         "<link name='outer_" +
         n +
         "'><collision><origin xyz='0 0 0.025'/><geometry><box size='0.01 0.018 0.04'/></geometry></collision></link>"
         "<joint name='inner_joint_" +
         n + "' type='revolute'><parent link='palm'/><child link='inner_" + n + "'/><origin rpy='0 0 " +
         std::to_string(angle) + "' xyz='" + xyz +
         "'/><axis xyz='0 -1 0'/><limit lower='-0.6' upper='1.2' effort='1' velocity='1'/>" + mimic_inner +
         "</joint><joint name='outer_joint_" + n + "' type='revolute'><parent link='inner_" + n +
         "'/><child link='outer_" + n +
         "'/><origin xyz='0 0 0.055'/><axis xyz='0 -1 0'/><limit lower='0' upper='1.5' effort='1' velocity='1'/>" +
         mimic_outer + "</joint>";
}

/// With two values for each finger, or with one for all six joints.
std::shared_ptr<const KinematicChain> gripper_chain(bool has_one_motor) {
  std::string text =
      "<robot name='gripper'><link name='palm'><collision><origin xyz='0 0 0.045'/><geometry>"
      "<cylinder radius='0.06' length='0.09'/></geometry></collision></link>";
  for (int i = 0; i < 3; ++i) {
    const bool mimics = has_one_motor && i > 0;
    text += gripper_finger(i, mimics ? "<mimic joint='inner_joint_0'/>" : "",
                           has_one_motor ? "<mimic joint='inner_joint_0' multiplier='0.5' offset='0.3'/>" : "");
  }
  const test_support::TemporaryFolder folder;
  return std::make_shared<const KinematicChain>(read_urdf(folder.write("gripper.urdf", text + "</robot>")).chain);
}

Posture with_all(const KinematicChain& chain, double angle) {
  Posture posture{.values = std::vector<double>(chain.values().size(), angle)};
  chain.clamp(posture.values);
  return posture;
}

/// Closes slowly from open to `angle`; every posture and every way must be free.
void close_slowly(ClaspedHand& gripper, double angle) {
  Posture last = with_all(gripper.clasp.chain(), -0.5);
  gripper.clasp.advance(last);
  ASSERT_EQ(gripper.clasp.state(), ClaspState::kClasping);
  for (int i = 1; i <= 300; ++i) {
    gripper.clasp.advance(with_all(gripper.clasp.chain(), -0.5 + (angle + 0.5) * std::min(1.0, i / 200.0)));
    ASSERT_FALSE(gripper.collides(gripper.clasp.posture())) << i;
    ASSERT_FALSE(gripper.way_collides(last, 4)) << i;
    last = gripper.clasp.posture();
  }
}

/// Numbers of the fingers that touch.
std::set<char> touching_fingers(const Clasp& clasp) {
  std::set<char> fingers;
  for (const LinkContact& contact : clasp.contacts())
    fingers.insert(clasp.chain().links()[contact.link].name.back());
  return fingers;
}

/// No value alone comes nearer to the target by 0.01 rad, 0.2 mm at the 20 mm from a joint where a link begins to
/// count.
void expect_tight(const ClaspedHand& gripper, double angle) {
  const Posture target = with_all(gripper.clasp.chain(), angle);
  for (std::size_t v = 0; v < target.values.size(); ++v) {
    const double left = target.values[v] - gripper.clasp.posture().values[v];
    if (std::abs(left) < 0.01) continue;
    Posture nearer = gripper.clasp.posture();
    nearer.values[v] += std::copysign(0.01, left);
    EXPECT_TRUE(gripper.collides(nearer))
        << gripper.clasp.chain().values()[v].name << " stopped " << left << " rad early";
  }
}

TEST(Gripper, ClaspsABallWithThreeFingers) {
  for (const bool has_one_motor : {false, true}) {
    ClaspedHand hand(gripper_chain(has_one_motor), geometry::make_sphere(0.035, 2000), at(0.0, 0.0, 0.15));
    EXPECT_EQ(hand.clasp.chain().values().size(), has_one_motor ? 1U : 6U);
    close_slowly(hand, 1.0);
    EXPECT_EQ(touching_fingers(hand.clasp), (std::set<char>{'0', '1', '2'}));
    expect_tight(hand, 1.0);
  }
}

// Not all fingers meet faces of the box alike: with one motor the first that touches stops all.
TEST(Gripper, ClaspsABox) {
  for (const bool has_one_motor : {false, true}) {
    ClaspedHand hand(gripper_chain(has_one_motor), geometry::make_box({0.05, 0.04, 0.06}, 300), at(0.005, 0.0, 0.15));
    close_slowly(hand, 1.0);
    EXPECT_GE(touching_fingers(hand.clasp).size(), has_one_motor ? 1U : 3U);
    expect_tight(hand, 1.0);
  }
}

TEST(Gripper, OpensAgain) {
  ClaspedHand hand(gripper_chain(false), geometry::make_sphere(0.035, 2000), at(0.0, 0.0, 0.15));
  close_slowly(hand, 1.0);
  for (int i = 0; i < 100; ++i)
    hand.clasp.advance(with_all(hand.clasp.chain(), -0.5));
  EXPECT_EQ(hand.clasp.posture().values, with_all(hand.clasp.chain(), -0.5).values);
  EXPECT_TRUE(hand.clasp.contacts().empty());
}

}  // namespace
}  // namespace glissade::grasping
