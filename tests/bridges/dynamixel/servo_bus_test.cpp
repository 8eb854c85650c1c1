#include "dynamixel/servo_bus.h"

#include <array>
#include <memory>

#include <gtest/gtest.h>

#include "bytes.h"
#include "dynamixel/emulated_bus.h"
#include "elastic_finger.h"
#include "emulation/emulated_line.h"
#include "emulation/faulty_device.h"

namespace glissade::bridges::dynamixel {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

std::shared_ptr<HornLoad> horn_at(double angle) {
  return std::make_shared<ElasticFinger>(angle, 0.5, 0.025);
}

class BusOfTwo : public testing::Test {
 protected:
  BusOfTwo() {
    const ServoModel model = *find_model("XL330-M288");
    servos_ = std::make_shared<EmulatedBus>(
        std::vector<EmulatedServo>{{3, model, horn_at(1.0)}, {7, model, horn_at(2.0)}}, kBaudRate);
    device_ = std::make_shared<FaultyDevice>(servos_, 1);
    line_ = std::make_unique<EmulatedLine>(device_, clock_);
    line_->open();
    bus_ = std::make_unique<ServoBus>(*line_, *clock_, BusSettings{.baud_rate = kBaudRate});
  }

  static constexpr double kBaudRate = 1e6;
  static constexpr std::array<std::uint8_t, 2> kIds{3, 7};

  std::shared_ptr<realtime::SimulatedClock> clock_ = std::make_shared<realtime::SimulatedClock>();
  std::shared_ptr<EmulatedBus> servos_;
  std::shared_ptr<FaultyDevice> device_;
  std::unique_ptr<EmulatedLine> line_;
  std::unique_ptr<ServoBus> bus_;
};

TEST_F(BusOfTwo, PingTellsModelAndFirmware) {
  const std::optional<PingAnswer> answer = bus_->ping(3);
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->model, 1200);
  EXPECT_EQ(answer->firmware, 46);
}

TEST_F(BusOfTwo, AnswerTakesReturnDelayAndTimeOnTheLine) {
  bus_->ping(3);
  EXPECT_EQ(clock_->now(), std::chrono::microseconds(500 + 14 * 10)) << "14 bytes of 10 bits at 1 Mbaud";
}

TEST_F(BusOfTwo, MissingServoIsAwaitedForThePatience) {
  EXPECT_FALSE(bus_->ping(4));
  EXPECT_GE(clock_->now(), milliseconds(5));
  EXPECT_LE(clock_->now(), milliseconds(6));
  EXPECT_EQ(bus_->statistics().missing_answers, 1U);
}

TEST_F(BusOfTwo, WrittenValueIsRead) {
  const std::optional<Answer> written = bus_->write(7, kPositionPGain.address, bytes_of("20 03"));
  ASSERT_TRUE(written);
  EXPECT_EQ(error_number(written->error), StatusError::kNone);
  EXPECT_EQ(bus_->read(7, kPositionPGain.address, 2)->data, bytes_of("20 03"));
}

TEST_F(BusOfTwo, RefusedWriteTellsWhy) {
  EXPECT_EQ(error_number(bus_->write(3, kPresentPosition.address, bytes_of("00 00 00 00"))->error),
            StatusError::kAccess);
  EXPECT_EQ(error_number(bus_->write(3, kGoalCurrent.address, bytes_of("FF 7F"))->error), StatusError::kDataLimit);
  EXPECT_EQ(error_number(bus_->write(3, kGoalCurrent.address, bytes_of("01"))->error), StatusError::kDataLength);
}

TEST_F(BusOfTwo, SyncReadAsksAll) {
  clock_->advance(milliseconds(10));
  for (const bool is_fast : {false, true}) {
    const auto answers = is_fast ? bus_->fast_sync_read(kIds, kPresentPosition.address, 4)
                                 : bus_->sync_read(kIds, kPresentPosition.address, 4);
    ASSERT_EQ(answers.size(), 2U);
    ASSERT_TRUE(answers[0] && answers[1]);
    EXPECT_EQ(decode_register(kPresentPosition, answers[0]->data), to_counts(kPresentPosition, 1.0));
    EXPECT_EQ(decode_register(kPresentPosition, answers[1]->data), to_counts(kPresentPosition, 2.0));
  }
}

TEST_F(BusOfTwo, SyncReadWithoutOneServo) {
  servos_->servo(7).is_connected = false;
  const auto answers = bus_->sync_read(kIds, kPresentPosition.address, 4);
  EXPECT_TRUE(answers[0]);
  EXPECT_FALSE(answers[1]);
  EXPECT_FALSE(bus_->fast_sync_read(kIds, kPresentPosition.address, 4)[0]);
}

TEST_F(BusOfTwo, SyncWriteHasNoAnswer) {
  const std::array<SyncWriteEntry, 2> entries{{{3, bytes_of("0A 00")}, {7, bytes_of("14 00")}}};
  const nanoseconds before = clock_->now();
  bus_->sync_write(kGoalCurrent.address, entries);
  EXPECT_EQ(clock_->now(), before);
  EXPECT_EQ(servos_->servo(3).get(kGoalCurrent), 10);
  EXPECT_EQ(servos_->servo(7).get(kGoalCurrent), 20);
}

TEST_F(BusOfTwo, LateAnswerIsNotTakenForTheNextOne) {
  device_->faults.slowness = milliseconds(8);
  EXPECT_FALSE(bus_->read(3, kPresentPosition.address, 4));
  clock_->advance(milliseconds(10));
  device_->faults.slowness = milliseconds(0);
  const std::optional<Answer> answer = bus_->read(7, kPresentPosition.address, 4);
  ASSERT_TRUE(answer);
  EXPECT_EQ(decode_register(kPresentPosition, answer->data), to_counts(kPresentPosition, 2.0));
}

TEST_F(BusOfTwo, EchoAndGarbageAreIgnored) {
  device_->faults = {.garbage = 1.0, .has_echo = true};
  EXPECT_TRUE(bus_->ping(3));
  EXPECT_TRUE(bus_->ping(7));
  EXPECT_GT(bus_->statistics().skipped_bytes, 0U);
}

TEST_F(BusOfTwo, CutAndWrongAnswersAreMissing) {
  device_->faults = {.cut = 1.0};
  EXPECT_FALSE(bus_->ping(3));
  device_->faults = {.flipped_bit = 1.0};
  EXPECT_FALSE(bus_->ping(3));
  device_->faults = {};
  EXPECT_TRUE(bus_->ping(3));
}

}  // namespace
}  // namespace glissade::bridges::dynamixel
