/// The emulated firmware of a glove: one line for each state, and strings that stop the fingers of a model.

#include "opengloves/emulated_firmware.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "opengloves/line_codec.h"

namespace glissade::bridges {
namespace {

using std::chrono::milliseconds;

constexpr std::chrono::nanoseconds kStatePeriod = milliseconds(20);

OpenGlovesEmulatorOptions closing_to(double curl) {
  OpenGlovesEmulatorOptions options;
  options.rate_Hz = 50.0;
  options.model.wearer.tremor = 0.0;
  options.wearer = [curl](std::chrono::nanoseconds) { return angles_of({curl, curl, curl, curl, curl}); };
  return options;
}

class Firmware : public testing::Test {
 protected:
  explicit Firmware(double curl = 0.0)
      : options_(closing_to(curl)),
        firmware_(options_, std::make_shared<EmulatedHand>(options_.model, options_.wearer)) {}

  void send_index_limit(int limit) {
    firmware_.receive(limit_line(OpenGlovesEncoding::kAlpha, {0, limit, 0, 0, 0}), now_);
  }
  /// The number of states that the firmware sends until then.
  long states_until(std::chrono::nanoseconds now) {
    now_ = now;
    const std::string bytes = firmware_.send_until(now);
    return std::count(bytes.begin(), bytes.end(), '\n');
  }
  int index_limit() const { return firmware_.state().limits[1]; }

  OpenGlovesEmulatorOptions options_;
  EmulatedFirmware firmware_;
  std::chrono::nanoseconds now_{0};
};

class FirmwareOfAFist : public Firmware {
 protected:
  FirmwareOfAFist() : Firmware(0.8) {}
};

TEST_F(Firmware, ReadsOneLineForEachState) {
  for (const int limit : {100, 200, 300})
    send_index_limit(limit);
  EXPECT_EQ(states_until(milliseconds(0)), 1);
  EXPECT_EQ(index_limit(), 100);
  EXPECT_EQ(firmware_.state().waiting_lines, 2);
  states_until(kStatePeriod);
  EXPECT_EQ(index_limit(), 200);
  states_until(2 * kStatePeriod);
  EXPECT_EQ(index_limit(), 300);
}

TEST_F(Firmware, WaitsForALineUpToASecond) {
  EXPECT_EQ(states_until(milliseconds(500)), 1);
  send_index_limit(100);
  EXPECT_EQ(index_limit(), 100) << "at once, because it waits";
  EXPECT_EQ(states_until(milliseconds(500)), 1);
  EXPECT_EQ(states_until(milliseconds(1499)), 0);
  EXPECT_EQ(states_until(milliseconds(1500)), 1);
}

TEST_F(Firmware, LosesWhatItsBufferCannotHold) {
  states_until(milliseconds(0));
  send_index_limit(100);  // ends the wait
  for (int i = 0; i < 30; ++i)
    send_index_limit(500);
  EXPECT_EQ(firmware_.state().lost_bytes, 30 * 13 - 256);
  for (int i = 1; i < 40; ++i)
    states_until(i * kStatePeriod);
  EXPECT_EQ(firmware_.state().limit_lines, 1 + 256 / 13) << "the last one is cut";
}

TEST_F(FirmwareOfAFist, StopsAFingerWhereItsStringIsTaut) {
  const double start = firmware_.state().curls[1];
  for (int i = 0; i < 100; ++i) {
    send_index_limit(500);
    states_until(i * kStatePeriod);
  }
  EXPECT_LT(start, 0.9);
  // The wearer's springs pull the string by 0.3 of the way of all joints; the string of the model is about 18 times as
  // stiff as the three springs together.
  EXPECT_NEAR(firmware_.state().curls[1], 0.5, 0.03);
  EXPECT_GT(firmware_.state().curls[1], 0.5);
  EXPECT_NEAR(firmware_.state().curls[2], 0.8, 0.01) << "free";
}

TEST_F(FirmwareOfAFist, KeepsTheLastLimitForEver) {
  send_index_limit(500);
  states_until(std::chrono::seconds(10));
  EXPECT_EQ(index_limit(), 500);
  EXPECT_NEAR(firmware_.state().curls[1], 0.5, 0.03);
}

}  // namespace
}  // namespace glissade::bridges
