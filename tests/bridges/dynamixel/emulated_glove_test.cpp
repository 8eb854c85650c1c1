/// Servos at the fingers of a model: gear, friction and backlash between motor and finger.

#include "dynamixel/emulated_glove.h"

#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "hand/finger_curls.h"

namespace glissade::bridges::dynamixel {
namespace {

using std::chrono::milliseconds;

constexpr int kIndexMcp = 4;
constexpr int kMiddleMcp = 7;

class GloveOfTwoServos : public testing::Test {
 protected:
  GloveOfTwoServos() {
    hand_.servos = {{.id = 1, .joint = kIndexMcp, .zero = 3.0}, {.id = 2, .joint = kMiddleMcp, .ratio = -0.5}};
    devices::GloveModel model = model_of(hand_);
    model.wearer.tremor = 0.0;
    friction_ = model.actuator.coulomb_friction;
    // A relaxed hand, without the reflex: its stiffness is a closed form.
    model.wearer.reflex_gain = 0.0;
    stiffness_ = model.wearer.stiffness + model.wearer.stiffness_per_grip * model.wearer.open_grip;
    glove_ = emulate(hand_, model, [this](std::chrono::nanoseconds) { return angles_of(wanted_); });
  }

  void run_for(milliseconds time) {
    now_ += time;
    glove_.bus->send_until(now_);
  }
  EmulatedServo& servo(std::uint8_t id) { return glove_.bus->servo(id); }
  void hold(std::uint8_t id, std::int64_t current, std::int64_t position) {
    const auto write = [&](const Register& to, std::int64_t value) {
      ASSERT_EQ(servo(id).write(to.address, encode_register(to, value)), StatusError::kNone) << to.name;
    };
    write(kOperatingMode, kCurrentBasedPosition);
    write(kTorqueEnable, 1);
    write(kGoalCurrent, current);
    write(kGoalPosition, position);
  }
  double index_angle() { return servo(1).load().angle() - 3.0; }
  double middle_angle() { return -0.5 * servo(2).load().angle(); }

  DynamixelHand hand_;
  FingerValues wanted_{};
  double friction_ = 0.0;   // Nm
  double stiffness_ = 0.0;  // Nm/rad
  ServoGlove glove_;
  std::chrono::nanoseconds now_{0};
};

TEST_F(GloveOfTwoServos, FreeFingersTurnTheHornsAgainstTheFriction) {
  wanted_ = {0, 0.5, 0.5, 0, 0};
  run_for(milliseconds(2000));
  const double wanted = angles_of(wanted_)[kIndexMcp];
  EXPECT_NEAR(index_angle(), wanted, friction_ / stiffness_ + 0.01) << "where the friction holds the wearer's spring";
  EXPECT_GT(std::abs(index_angle() - wanted), 0.01);
  EXPECT_NEAR(middle_angle(), index_angle(), 1e-3) << "half as fast a horn, the other way round";
}

TEST_F(GloveOfTwoServos, ServoHoldsAFingerWithItsCapOfCurrent) {
  hold(1, 50, to_counts(kGoalPosition, 3.0));
  hold(2, 0, 0);
  wanted_ = {0, 0.8, 0.8, 0, 0};
  run_for(milliseconds(3000));
  // The servo pulls with its whole cap, which is less than the wearer's grip. The friction holds the rest, either way.
  const double cap = 0.05 * torque_per_current(*find_model(hand_.model));
  EXPECT_NEAR(servo(1).torque(), -cap, 1e-3);
  const double wanted = angles_of(wanted_)[kIndexMcp];
  EXPECT_NEAR(index_angle(), wanted - cap / stiffness_, friction_ / stiffness_ + 0.02);
  EXPECT_GT(middle_angle(), wanted - friction_ / stiffness_ - 0.01) << "the other finger is free";
}

}  // namespace
}  // namespace glissade::bridges::dynamixel
