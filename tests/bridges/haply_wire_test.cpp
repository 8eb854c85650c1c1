/// The wire to Haply's devices against an emulated service.

#include <chrono>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glissade/bridges/haply_check.h>
#include <glissade/bridges/haply_emulator.h>
#include <glissade/bridges/haply_wire.h>
#include <glissade/devices/glove_model.h>
#include <glissade/realtime/clock.h>

#include "eventually.h"
#include "safe_command.h"

namespace glissade::bridges {
namespace {

using Eigen::Vector3d;
using std::chrono::milliseconds;
using testing::HasSubstr;

/// A force that a server wants, after all of the envelope's caution.
devices::SafeCommand pushing(const Vector3d& f_H_W) {
  devices::GloveCommand wanted;
  wanted.f_H_W = f_H_W;
  return test_support::safe_command(wanted, devices::descriptor_of(devices::read_glove_model(kInverse3Preset)));
}

/// Turns of the bridge until `condition` holds, for at most ten seconds.
template <typename Condition>
bool turns_until(HaplyWire& wire, devices::GloveState& state, const devices::SafeCommand& command,
                 Condition condition) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    wire.read(state);
    wire.write(command);
  }
  return true;
}

/// Turns until the wire fails; what it says.
std::string failure_of(HaplyWire& wire, const devices::SafeCommand& command = {}) {
  devices::GloveState state;
  try {
    turns_until(wire, state, command, [] { return false; });
  } catch (const WireError& error) {
    return error.what();
  }
  return "nothing";
}

std::string failure_to_open(HaplyWire& wire) {
  try {
    wire.open();
  } catch (const WireError& error) {
    return error.what();
  }
  return "nothing";
}

TEST(HaplyWire, ReadsThePoseOfTheTipInTheWorld) {
  HaplyEmulator service({});
  Eigen::Isometry3d X_WD(Eigen::AngleAxisd(M_PI / 2, Vector3d::UnitZ()));
  X_WD.translation() = Vector3d(1.0, 0.0, 0.0);
  HaplyWire wire({.service = service.service(), .X_WD = X_WD});
  wire.open();
  devices::GloveState state;
  ASSERT_TRUE(turns_until(wire, state, {}, [&] { return wire.traffic().states > 5; }));
  const Vector3d expected(1.12, 0.0, 0.15);  // the hand rests at (0, -0.12, 0.15) in the device
  EXPECT_LT((state.X_WH.translation() - expected).norm(), 1e-4) << state.X_WH.translation().transpose();
  EXPECT_LT((state.X_WH.linear() - X_WD.linear()).norm(), 1e-9);
  EXPECT_LT(expected.norm(), wire.descriptor().workspace_radius);
}

TEST(HaplyWire, PushesTheHandInTheDirectionOfTheWorld) {
  for (const bool is_before_3_5 : {true, false}) {
    HaplyEmulator service({.is_before_3_5 = is_before_3_5});
    const Eigen::Isometry3d X_WD(Eigen::AngleAxisd(M_PI / 2, Vector3d::UnitZ()));
    HaplyWire wire({.service = service.service(), .X_WD = X_WD});
    wire.open();
    devices::GloveState state;
    ASSERT_TRUE(turns_until(wire, state, pushing({2, 0, 0}), [&] { return service.state().f_C_D.norm() > 1.9; }));
    EXPECT_LT((service.state().f_C_D - Vector3d(0, -2, 0)).norm(), 0.01) << service.state().f_C_D.transpose();
    EXPECT_TRUE(turns_until(wire, state, pushing({2, 0, 0}), [&] { return service.state().p_DC.y() < -0.122; }));
    EXPECT_EQ(service.state().other_messages, 0) << "the key of another version";
    EXPECT_EQ(wire.traffic().exerted_H_W.has_value(), !is_before_3_5);
  }
}

TEST(HaplyWire, ClosesTheHandWithAButton) {
  devices::SimulatedGloveParameters parameters;
  parameters.starts_closed = false;
  parameters.grip_changes = {milliseconds(300), milliseconds(600)};
  HaplyEmulatorOptions options;
  options.hand =
      devices::SimulatedGlove(geometry::PoseTrajectory({{milliseconds(0), Eigen::Isometry3d::Identity()},
                                                        {std::chrono::seconds(5), Eigen::Isometry3d::Identity()}}),
                              parameters, devices::read_glove_model(kInverse3Preset));
  HaplyEmulator service(options);
  HaplyWire wire({.service = service.service()});
  wire.open();
  devices::GloveState state;
  EXPECT_TRUE(turns_until(wire, state, {}, [&] { return state.grip == 2; }));
  EXPECT_TRUE(turns_until(wire, state, {}, [&] { return state.grip == 3; })) << "closed";
  EXPECT_TRUE(turns_until(wire, state, {}, [&] { return state.grip == 4; })) << "open again";
}

