#pragma once

/// The frame of a test with real processes: a hand presses, something fails, and the record of the glove tells what the
/// hand got.

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glissade/devices/simulated_glove.h>

#include "pressing_hand.h"
#include "stall_meter.h"

namespace glissade::test_support {

/// Far longer than the deadlines of the envelope, because any process may wait for a processor.
inline constexpr std::chrono::milliseconds kGenerous{150};

class PressingHandTest : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_NE(std::getenv("GLISSADE_NETWORK_NAMESPACE"), nullptr) << "would send outside of this test";
    hand_ = std::make_unique<PressingHand>(options());
    begin_ = monotonic_now();
  }

  /// Tells `run_where_quiet` of stalls, unless the test saw what they do not excuse.
  void TearDown() override {
    const auto stall = std::chrono::duration_cast<std::chrono::microseconds>(stalls_.end());
    if (hand_ && keeps_limits_) RecordProperty("stall_us", static_cast<int>(stall.count()));
  }

  virtual PressingHandOptions options() const { return {}; }

  PressingHand& hand() { return *hand_; }
  Relay& relay() { return hand_->relay(); }

  /// The fault lasts so long.
  static void wait(std::chrono::milliseconds duration = std::chrono::milliseconds(400)) {
    std::this_thread::sleep_for(duration);
  }

  /// The fault ends; the hand presses on for some time.
  void recover() {
    relay().set_states(Relay::pass);
    relay().set_commands(Relay::pass);
    end_ = monotonic_now();
    wait(std::chrono::milliseconds(500));
  }

  /// Ends both processes. Checks that the hand pressed before the fault, and that no force was beyond the limits or
  /// jumped.
  GloveRecord record() {
    const std::chrono::nanoseconds now = monotonic_now();
    if (end_ == std::chrono::nanoseconds(0)) end_ = now;
    GloveRecord record = hand_->end_glove();
    EXPECT_GT(greatest_force(record.between(begin_ - std::chrono::milliseconds(500), begin_)), kPressing_N)
        << "nothing to disturb";
    expect_within_limits(record);
    return record;
  }

  /// From some time after the beginning of the fault to its end there was no force.
  void expect_no_force(const GloveRecord& record) const {
    const auto periods = record.between(begin_ + kGenerous, end_);
    ASSERT_FALSE(periods.empty());
    EXPECT_EQ(greatest_force(periods), 0.0) << periods.back().reason;
    EXPECT_THAT(periods.back().reason, testing::StartsWith("no force"));
  }

  /// The hand pressed in the end. A single period says nothing: any process may have waited for a processor just then.
  static void expect_pressing_again(const GloveRecord& record) {
    const std::chrono::nanoseconds now = monotonic_now();
    EXPECT_GT(greatest_force(record.between(now - std::chrono::milliseconds(400), now)), kPressing_N);
  }

  /// Share of the fault during which the hand pressed.
  double pressing_share(const GloveRecord& record) const {
    const auto periods = record.between(begin_ + kGenerous, end_);
    const auto pressing = std::count_if(periods.begin(), periods.end(),
                                        [](const GlovePeriod& period) { return period.f_W.norm() > kPressing_N; });
    return static_cast<double>(pressing) / static_cast<double>(periods.size());
  }

  void expect_no_effect(const GloveRecord& record) const { EXPECT_GT(pressing_share(record), 0.5); }

  /// The force fades now and then, or for good; it hardly exceeds that of before the fault, and has no other direction.
  void expect_no_more_force(const GloveRecord& record) const {
    const double before = greatest_force(record.between(begin_ - std::chrono::milliseconds(300), begin_));
    // After a fade the hand is deeper for a moment.
    EXPECT_LT(greatest_force(record.between(begin_, end_)), 1.6 * before);
    EXPECT_LT(greatest_sideways(record.between(begin_, end_)), 0.02 * before);
  }

  /// The hand pressed in the end, after a soft return.
  void expect_soft_return(const GloveRecord& record) const {
    expect_pressing_again(record);
    const auto returning =
        std::find_if(record.periods().begin(), record.periods().end(), [&](const GlovePeriod& period) {
          return period.t > std::chrono::duration<double>(end_).count() && period.f_W.norm() > 0.0;
        });
    ASSERT_NE(returning, record.periods().end());
    for (auto period = returning; period != record.periods().end() && period->t < returning->t + 0.02; ++period) {
      EXPECT_LT(period->f_W.norm(), 20.0 * 0.03 / 0.2) << "a fade of 200 ms is not that fast";
    }
  }

  void expect_within_limits(const GloveRecord& record) {
    const devices::DeviceDescriptor device = devices::simulated_glove_descriptor();
    // The envelope counts at most two periods of the device for a step.
    const double longest_step = 2.0 * device.max_force / 7.0 + 1e-9;
    const std::vector<GlovePeriod>& periods = record.periods();
    std::ptrdiff_t beyond_one_period = 0;
    const bool kept_limits = std::exchange(keeps_limits_, false);
    for (std::size_t i = 1; i < periods.size(); ++i) {
      ASSERT_TRUE(periods[i].f_W.allFinite());
      ASSERT_LE(periods[i].f_W.norm(), device.max_force + 1e-9);
      ASSERT_LE(periods[i].torque_W.norm(), device.max_torque + 1e-9);
      const double step = (periods[i].f_W - periods[i - 1].f_W).norm();
      ASSERT_LE(step, longest_step) << "at " << periods[i].t << " s";
      beyond_one_period += step > 1.1 * (device.max_force / 7e-3) * (periods[i].t - periods[i - 1].t) ? 1 : 0;
    }
    keeps_limits_ = kept_limits;
    // Only where a period came late, the next change may be greater than that of the time on the record.
    EXPECT_LE(20 * beyond_one_period, std::ssize(periods));
  }

  std::chrono::nanoseconds begin() const { return begin_; }

 private:
  StallMeter stalls_;
  bool keeps_limits_ = true;
  std::unique_ptr<PressingHand> hand_;
  std::chrono::nanoseconds begin_{0};
  std::chrono::nanoseconds end_{0};
};

}  // namespace glissade::test_support
