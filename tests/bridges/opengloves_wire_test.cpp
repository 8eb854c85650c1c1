/// The wire of OpenGloves against an emulated glove.

#include <atomic>
#include <chrono>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glissade/bridges/opengloves_check.h>
#include <glissade/bridges/opengloves_emulator.h>
#include <glissade/bridges/opengloves_wire.h>
#include <glissade/realtime/clock.h>

#include "eventually.h"
#include "hand/finger_curls.h"
#include "temporary_folder.h"

namespace glissade::bridges {
namespace {

using enum OpenGlovesEncoding;
using std::chrono::milliseconds;
using testing::HasSubstr;

constexpr std::size_t kIndexJoint = 4;  // its mcp

/// A wearer who holds the fingers still.
OpenGlovesEmulatorOptions still(const FingerValues& curls) {
  OpenGlovesEmulatorOptions options;
  options.model.wearer.tremor = 0.0;
  options.wearer = [curls](std::chrono::nanoseconds) { return angles_of(curls); };
  return options;
}

/// A command of a server that stops the index finger at this curl, after all of the envelope's caution.
devices::SafeCommand index_limit(double curl) {
  devices::SafetyEnvelope envelope(opengloves_descriptor());
  devices::SafeCommand safe;
  constexpr int kPeriods = 60;
  for (int i = 1; i <= kPeriods; ++i) {
    const std::chrono::nanoseconds now = i * milliseconds(16);
    devices::GloveState state;
    state.sequence = i;
    state.time = now;
    devices::GloveCommand wanted;
    wanted.sequence = wanted.state_sequence = i;
    wanted.state_time = now;
    const double upper = angles_of({0, curl, 0, 0, 0})[kIndexJoint];
    wanted.joint_limits.joints[kIndexJoint] = {.upper = upper, .stiffness = 1.0, .max_torque = 0.5};
    safe = envelope.limit(wanted, state, now);
  }
  return safe;
}

/// Turns of the bridge until `condition` holds, for at most ten seconds.
template <typename Condition>
bool turns_until(OpenGlovesWire& wire, devices::GloveState& state, const devices::SafeCommand& command,
                 Condition condition) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    wire.read(state);
    wire.write(command);
  }
  return true;
}

TEST(OpenGlovesWire, ReadsTheFingers) {
  for (const auto encoding : {kAlpha, kLegacy}) {
    OpenGlovesEmulatorOptions options = still({0.0, 0.5, 0.25, 0.0, 1.0});
    options.encoding = encoding;
    OpenGlovesEmulator glove(options);
    OpenGlovesWire wire({.port = glove.port()});
    wire.open();
    devices::GloveState state;
    const double half = angles_of({0, 0.5, 0, 0, 0})[kIndexJoint];
    EXPECT_TRUE(turns_until(wire, state, {}, [&] { return std::abs(state.joint_angles[kIndexJoint] - half) < 0.01; }));
    EXPECT_EQ(wire.traffic().encoding, encoding);
    const realtime::SteadyClock clock;
    EXPECT_LT(clock.now() - state.time, std::chrono::seconds(5));
    EXPECT_EQ(state.grip, 1) << "a hand that tells nothing stays closed";
  }
}

TEST(OpenGlovesWire, StopsAFingerAtItsLimit) {
  OpenGlovesEmulator glove(still({0.9, 0.9, 0.9, 0.9, 0.9}));
  OpenGlovesWire wire({.port = glove.port()});
  wire.open();
  devices::GloveState state;
  // The server sees the contact before the finger is there.
  EXPECT_TRUE(turns_until(wire, state, index_limit(0.95), [&] { return glove.state().limits[1] > 0; }));
  EXPECT_TRUE(turns_until(wire, state, {}, [&] { return glove.state().limits[1] == 0; }));
}

TEST(OpenGlovesWire, HoldsTheFingerButNotTheOthers) {
  std::atomic<double> wanted = 0.1;
  OpenGlovesEmulatorOptions options;
  options.wearer = [&](std::chrono::nanoseconds) {
    const double curl = wanted;
    return angles_of({curl, curl, curl, curl, curl});
  };
  OpenGlovesEmulator glove(options);
  OpenGlovesWire wire({.port = glove.port()});
  wire.open();
  devices::GloveState state;
  const devices::SafeCommand at_half = index_limit(0.5);
  ASSERT_TRUE(turns_until(wire, state, at_half, [&] { return glove.state().limits[1] >= 495; }));
  const auto end = std::chrono::steady_clock::now() + milliseconds(500);
  turns_until(wire, state, at_half, [&] { return std::chrono::steady_clock::now() > end; });  // servos are slow
  wanted = 0.9;
  EXPECT_TRUE(turns_until(wire, state, at_half, [&] { return glove.state().curls[2] > 0.85; }));
  EXPECT_NEAR(glove.state().curls[1], 0.5, 0.05) << "the string stretches";
}