TEST(HaplyWire, KeepsTheHandClosedWithoutAHandle) {
  HaplyEmulator service({.has_handle = false});
  HaplyWire wire({.service = service.service()});
  wire.open();
  devices::GloveState state;
  ASSERT_TRUE(turns_until(wire, state, {}, [&] { return wire.traffic().states > 5; }));
  EXPECT_EQ(state.grip, 1);
  EXPECT_FALSE(wire.traffic().handle);
}

TEST(HaplyWire, ExchangesAThousandMessagesASecondAndNoMore) {
  HaplyEmulator service({});
  HaplyWire wire({.service = service.service()});
  wire.open();
  devices::GloveState state;
  const auto end = std::chrono::steady_clock::now() + milliseconds(500);
  turns_until(wire, state, {}, [&] { return std::chrono::steady_clock::now() > end; });
  EXPECT_LE(wire.traffic().states, 510);
}

TEST(HaplyWire, TurnsTheDampingOfTheServiceOff) {
  HaplyEmulator service({.filters = {.damping_N_s_per_m = 5.0}});
  HaplyWire wire({.service = service.service()});
  wire.open();
  devices::GloveState state;
  ASSERT_TRUE(turns_until(wire, state, pushing({3, 0, 0}), [&] { return service.state().p_DC.x() > 0.001; }));
  EXPECT_LT((service.state().f_C_D - Vector3d(3, 0, 0)).norm(), 1e-6) << "while the hand moves";
}

TEST(HaplyWire, TellsAForceThatTheServiceChanges) {
  HaplyEmulator service({.filters = {.force_scale = 0.5}});
  HaplyWire wire({.service = service.service()});
  wire.open();
  devices::GloveState state;
  ASSERT_TRUE(turns_until(wire, state, pushing({2, 0, 0}),
                          [&] { return wire.traffic().exerted_H_W.value_or(Vector3d::Zero()).norm() > 0.9; }));
  EXPECT_NEAR(wire.traffic().exerted_H_W->norm(), 1.0, 0.01);
  EXPECT_NEAR(wire.traffic().f_H_W.norm(), 2.0, 0.01);
}

TEST(HaplyWire, LetsGoAtItsEndAndAtRelease) {
  HaplyEmulator service({});
  {
    HaplyWire wire({.service = service.service()});
    for (int i = 0; i < 2; ++i) {
      wire.open();
      devices::GloveState state;
      ASSERT_TRUE(turns_until(wire, state, pushing({2, 0, 0}), [&] { return service.state().f_C_D.norm() > 1.9; }));
      if (i == 0) wire.release();
      if (i == 0) EXPECT_TRUE(eventually([&] { return service.state().f_C_D.isZero(0.0); }, milliseconds(100)));
    }
  }
  EXPECT_TRUE(eventually([&] { return service.state().f_C_D.isZero(0.0); }, milliseconds(100)));
}

TEST(HaplyWire, LivesWithGarbageAndHalfMessages) {
  HaplyEmulator service({.faults = {.garbage = 0.3, .cut = 0.3}});
  HaplyWire wire({.service = service.service()});
  wire.open();
  devices::GloveState state;
  EXPECT_TRUE(turns_until(wire, state, pushing({2, 0, 0}), [&] { return wire.traffic().states > 50; }));
  EXPECT_GT(wire.traffic().refused, 10);
  EXPECT_GT(service.state().f_C_D.norm(), 1.9);
}

TEST(HaplyWire, SaysWhatIsWrongWithMessagesThatAreNone) {
  HaplyEmulator service({.faults = {.cut = 1.0}});
  HaplyWire wire({.service = service.service()});
  wire.open();
  EXPECT_THAT(failure_of(wire), HasSubstr("its messages are no states: the message is no JSON"));
}

// The time of a state is that of its measurement, so slow answers cannot make an old state look new.
TEST(HaplyWire, DatesASlowAnswerBack) {
  HaplyEmulator service({.faults = {.delay = milliseconds(50)}});
  HaplyWire wire({.service = service.service()});
  wire.open();
  const realtime::SteadyClock clock;
  devices::GloveState state;
  ASSERT_TRUE(turns_until(wire, state, {}, [&] { return wire.traffic().states == 2; }));
  EXPECT_GE(clock.now() - state.time, milliseconds(50));
}

TEST(HaplyWire, IsOpenedAgainWhileAnAnswerIsAwaited) {
  HaplyEmulator service({.faults = {.delay = milliseconds(50)}});
  HaplyWire wire({.service = service.service()});
  devices::GloveState state;
  for (int i = 0; i < 3; ++i) {
    wire.open();
    EXPECT_FALSE(wire.read(state)) << "the answer takes longer than a read waits";
    wire.release();
  }
  wire.open();
  EXPECT_TRUE(turns_until(wire, state, {}, [&] { return wire.traffic().states == 1; }));
}

