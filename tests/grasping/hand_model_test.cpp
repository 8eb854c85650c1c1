#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/devices/simulated_glove.h>
#include <glissade/grasping/hand_model.h>

#include "expect_bad_input.h"
#include "random_chain.h"
#include "random_numbers.h"

namespace glissade::grasping {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using test_support::expect_bad_input;
using test_support::poses_of;
using test_support::RandomNumbers;

constexpr std::uint64_t kHandSeed = 20261127;
constexpr double kDegrees = std::numbers::pi / 180.0;

/// All values 0, except those named, in degrees.
std::vector<double> values_of(const std::map<std::string, double>& degrees) {
  std::vector<double> values(hands::kJoints, 0.0);
  for (const auto& [name, angle] : degrees) {
    const auto* at = std::ranges::find(hands::kJointNames, name);
    values.at(static_cast<std::size_t>(at - hands::kJointNames.begin())) = angle * kDegrees;
  }
  return values;
}

std::size_t link_named(const HandModel& hand, const std::string& name) {
  const auto at = std::ranges::find(hand.chain.links(), name, &ChainLink::name);
  EXPECT_NE(at, hand.chain.links().end()) << name;
  return static_cast<std::size_t>(at - hand.chain.links().begin());
}

/// Poses of the links of a hand by name, with the forearm at the origin.
class Placed {
 public:
  Placed(const HandModel& hand, const std::vector<double>& values) : hand_(hand), X_RL_(poses_of(hand.chain, values)) {}
  explicit Placed(const HandModel& hand) : Placed(hand, std::vector<double>(hands::kJoints, 0.0)) {}

  const Isometry3d& X_RL(const std::string& link) const { return X_RL_[link_named(hand_, link)]; }
  Vector3d origin(const std::string& link) const { return X_RL(link).translation(); }
  Vector3d bone(const std::string& link) const { return X_RL(link).linear().col(0); }
  /// The outermost point of a finger.
  Vector3d tip(const std::string& finger) const {
    const ChainLink& link = hand_.chain.links()[link_named(hand_, finger + "_distal")];
    return X_RL(link.name) *
           *std::ranges::max_element(link.mesh->vertices, {}, [](const Vector3d& p) { return p.x(); });
  }