TEST(OpenGlovesWire, KeepsAGloveTalkingThatWaitsForEachLine) {
  OpenGlovesEmulatorOptions options = still({});
  options.line_patience = std::chrono::hours(1);
  OpenGlovesEmulator glove(options);
  OpenGlovesWire wire({.port = glove.port()});
  wire.open();
  devices::GloveState state;
  EXPECT_TRUE(turns_until(wire, state, {}, [&] { return wire.traffic().states >= 20; }));
}

TEST(OpenGlovesWire, SaysNothingBeforeItKnowsTheEncoding) {
  OpenGlovesEmulatorOptions options = still({});
  options.encoding = kLegacy;
  OpenGlovesEmulator glove(options);
  OpenGlovesWire wire({.port = glove.port()});
  wire.open();
  devices::GloveState state;
  EXPECT_TRUE(turns_until(wire, state, {}, [&] { return glove.state().limit_lines > 10; }));
  EXPECT_EQ(glove.state().other_lines, 0) << "lines of the other encoding move servos to any place";
}

TEST(OpenGlovesWire, LivesWithGarbageHalfLinesAndEchoes) {
  OpenGlovesEmulatorOptions options = still({0.5, 0.5, 0.5, 0.5, 0.5});
  options.faults = {.garbage = 0.3, .cut = 0.3, .has_echo = true};
  OpenGlovesEmulator glove(options);
  OpenGlovesWire wire({.port = glove.port()});
  wire.open();
  devices::GloveState state;
  const devices::SafeCommand at_most = index_limit(0.8);
  EXPECT_TRUE(turns_until(wire, state, at_most, [&] { return wire.traffic().states > 40; }));
  EXPECT_GT(wire.traffic().refused, 10);
  EXPECT_TRUE(turns_until(wire, state, at_most, [&] { return glove.state().limits[1] > 150; }));
}

TEST(OpenGlovesWire, ReleasesAtItsEndAndAtRelease) {
  OpenGlovesEmulator glove(still({}));
  {
    OpenGlovesWire wire({.port = glove.port()});
    for (int i = 0; i < 2; ++i) {
      wire.open();
      devices::GloveState state;
      ASSERT_TRUE(turns_until(wire, state, index_limit(0.5), [&] { return glove.state().limits[1] > 450; }));
      if (i == 0) wire.release();
      if (i == 0) EXPECT_TRUE(eventually([&] { return glove.state().limits[1] == 0; }));
    }
  }
  EXPECT_TRUE(eventually([&] { return glove.state().limits[1] == 0; }));
}

TEST(OpenGlovesWire, IsReleasedWhileTheBridgeHangs) {
  OpenGlovesEmulator glove(still({}));
  OpenGlovesWire wire({.port = glove.port()});
  wire.open();
  devices::GloveState state;
  ASSERT_TRUE(turns_until(wire, state, index_limit(0.5), [&] { return glove.state().limits[1] > 450; }));
  EXPECT_TRUE(eventually([&] { return glove.state().limits[1] == 0; })) << "nobody calls the wire";
  EXPECT_TRUE(turns_until(wire, state, index_limit(0.5), [&] { return glove.state().limits[1] > 450; }));
}

/// A command without limits, which the envelope makes fade because it is old.
devices::SafeCommand fading_index_limit() {
  devices::SafetyEnvelope envelope(opengloves_descriptor());
  devices::GloveState state;
  state.time = milliseconds(1);
  devices::GloveCommand wanted;
  const double upper = angles_of({0, 0.5, 0, 0, 0})[kIndexJoint];
  wanted.joint_limits.joints[kIndexJoint] = {.upper = upper, .stiffness = 1.0, .max_torque = 0.5};
  devices::SafeCommand safe;
  for (int i = 1; i <= 70; ++i) {
    const milliseconds now = i * milliseconds(16);
    state.sequence = i;
    state.time = now;
    if (i < 70) wanted.state_time = now;
    if (i == 70) wanted.state_time = milliseconds(1);
    safe = envelope.limit(wanted, state, now);
  }
  return safe;
}

TEST(OpenGlovesWire, OpensAllLimitsAtOnceWhenACommandFades) {
  const devices::SafeCommand fading = fading_index_limit();
  ASSERT_TRUE(fading.reasons().is_fading());
  ASSERT_GT(fading.values().joint_limits.joints[kIndexJoint].max_torque, 0.0) << "the fade has only begun";
  OpenGlovesEmulator glove(still({}));
  OpenGlovesWire wire({.port = glove.port()});
  wire.open();
  devices::GloveState state;
  ASSERT_TRUE(turns_until(wire, state, index_limit(0.5), [&] { return glove.state().limits[1] > 450; }));
  EXPECT_TRUE(turns_until(wire, state, fading, [&] { return glove.state().limits[1] == 0; }));
}