TEST(HaplyWire, SaysThatAServiceIsSilent) {
  HaplyEmulator service({.faults = {.delay = std::chrono::seconds(10)}});
  HaplyWire wire({.service = service.service()});
  wire.open();
  EXPECT_THAT(failure_of(wire), HasSubstr("it answers no more"));
}

TEST(HaplyWire, ComesBackEachTimeTheDeviceIsPluggedInAgain) {
  HaplyEmulator service({});
  HaplyWire wire({.service = service.service()});
  devices::GloveState state;
  constexpr int kTimes = 20;
  for (int i = 0; i < kTimes; ++i) {
    wire.open();
    ASSERT_TRUE(turns_until(wire, state, pushing({2, 0, 0}), [&] { return service.state().f_C_D.norm() > 1.9; })) << i;
    service.unplug();
    EXPECT_THAT(failure_of(wire, pushing({2, 0, 0})), HasSubstr("is it plugged in"));
    wire.release();
    EXPECT_THAT(failure_to_open(wire), HasSubstr("is it plugged in"));
    wire.release();
    service.plug();
  }
  EXPECT_TRUE(service.state().f_C_D.isZero(0.0)) << "nothing lasts from before";
}

TEST(HaplyWire, ComesBackAfterTheServiceWasStartedAgain) {
  HaplyEmulator service({});
  HaplyWire wire({.service = service.service()});
  devices::GloveState state;
  wire.open();
  ASSERT_TRUE(turns_until(wire, state, {}, [&] { return wire.traffic().states > 5; }));
  service.stop_service();
  EXPECT_THAT(failure_of(wire), HasSubstr("has ended or was started again"));
  wire.release();
  EXPECT_THAT(failure_to_open(wire), HasSubstr("nothing listens there"));
  service.start_service();
  wire.open();
  EXPECT_TRUE(turns_until(wire, state, {}, [&] { return wire.traffic().states > 5; }));
}

TEST(HaplyWire, RefusesADeviceThatIsNotCalibrated) {
  HaplyEmulator service({});
  HaplyWire wire({.service = service.service()});
  service.set_calibrated(false);
  EXPECT_THAT(failure_to_open(wire), HasSubstr("device 049D is not calibrated"));
  service.set_calibrated(true);
  wire.open();
  service.set_calibrated(false);
  EXPECT_THAT(failure_of(wire), HasSubstr("device 049D is not calibrated"));
}

TEST(HaplyWire, LooksUpNoNames) {
  EXPECT_THROW(HaplyWire({.service = "haply.example"}), std::invalid_argument);
  EXPECT_THROW(HaplyWire({.service = "localhost:0"}), std::invalid_argument);
  EXPECT_THROW(HaplyWire({.service = "127.0.0.1:65536"}), std::invalid_argument);
}

/// All that the check says about a service.
std::string findings(const HaplyOptions& options, bool expected) {
  std::string text;
  EXPECT_EQ(check_haply(
                options, [] { return true; }, [&](const std::string& line) { text += line + "\n"; }),
            expected);
  return text;
}

TEST(HaplyCheck, TellsVersionDeviceFiltersAndRate) {
  HaplyEmulator service({});
  const std::string text = findings({.service = service.service()}, true);
  EXPECT_THAT(text, HasSubstr("version 3.5.0.0"));
  EXPECT_THAT(text, HasSubstr("049D  inverse3, hardware 7"));
  EXPECT_THAT(text, HasSubstr("61548  wireless VerseGrip"));
  EXPECT_THAT(text, HasSubstr("force gate has a gain of 0.3"));
  EXPECT_THAT(text, HasSubstr("0.000 -0.120 0.150 m in the world"));
  EXPECT_THAT(text, HasSubstr("0 messages that were no states"));
  EXPECT_TRUE(service.state().f_C_D.isZero(0.0));
}

TEST(HaplyCheck, SaysWhatIsWrong) {
  HaplyEmulator service({.is_before_3_5 = true});
  service.unplug();
  EXPECT_THAT(findings({.service = service.service()}, false), HasSubstr("is it plugged in"));
  service.stop_service();
  EXPECT_THAT(findings({.service = service.service()}, false), HasSubstr("is Haply's Inverse Service running"));
}

TEST(HaplyCheck, ListsTheDevices) {
  HaplyEmulator service({});
  service.set_calibrated(false);
  std::string text;
  list_haply_devices(service.service(), [&](const std::string& line) { text += line + "\n"; });
  EXPECT_THAT(text, HasSubstr("049D  inverse3"));
  EXPECT_THAT(text, HasSubstr("not calibrated"));
}

}  // namespace
}  // namespace glissade::bridges