 private:
  const HandModel& hand_;
  std::vector<Isometry3d> X_RL_;
};

double angle_between(const Vector3d& a, const Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

const std::array<std::string, 4> kFingers{"index", "middle", "ring", "little"};

TEST(HandModel, FlexValuesAreTheGloveJoints) {
  const HandModel hand = make_hand();
  ASSERT_EQ(hand.chain.values().size(), hands::kJointNames.size());
  for (std::size_t i = 0; i < hands::kJointNames.size(); ++i) {
    EXPECT_EQ(hand.chain.values()[i].name, hands::kJointNames[i]);
    EXPECT_LE(hand.chain.values()[i].lower, 0.0) << "the flat hand is within the limits";
    EXPECT_GT(hand.chain.values()[i].upper, 0.0);
  }
  EXPECT_DOUBLE_EQ(hand.chain.values()[4].lower, -20.0 * kDegrees);
  EXPECT_DOUBLE_EQ(hand.chain.values()[4].upper, 90.0 * kDegrees);
  EXPECT_DOUBLE_EQ(hand.chain.values()[20].upper, 80.0 * kDegrees);
}

// Buchholz et al. 1992: lengths between joint centres over the length of the hand.
TEST(HandModel, HasBonesInTheRatiosOfThePublishedTable) {
  struct Ray {
    std::string name;
    double proximal, middle, distal;
  };
  const double length = 0.19;
  const HandModel hand = make_hand({.length_m = length, .breadth_m = 0.09});
  const Placed flat(hand);
  for (const Ray& ray : {Ray{"index", .265, .143, .097}, Ray{"middle", .277, .170, .108}, Ray{"ring", .259, .165, .107},
                         Ray{"little", .206, .117, .093}}) {
    const Vector3d mcp = flat.origin(ray.name + "_proximal");
    const Vector3d pip = flat.origin(ray.name + "_middle");
    const Vector3d dip = flat.origin(ray.name + "_distal");
    EXPECT_NEAR((pip - mcp).norm(), ray.proximal * length, 1e-12) << ray.name;
    EXPECT_NEAR((dip - pip).norm(), ray.middle * length, 1e-12) << ray.name;
    EXPECT_NEAR((flat.tip(ray.name) - dip).norm(), ray.distal * length, 1e-12) << ray.name;
  }
  EXPECT_NEAR((flat.origin("ring_proximal") - flat.origin("ring_metacarpal")).norm(), .338 * length, 1e-12);
  EXPECT_NEAR((flat.origin("little_proximal") - flat.origin("little_metacarpal")).norm(), .306 * length, 1e-12);
  EXPECT_NEAR((flat.origin("thumb_proximal") - flat.origin("thumb_metacarpal")).norm(), .251 * length, 1e-12);
  EXPECT_NEAR((flat.origin("thumb_distal") - flat.origin("thumb_proximal")).norm(), .196 * length, 1e-12);
  EXPECT_NEAR((flat.tip("thumb") - flat.origin("thumb_distal")).norm(), .158 * length, 1e-12);
  EXPECT_NEAR(flat.tip("middle").norm(), length, 0.002 * length) << "the length of the hand";
}

TEST(HandModel, HasItsKnucklesWhereThePublishedTableHasThem) {
  const HandModel hand = make_hand({.length_m = 0.2, .breadth_m = 0.1});
  const Placed flat(hand);
  EXPECT_TRUE(flat.origin("index_proximal").isApprox(Vector3d(.0894, .0252, 0.0), 1e-12));
  EXPECT_TRUE(flat.origin("middle_proximal").isApprox(Vector3d(.0892, 0.0, 0.0), 1e-12));
  EXPECT_TRUE(flat.origin("ring_proximal").isApprox(Vector3d(.0818, -.0206, 0.0), 1e-12));
  EXPECT_TRUE(flat.origin("little_proximal").isApprox(Vector3d(.0736, -.0402, 0.0), 1e-12));
  EXPECT_TRUE(flat.origin("thumb_metacarpal").isApprox(Vector3d(.0146, .0196, 0.0), 1e-12));
}

TEST(HandModel, IsFlatWithParallelFingersWhenAllValuesAreZero) {
  const HandModel hand = make_hand();
  const Placed flat(hand);
  EXPECT_TRUE(flat.X_RL("palm").isApprox(Isometry3d::Identity(), 1e-15)) << "the palm's frame is R";
  for (const std::string& finger : kFingers)
    for (const char* segment : {"_proximal", "_middle", "_distal"})
      EXPECT_TRUE(flat.X_RL(finger + segment).linear().isIdentity(1e-12)) << finger << segment;
}

// The middle of the palm's surface.
const Vector3d kPalmPoint(0.06, 0.0, -0.014);

TEST(HandModel, ClosesWithEveryFlexion) {
  const HandModel hand = make_hand();
  for (const std::string& finger : kFingers)
    for (const char* joint : {"_mcp", "_pip", "_dip"}) {
      double last = std::numeric_limits<double>::infinity();
      for (const double degrees : {0.0, 20.0, 40.0, 60.0, 80.0}) {
        std::map<std::string, double> angles{{finger + "_mcp", 20.0}};
        angles[finger + joint] = degrees;
        const Placed bent(hand, values_of(angles));
        const double distance = (bent.tip(finger) - kPalmPoint).norm();
        EXPECT_LT(distance, last) << finger << joint << " at " << degrees;
        last = distance;
      }
    }
}

TEST(HandModel, LimitsEqualThoseOfTheSimulatedGlove) {
  const HandModel hand = make_hand();
  const devices::DeviceDescriptor glove = devices::simulated_glove_descriptor();
  for (std::size_t i = 0; i < hand.chain.values().size(); ++i) {
    const FlexValue& value = hand.chain.values()[i];
    EXPECT_NEAR(value.lower, glove.joint_lower[i], 1e-12) << value.name;
    EXPECT_NEAR(value.upper, glove.joint_upper[i], 1e-12) << value.name;
  }
}

TEST(HandModel, BringsTheThumbBeforeThePalmAndAcrossIt) {
  const HandModel hand = make_hand();
  const std::map<std::string, double> spread{{"thumb_index_abduction", 40.0}};
  const auto tip = [&](const std::map<std::string, double>& more) {
    std::map<std::string, double> all = spread;
    all.insert(more.begin(), more.end());
    return Placed(hand, values_of(all)).tip("thumb");
  };
  EXPECT_LT(tip({{"thumb_roll", 60.0}}).z(), tip({}).z() - 0.03) << "rolled: before the palm";
  const Vector3d opposed = tip({{"thumb_roll", 60.0}});
  for (const char* joint : {"thumb_mcp", "thumb_ip"}) {
    const Vector3d bent = tip({{"thumb_roll", 60.0}, {joint, 40.0}});
    EXPECT_LT((bent - kPalmPoint).norm(), (opposed - kPalmPoint).norm()) << joint;
    EXPECT_GT(bent.z(), opposed.z()) << joint << " bends towards the fingers";
    EXPECT_LT(bent.y(), opposed.y()) << joint << " bends across the palm";
  }
  EXPECT_GT(tip({}).y(), Placed(hand).tip("thumb").y() + 0.03) << "spread: away from the index finger";
}

TEST(HandModel, SpreadsNeighboringFingersByTheirAbductions) {
  const HandModel hand = make_hand();
  const Placed spread(
      hand,
      values_of({{"middle_index_abduction", 12.0}, {"ring_middle_abduction", 7.0}, {"little_ring_abduction", 9.0}}));
  const auto between = [&](const char* a, const char* b) {
    return angle_between(spread.bone(std::string(a) + "_proximal"), spread.bone(std::string(b) + "_proximal")) /
           kDegrees;
  };
  EXPECT_NEAR(between("index", "middle"), 12.0, 1e-9);
  EXPECT_NEAR(between("middle", "ring"), 7.0, 1e-9);
  EXPECT_NEAR(between("ring", "little"), 9.0, 1e-9);
  EXPECT_NEAR(between("middle", "little"), 16.0, 1e-9) << "the little finger turns with the ring finger";
  EXPECT_GT(spread.tip("index").y(), Placed(hand).tip("index").y());
  EXPECT_LT(spread.tip("little").y(), Placed(hand).tip("little").y());
}

TEST(HandModel, ArchesThePalmByRingAndLittleFinger) {
  const HandModel hand = make_hand();
  const Placed arched(hand, values_of({{"palm_arch", 30.0}}));
  const Placed flat(hand);
  EXPECT_NEAR(angle_between(arched.bone("little_metacarpal"), flat.bone("little_metacarpal")), 30.0 * kDegrees, 1e-12);
  EXPECT_NEAR(angle_between(arched.bone("ring_metacarpal"), flat.bone("ring_metacarpal")), 15.0 * kDegrees, 1e-12);
  EXPECT_LT(arched.origin("little_proximal").z(), arched.origin("ring_proximal").z());
  EXPECT_LT(arched.origin("ring_proximal").z(), -0.01);
  EXPECT_TRUE(arched.X_RL("middle_proximal").isApprox(flat.X_RL("middle_proximal"), 0.0));
}

TEST(HandModel, BendsTheWristTowardsThePalmAndTowardsTheThumb) {
  const HandModel hand = make_hand();
  EXPECT_NEAR(Placed(hand, values_of({{"wrist_flexion", 30.0}})).bone("palm").z(), -0.5, 1e-12);
  EXPECT_NEAR(Placed(hand, values_of({{"wrist_abduction", 20.0}})).bone("palm").y(), std::sin(20.0 * kDegrees), 1e-12);
  EXPECT_TRUE(hand.chain.moves(20, link_named(hand, "little_distal")));
  EXPECT_FALSE(hand.chain.moves(20, 0)) << "the forearm is the root";
}

TEST(HandModel, KeepsEveryFingerInItsRangeToThePalm) {
  RandomNumbers random(kHandSeed);
  const HandModel hand = make_hand();
  for (int run = 0; run < 1000; ++run) {
    std::vector<double> values = values_of({});
    for (const std::size_t i : {10U, 14U, 18U})
      values[i] = random.uniform(hand.chain.values()[i].lower, hand.chain.values()[i].upper);
    const Placed placed(hand, values);
    const auto towards_thumb = [&](const char* link) {
      const Vector3d bone = placed.bone(link);
      return std::atan2(bone.y(), bone.x()) / kDegrees;
    };
    ASSERT_LE(std::abs(towards_thumb("index_proximal") - 7.5), 22.5 + 1e-9) << "seed " << kHandSeed;
    ASSERT_LE(std::abs(towards_thumb("ring_proximal") + 2.5), 17.5 + 1e-9) << "seed " << kHandSeed;
    ASSERT_LE(std::abs(towards_thumb("little_proximal") + 10.0), 30.0 + 1e-9) << "seed " << kHandSeed;
  }
}

/// The distance of the middles of two fingertips, as small as a search by coordinates finds it.
double least_tip_distance(const HandModel& hand, const std::string& finger, std::size_t mcp) {
  std::vector<std::size_t> free{0, 1, 2, 3, mcp, mcp + 1, mcp + 2, 10, 14, 18, 19};
  std::vector<double> values = values_of({{"thumb_roll", 45.0}, {"thumb_index_abduction", 30.0}});
  for (std::size_t i = mcp; i < mcp + 3; ++i)
    values[i] = 40.0 * kDegrees;
  const auto distance = [&] {
    const Placed placed(hand, values);
    return (placed.X_RL("thumb_distal") * Vector3d(0.018, 0.0, 0.0) -
            placed.X_RL(finger + "_distal") * Vector3d(0.010, 0.0, 0.0))
        .norm();
  };
  double least = distance();
  for (double step = 8.0 * kDegrees; step > 0.5 * kDegrees; step /= 2.0)
    for (int round = 0; round < 12; ++round)
      for (const std::size_t i : free)
        for (const double change : {step, -step}) {
          const double before = values[i];
          values[i] = std::clamp(before + change, hand.chain.values()[i].lower, hand.chain.values()[i].upper);
          const double now = distance();
          if (now < least) {
            least = now;
          } else {
            values[i] = before;
          }
        }
  return least;
}

// The pads meet where the middles of the last segments are still about 13 mm apart: precision grasps of all fingers.
TEST(HandModel, OpposesTheThumbToEveryFinger) {
  const HandModel hand = make_hand();
  const std::array<std::size_t, 4> mcp{4, 7, 11, 15};
  for (std::size_t finger = 0; finger < 4; ++finger)
    EXPECT_LT(least_tip_distance(hand, kFingers[finger], mcp[finger]), 0.008) << kFingers[finger];
}

TEST(HandModel, IsTheMirrorImageOnTheOtherSide) {
  RandomNumbers random(kHandSeed);
  const HandModel right = make_hand();
  const HandModel left = make_hand({.side = hands::HandSide::kLeft});
  const auto mirror = [](const Vector3d& p) { return Vector3d(p.x(), -p.y(), p.z()); };
  for (int run = 0; run < 50; ++run) {
    const std::vector<double> values = test_support::random_values(random, right.chain);
    const std::vector<Isometry3d> X_RL_right = poses_of(right.chain, values);
    const std::vector<Isometry3d> X_RL_left = poses_of(left.chain, values);
    for (std::size_t link = 0; link < kHandLinks; ++link) {
      const ChainLink& of_right = right.chain.links()[link];
      ASSERT_TRUE(X_RL_left[link].translation().isApprox(mirror(X_RL_right[link].translation()), 1e-12))
          << of_right.name;
      if (!of_right.mesh) continue;
      for (std::size_t i = 0; i < of_right.mesh->vertices.size(); ++i)
        ASSERT_LT((X_RL_left[link] * left.chain.links()[link].mesh->vertices[i] -
                   mirror(X_RL_right[link] * of_right.mesh->vertices[i]))
                      .norm(),
                  1e-14)
            << of_right.name << ", seed " << kHandSeed;
    }
  }
}

TEST(HandModel, GrowsInProportion) {
  const std::vector<double> values = values_of({{"thumb_roll", 30.0}, {"index_mcp", 50.0}, {"palm_arch", 20.0}});
  const HandModel small = make_hand({.length_m = 0.1, .breadth_m = 0.045});
  const HandModel large = make_hand({.length_m = 0.2, .breadth_m = 0.09});
  const std::vector<Isometry3d> X_RL_small = poses_of(small.chain, values);
  const std::vector<Isometry3d> X_RL_large = poses_of(large.chain, values);
  for (std::size_t link = 0; link < kHandLinks; ++link) {
    EXPECT_LT((2.0 * X_RL_small[link].translation() - X_RL_large[link].translation()).norm(), 1e-12) << link;
    if (!small.chain.links()[link].mesh) continue;
    const auto& vertices = large.chain.links()[link].mesh->vertices;
    for (std::size_t i = 0; i < vertices.size(); ++i)
      EXPECT_LT((2.0 * small.chain.links()[link].mesh->vertices[i] - vertices[i]).norm(), 1e-12) << link;
  }
}

TEST(HandModel, SaysWhatEachSegmentIs) {
  const HandModel hand = make_hand();
  std::map<std::pair<Finger, HandSegment>, int> count;
  for (std::size_t link = 0; link < kHandLinks; ++link) {
    const SegmentMeaning meaning = hand.meaning[link];
    EXPECT_EQ(meaning.segment != HandSegment::kNone, hand.chain.links()[link].mesh != nullptr) << link;
    if (meaning.segment != HandSegment::kNone) ++count[{meaning.finger, meaning.segment}];
  }
  EXPECT_EQ((count[{Finger::kNone, HandSegment::kPalm}]), 3);
  for (const Finger finger : {Finger::kThumb, Finger::kIndex, Finger::kMiddle, Finger::kRing, Finger::kLittle})
    for (const HandSegment segment : {HandSegment::kInner, HandSegment::kMiddle, HandSegment::kOuter})
      EXPECT_EQ((count[{finger, segment}]), 1);
  EXPECT_EQ(hand.meaning[link_named(hand, "ring_distal")].finger, Finger::kRing);
  EXPECT_EQ(hand.meaning[link_named(hand, "ring_distal")].segment, HandSegment::kOuter);
}

TEST(HandModel, RefusesShapesOfNoHand) {
  expect_bad_input([] { make_hand({.length_m = 1.83}); }, {"length_m", "1.83"});
  expect_bad_input([] { make_hand({.breadth_m = 0.84}); }, {"breadth_m", "0.84"});
  expect_bad_input([] { make_hand({.side = hands::HandSide::kUnknown}); }, {"side"});
}

}  // namespace
}  // namespace glissade::grasping