TEST(OpenGlovesWire, SendsNoMoreLinesThanTheFirmwareReads) {
  OpenGlovesEmulatorOptions options = still({});
  options.rate_Hz = 30.0;  // slower than the commands
  OpenGlovesEmulator glove(options);
  OpenGlovesWire wire({.port = glove.port()});
  wire.open();
  devices::GloveState state;
  const devices::SafeCommand at_half = index_limit(0.5);
  std::ptrdiff_t most = 0;
  bool is_limit = false;
  EXPECT_TRUE(turns_until(wire, state, at_half, [&] { return wire.traffic().states > 10; }));
  for (int i = 0; i < 200; ++i) {
    is_limit = i % 3 != 0 && !is_limit;
    wire.read(state);
    wire.write(is_limit ? at_half : devices::SafeCommand());
    most = std::max(most, glove.state().waiting_lines);
  }
  EXPECT_LE(most, 3) << "each one that waits delays the release by a state";
  EXPECT_EQ(glove.state().lost_bytes, 0);
}

TEST(OpenGlovesWire, ComesBackEachTimeTheGloveIsPluggedInAgain) {
  const test_support::TemporaryFolder folder;
  OpenGlovesEmulatorOptions options = still({});
  options.link = folder.path("glove");
  OpenGlovesEmulator glove(options);
  OpenGlovesWire wire({.port = options.link});
  devices::GloveState state;
  constexpr int kTimes = 20;
  for (int i = 0; i < kTimes; ++i) {
    wire.open();
    ASSERT_TRUE(turns_until(wire, state, {}, [&] { return glove.state().limits[1] == 0; })) << i;
    ASSERT_TRUE(turns_until(wire, state, index_limit(0.5), [&] { return glove.state().limits[1] > 450; })) << i;
    glove.unplug();
    EXPECT_THROW(turns_until(wire, state, {}, [] { return false; }), WireError);
    wire.release();
    EXPECT_THROW(wire.open(), WireError);
    wire.release();
    glove.plug();
  }
  EXPECT_GT(glove.state().limits[1], 450) << "the firmware keeps the limit while nobody is there";
  wire.open();
  EXPECT_TRUE(turns_until(wire, state, {}, [&] { return glove.state().limits[1] == 0; }));
  EXPECT_TRUE(turns_until(wire, state, {}, [&] { return wire.traffic().states > 20; }));
  EXPECT_LE(glove.state().waiting_lines, 1) << "the lines of the release do not delay those that follow";
}

TEST(OpenGlovesWire, WorksOverTcp) {
  OpenGlovesEmulatorOptions options = still({});
  options.is_tcp = true;
  OpenGlovesEmulator glove(options);
  OpenGlovesWire wire({.port = glove.port()});
  wire.open();
  devices::GloveState state;
  EXPECT_TRUE(turns_until(wire, state, index_limit(0.5), [&] { return glove.state().limits[1] > 450; }));
}

TEST(OpenGlovesWire, RefusesSensorsWithoutARange) {
  OpenGlovesOptions options{.port = "/dev/null"};
  options.sensors[2] = {100.0, 100.0};
  EXPECT_THROW(OpenGlovesWire{options}, std::invalid_argument);
}

/// All that the check says about a port.
std::string findings(const std::string& port, bool expected) {
  std::string text;
  EXPECT_EQ(check_opengloves(
                {.port = port}, [] { return true; }, [&](const std::string& line) { text += line + "\n"; }),
            expected);
  return text;
}

TEST(OpenGlovesCheck, ShowsTheFirstNumbers) {
  OpenGlovesEmulatorOptions options = still({});
  options.encoding = kLegacy;
  options.full_scale = 1023;
  OpenGlovesEmulator glove(options);
  const std::string text = findings(glove.port(), true);
  EXPECT_THAT(text, HasSubstr("encoding 'legacy'"));
  EXPECT_THAT(text, HasSubstr("little finger: 0 0 0 0 0\n"));
  EXPECT_THAT(text, HasSubstr("use --full-scale 1023"));
  EXPECT_THAT(text, HasSubstr("open and close all fingers"));
}

TEST(OpenGlovesCheck, SaysWhatIsWrong) {
  EXPECT_THAT(findings("/dev/ttyUSB99", false), HasSubstr("no such port"));
  OpenGlovesEmulatorOptions options = still({});
  options.faults.garbage = 1.0;
  options.faults.cut = 1.0;
  OpenGlovesEmulator other(options);
  EXPECT_THAT(findings(other.port(), false), HasSubstr("no state of an OpenGloves glove"));
}

}  // namespace
}  // namespace glissade::bridges
