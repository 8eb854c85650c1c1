/// What fingers feel: springs at the joints that press, nothing at the others, and nothing that comes or goes at once.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>
#include <initializer_list>
#include <limits>
#include <numbers>
#include <random>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <glissade/devices/safety_envelope.h>
#include <glissade/devices/simulated_glove.h>
#include <glissade/haptics/finger_forces.h>

#include "allocation_counter.h"
#include "delayed_wall.h"
#include "expect_bad_input.h"

namespace glissade::haptics {
namespace {

using hands::JointValues;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using test_support::expect_bad_input;

/// Both joints of a finger.
const FingerHand kRange = [] {
  FingerHand range;
  range.lower[0] = range.lower[1] = -1.0;
  range.upper[0] = range.upper[1] = 1.0;
  return range;
}();

enum Segment { kInner, kOuter };

/// A straight finger along x with two joints that bend it towards −z, at the origin and 50 mm farther; and something
/// below a segment, `distance` from the first joint.
FingerRow below(Segment segment, double distance, double gap = 0.0) {
  FingerRow row{.gap = gap};
  row.rates[0] = -distance;
  if (segment == kOuter) row.rates[1] = -(distance - 0.05);
  return row;
}

/// The visible finger is straight.
HandAnswer touching(std::initializer_list<FingerRow> rows) {
  HandAnswer hand;
  for (const FingerRow& row : rows)
    hand.row_array[static_cast<std::size_t>(hand.row_count++)] = row;
  return hand;
}

JointValues angles(double inner, double outer) {
  JointValues values{};
  values[0] = inner;
  values[1] = outer;
  return values;
}

FingerForces forces_of_simulated_glove() {
  return {kRange, devices::simulated_glove_descriptor()};
}

TEST(FingerForces, AreZeroWhileNothingTouches) {
  FingerForces forces = forces_of_simulated_glove();
  EXPECT_EQ(forces.update(angles(0.5, 0.3), touching({})), JointValues{});
}

TEST(FingerForces, PushBackTheJointsThatPressAndNoOthers) {
  FingerForces forces = forces_of_simulated_glove();
  const double stiffness = forces.stiffness();
  const HandAnswer at_inner = touching({below(kInner, 0.03)});
  const HandAnswer at_outer = touching({below(kOuter, 0.08)});
  EXPECT_EQ(forces.update(angles(0.004, 0.006), at_inner), angles(-stiffness * 0.004, 0.0));
  EXPECT_EQ(forces.update(angles(0.004, 0.006), at_outer), angles(-stiffness * 0.004, -stiffness * 0.006))
      << "both have to go back all the way";
  EXPECT_EQ(forces.update(angles(-0.004, -0.006), at_outer), JointValues{}) << "a finger that opens";
  EXPECT_EQ(forces.update(angles(0.004, -0.012), at_outer), JointValues{}) << "80 mm by 4, less 30 by 12";
}

// The outer joint lifts the finger by 30 mm times 12 mrad, so of 80 mm times 9 mrad a half is left.
TEST(FingerForces, TorqueProportionalToNetPenetration) {
  FingerForces forces = forces_of_simulated_glove();
  const HandAnswer at_outer = touching({below(kOuter, 0.08)});
  const JointValues torques = forces.update(angles(0.009, -0.012), at_outer);
  EXPECT_NEAR(torques[0], -forces.stiffness() * 0.0045, 1e-12);
  EXPECT_EQ(torques[1], 0.0);
}

TEST(FingerForces, AreSharedByTheJointsThatCloseAGapTogether) {
  FingerForces forces = forces_of_simulated_glove();
  // 80 mm by 4 mrad and 30 mm by 6 mrad, less the gap: 0.2 mm deep. By the least squares, in the ratio of the arms.
  const JointValues torques = forces.update(angles(0.004, 0.006), touching({below(kOuter, 0.08, 0.3e-3)}));
  const double multiplier = 0.2e-3 / (0.08 * 0.08 + 0.03 * 0.03);
  EXPECT_NEAR(torques[0], -forces.stiffness() * multiplier * 0.08, 1e-12);
  EXPECT_NEAR(torques[1], -forces.stiffness() * multiplier * 0.03, 1e-12);
}

// Springs of several joints at one contact must not be stiffer together than one alone, or they feed an oscillation:
// their matrix is symmetric, and its greatest eigenvalue that of one spring.
TEST(FingerForces, StiffnessMatrixIsSymmetricAndNoStifferThanOneJoint) {
  constexpr std::uint64_t kSeed = 8;
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int shared = 0;
  for (int i = 0; i < 2'000; ++i) {
    FingerRow row{.gap = 3e-3 * unit(random)};
    JointValues lags{};
    for (std::size_t j = 0; j < 3; ++j) {
      row.rates[j] = -0.01 - 0.08 * unit(random);
      lags[j] = 0.05 * unit(random);
    }
    const auto depths_at = [&](const JointValues& at) {
      JointValues depths{};
      deepen(row, at, depths);
      return Eigen::Vector3d(depths[0], depths[1], depths[2]);
    };
    constexpr double kStep_rad = 1e-7;
    Eigen::Matrix3d K;
    for (std::size_t j = 0; j < 3; ++j) {
      JointValues above = lags;
      above[j] += kStep_rad;
      K.col(static_cast<Eigen::Index>(j)) = (depths_at(above) - depths_at(lags)) / kStep_rad;
    }
    ASSERT_TRUE((K - K.transpose()).isZero(1e-5)) << "seed " << kSeed << ", " << i;
    const Eigen::Vector3d eigenvalues = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(K).eigenvalues();
    ASSERT_GE(eigenvalues[0], -1e-5) << "seed " << kSeed << ", " << i;
    ASSERT_LE(eigenvalues[2], 1.0 + 1e-5) << "seed " << kSeed << ", " << i;
    shared += K(0, 1) > 0.01 ? 1 : 0;
  }
  EXPECT_GT(shared, 500);
}

TEST(FingerForces, AreZeroUntilAGapIsClosed) {
  FingerForces forces = forces_of_simulated_glove();
  const HandAnswer contact = touching({below(kInner, 0.03, 30e-6)});
  EXPECT_EQ(forces.update(angles(0.9e-3, 0.0), contact), JointValues{});
  EXPECT_NEAR(forces.update(angles(1.1e-3, 0.0), contact)[0], -forces.stiffness() * 0.1e-3, 1e-12);
}

TEST(FingerForces, OfABlockedFingerAreAtTheDevicesLimit) {
  FingerForces forces = forces_of_simulated_glove();
  const double largest = devices::simulated_glove_descriptor().max_joint_torque;
  const HandAnswer contact = touching({below(kInner, 0.03)});
  EXPECT_EQ(forces.update(angles(0.5, 0.0), contact)[0], -largest);
  EXPECT_EQ(forces.update(angles(5.0, 0.0), contact)[0], -largest);
}

TEST(FingerForces, TorqueFallsToZeroAtShortArms) {
  FingerForces forces = forces_of_simulated_glove();
  const double full = forces.update(angles(0.004, 0.0), touching({below(kInner, 0.002)}))[0];
  EXPECT_NEAR(full, -forces.stiffness() * 0.004, 1e-12);
  EXPECT_NEAR(forces.update(angles(0.004, 0.0), touching({below(kInner, 0.0005)}))[0], 0.25 * full, 1e-12);
  EXPECT_EQ(forces.update(angles(0.004, 0.0), touching({below(kInner, 0.0)}))[0], 0.0);
}

TEST(FingerForces, FadeWithTheAgeOfTheContacts) {
  FingerForces forces = forces_of_simulated_glove();
  const HandAnswer contact = touching({below(kInner, 0.03)});
  const auto torque = [&](milliseconds age) { return forces.update(angles(0.5, 0.0), contact, age)[0]; };
  const double full = torque(milliseconds(0));
  EXPECT_EQ(torque(milliseconds(20)), full);
  EXPECT_NEAR(torque(milliseconds(60)), 0.5 * full, 1e-12);
  EXPECT_EQ(torque(milliseconds(100)), 0.0);
  EXPECT_EQ(torque(milliseconds(5000)), 0.0);
}

TEST(FingerForces, AreZeroForAnglesThatAreNotFinite) {
  FingerForces forces = forces_of_simulated_glove();
  const HandAnswer contact = touching({below(kInner, 0.03)});
  EXPECT_EQ(forces.update(angles(0.5, std::numeric_limits<double>::quiet_NaN()), contact), JointValues{});
  EXPECT_NE(forces.update(angles(0.5, 0.0), contact), JointValues{});
}

TEST(FingerForces, AskNothingOfAJointThatTheDeviceDoesNotHave) {
  devices::DeviceDescriptor device = devices::simulated_glove_descriptor();
  device.joint_lower[0] = device.joint_upper[0] = 0.0;
  FingerForces forces(kRange, device);
  const JointValues torques = forces.update(angles(0.1, 0.1), touching({below(kOuter, 0.08)}));
  EXPECT_EQ(torques[0], 0.0);
  EXPECT_LT(torques[1], 0.0);
}

TEST(FingerForces, RefuseLimitsThatAreNoRange) {
  FingerHand limits = kRange;
  limits.lower[3] = 0.2;
  expect_bad_input([&] { FingerForces(limits, devices::simulated_glove_descriptor()); }, {"joint 3", "no range"});
}

// A millionth of a radian changes no torque by more than the largest ratio of two arms: 80 mm by the 2 mm from which on
// a contact counts wholly.
TEST(FingerForces, AreContinuous) {
  constexpr std::uint64_t kSeed = 5;
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  FingerForces forces = forces_of_simulated_glove();
  const HandAnswer contacts = touching({below(kInner, 0.03, 20e-6), below(kOuter, 0.08), below(kOuter, 0.051, 50e-6)});
  const double steepest = forces.stiffness() * 0.08 / 0.002;
  int pressing = 0;
  for (int i = 0; i < 20'000; ++i) {
    constexpr double kStep_rad = 1e-6;
    const double inner = 0.02 * unit(random);
    const double outer = 0.02 * unit(random);
    const JointValues here = forces.update(angles(inner, outer), contacts);
    const JointValues there =
        forces.update(angles(inner + kStep_rad * unit(random), outer + kStep_rad * unit(random)), contacts);
    for (std::size_t v = 0; v < 2; ++v)
      ASSERT_LE(std::abs(there[v] - here[v]), 2.0 * steepest * kStep_rad)
          << inner << ", " << outer << ", seed " << kSeed;
    pressing += here == JointValues{} ? 0 : 1;
  }
  EXPECT_GT(pressing, 5'000);
}

TEST(FingerForces, AllocateNothing) {
  if (!test_support::allocations_are_counted()) GTEST_SKIP();
  FingerForces forces = forces_of_simulated_glove();
  const HandAnswer contacts = touching({below(kInner, 0.03), below(kOuter, 0.08)});
  const std::int64_t allocations = test_support::allocations_of_this_thread();
  for (int i = 0; i < 100; ++i) {
    forces.set_link_delay(milliseconds(i));
    forces.update(angles(0.01 * i, 0.0), contacts);
  }
  EXPECT_EQ(test_support::allocations_of_this_thread(), allocations);
}

// A finger of 0.04 kg m², a hundredth of the mass there with a hundredth of the friction.
TEST(FingerStiffness, IsTheStabilityLimitOfAHeavyFinger) {
  const devices::DeviceDescriptor device = devices::simulated_glove_descriptor();
  for (const milliseconds delay : {milliseconds(1), milliseconds(5), milliseconds(20), milliseconds(50)}) {
    const double low = test_support::stiffness_that_grows(100.0 * device.joint_damping, delay) / 100.0;
    const double limit = finger_stiffness(device, milliseconds(1), delay);
    EXPECT_NEAR(limit / low, 1.0, 0.1) << delay.count() << " ms of delay: " << limit << " and " << low << " Nm/rad";
  }
}

/// A finger of some inertia whose first joint touches something at angle 0; its wearer moves it at random. The torques
/// come as late as the link makes them.
class DelayedFinger {
 public:
  DelayedFinger(std::mt19937_64& random, milliseconds delay)
      : forces_(kRange, devices::simulated_glove_descriptor()),
        on_their_way_(static_cast<std::size_t>(delay.count()), 0.0) {
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    inertia_ = std::pow(10.0, -5.0 + 2.0 * unit(random));
    muscle_ = 0.1 + 2.0 * unit(random);
    friction_ = 0.02 * unit(random);
    rate_ = 5.0 + 60.0 * unit(random);
    forces_.set_link_delay(delay);
  }

  /// One millisecond. Returns the energy (J) that the finger has put into the glove so far, against torque and
  /// friction.
  double step() {
    const HandAnswer contact = touching({below(kInner, 0.03)});
    on_their_way_.push_back(forces_.update(angles(angle_, 0.0), contact)[0]);
    const double torque = on_their_way_.front();
    on_their_way_.pop_front();
    for (int i = 0; i < 50; ++i) {
      constexpr double kStep_s = 2e-5;
      time_ += kStep_s;
      const double will = 0.2 * std::sin(rate_ * time_) + 0.1 * std::sin(2.7 * rate_ * time_);
      const double muscles = muscle_ * (will - angle_) - friction_ * speed_;
      // Friction without a limit of the step, by its implicit form.
      const double damping = devices::kJointDamping;
      speed_ = (speed_ + kStep_s / inertia_ * (muscles + torque)) / (1.0 + kStep_s / inertia_ * damping);
      angle_ += kStep_s * speed_;
      energy_ += kStep_s * (damping * speed_ - torque) * speed_;
    }
    return energy_;
  }

 private:
  FingerForces forces_;
  std::deque<double> on_their_way_;
  double inertia_;
  double muscle_;
  double friction_;
  double rate_;
  double time_ = 0.0;
  double angle_ = -0.05;
  double speed_ = 0.0;
  double energy_ = 0.0;
};

TEST(FingerStiffness, GivesNoFingerMoreEnergyThanItPutIn) {
  constexpr std::uint64_t kSeed = 3;
  std::mt19937_64 random(kSeed);
  for (int i = 0; i < 100; ++i) {
    const milliseconds delay(random() % 20);
    DelayedFinger finger(random, delay);
    for (int ms = 0; ms < 1000; ++ms)
      ASSERT_GE(finger.step(), -1e-6) << i << ", " << delay.count() << " ms of delay, after " << ms << " ms, seed "
                                      << kSeed;
  }
}

// The envelope lets a torque change by so much a period; a spring that outran it would lag behind the finger, and feed
// its rattling.
TEST(FingerStiffness, LetsAFingerThatTapsComeToRest) {
  const devices::DeviceDescriptor device = devices::simulated_glove_descriptor();
  for (const double rate : {0.0, 20.0, 70.0}) {  // Nm/s; 0: that of the descriptor
    for (const double inertia : {3e-5, 1e-4, 3e-4}) {
      devices::DeviceDescriptor limited = device;
      limited.max_joint_torque_rate = rate;
      FingerForces forces(kRange, limited);
      devices::SafetyEnvelope envelope(limited);
      devices::GloveState state;
      double angle = -0.2;
      double speed = 10.0;
      double torque = 0.0;
      double least = 0.0;
      double greatest = -limited.max_joint_torque;
      for (int ms = 1; ms <= 3000; ++ms) {
        for (int i = 0; i < 20; ++i) {
          constexpr double kStep_s = 5e-5;
          const double muscles = 0.3 - 0.5 * angle - 0.005 * speed;
          speed = (speed + kStep_s / inertia * (muscles + torque)) / (1.0 + kStep_s / inertia * device.joint_damping);
          angle += kStep_s * speed;
        }
        state.time = milliseconds(ms);
        ++state.sequence;
        state.joint_angles[0] = angle;
        devices::GloveCommand command;
        command.state_time = state.time;
        command.joint_torques = forces.update(state.joint_angles, touching({below(kInner, 0.03)}));
        torque = envelope.limit(command, state, state.time).values().joint_torques[0];
        if (ms < 2000) continue;
        least = std::min(least, torque);
        greatest = std::max(greatest, torque);
      }
      EXPECT_LT(least, -0.2) << "it presses";
      EXPECT_LT(greatest - least, 0.01) << "and rests: " << rate << " Nm/s, " << inertia << " kg m²";
    }
  }
}

TEST(FingerStiffness, GivesTheLargestTorqueWithinADegreeWhereThatIsPassive) {
  devices::DeviceDescriptor device = devices::simulated_glove_descriptor();
  const double wanted = device.max_joint_torque / (0.8 * std::numbers::pi / 180.0);
  EXPECT_DOUBLE_EQ(finger_stiffness(device, milliseconds(1), nanoseconds(0)), wanted);
  device.joint_damping = 0.0;  // not known
  EXPECT_DOUBLE_EQ(finger_stiffness(device, milliseconds(1), nanoseconds(0)), wanted);
  EXPECT_DOUBLE_EQ(finger_stiffness(device, milliseconds(1), milliseconds(50)), wanted * 0.5 / 50.5);
}

/// The greatest change of the torque in the last half of two seconds in which a finger with Coulomb friction presses
/// with 0.3 Nm on a spring that knows its angle in steps.
double buzz(double stiffness, const devices::DeviceDescriptor& device) {
  constexpr double kInertia = 1e-4;  // kg m²
  constexpr double kStep_s = 1e-5;
  double angle = 0.0;
  double speed = 0.0;
  double torque = 0.0;
  double least = 1e9;
  double greatest = -1e9;
  for (int i = 0; i < 200'000; ++i) {
    if (i % 100 == 0) torque = -stiffness * device.joint_resolution * std::floor(angle / device.joint_resolution);
    const double friction = device.joint_friction / kInertia * kStep_s;
    speed = (speed + (0.3 + torque) / kInertia * kStep_s) / (1.0 + device.joint_damping / kInertia * kStep_s);
    speed -= std::clamp(speed, -friction, friction);
    angle += kStep_s * speed;
    if (i < 100'000) continue;
    least = std::min(least, torque);
    greatest = std::max(greatest, torque);
  }
  return greatest - least;
}

TEST(FingerStiffness, IsLimitedByFrictionForCoarseAngles) {
  devices::DeviceDescriptor device = devices::simulated_glove_descriptor();
  device.joint_resolution = 5e-3;
  for (const double friction : {0.01, 0.02, 0.05}) {
    device.joint_friction = friction;
    const double stiffness = finger_stiffness(device, milliseconds(1), nanoseconds(0));
    EXPECT_EQ(buzz(stiffness, device), 0.0) << friction;
    EXPECT_GT(buzz(8.0 * stiffness, device), 0.0) << friction;
  }
}

}  // namespace
}  // namespace glissade::haptics
