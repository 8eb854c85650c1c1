/// What the hand gets when processes and the network between them fail. Each test has real processes, in a network
/// namespace of their own; see `PressingHand`. Faults within the server's process cannot be made from outside: a
/// simulation that halts or is slow, as on fine meshes, is in haptic_kernel_test.cpp and contact_force_test.cpp; one
/// that throws is in haptic_server_test.cpp.

#include <algorithm>
#include <atomic>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <limits>
#include <optional>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glissade/devices/simulated_glove.h>

#include "pressing_hand.h"
#include "raw_sender.h"

namespace glissade::apps {
namespace {

using namespace test_support;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using testing::HasSubstr;
using Bytes = Relay::Bytes;
using Send = Relay::Send;

/// Far longer than the deadlines of the envelope, because any process may wait for a processor.
constexpr milliseconds kGenerous{150};
constexpr double kPressing_N = 5.0;

class LinkFaults : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_NE(std::getenv("GLISSADE_NETWORK_NAMESPACE"), nullptr) << "would send outside of this test";
    hand_ = std::make_unique<PressingHand>();
    begin_ = monotonic_now();
  }

  PressingHand& hand() { return *hand_; }
  Relay& relay() { return hand_->relay(); }

  /// The fault lasts so long.
  static void wait(milliseconds duration = milliseconds(400)) { std::this_thread::sleep_for(duration); }

  /// The fault ends; the hand presses on for some time.
  void recover() {
    relay().set_states(Relay::pass);
    relay().set_commands(Relay::pass);
    end_ = monotonic_now();
    wait(milliseconds(500));
  }

  /// Ends both processes. Checks that the hand pressed before the fault, and that no force was beyond the limits or
  /// jumped.
  GloveRecord record() {
    const nanoseconds now = monotonic_now();
    if (end_ == nanoseconds(0)) end_ = now;
    GloveRecord record = hand_->end_glove();
    EXPECT_GT(greatest_force(record.between(begin_ - milliseconds(500), begin_)), kPressing_N) << "nothing to disturb";
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
    const nanoseconds now = monotonic_now();
    EXPECT_GT(greatest_force(record.between(now - milliseconds(400), now)), kPressing_N);
  }

  /// Share of the fault during which the hand pressed.
  double pressing_share(const GloveRecord& record) const {
    const auto periods = record.between(begin_ + kGenerous, end_);
    const auto pressing = std::count_if(periods.begin(), periods.end(),
                                        [](const GlovePeriod& period) { return period.f_W.norm() > kPressing_N; });
    return static_cast<double>(pressing) / static_cast<double>(periods.size());
  }

  void expect_no_effect(const GloveRecord& record) const { EXPECT_GT(pressing_share(record), 0.5); }

  /// The force fades now and then, or for good; it never exceeds that of before the fault, and has no other direction.
  void expect_no_more_force(const GloveRecord& record) const {
    const double before = greatest_force(record.between(begin_ - milliseconds(300), begin_));
    EXPECT_LT(greatest_force(record.between(begin_, end_)), 1.2 * before);
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

  static void expect_within_limits(const GloveRecord& record) {
    const devices::DeviceDescriptor device = devices::simulated_glove_descriptor();
    // The envelope counts at most two periods of the device for a step.
    const double longest_step = 2.0 * device.max_force / 7.0 + 1e-9;
    const std::vector<GlovePeriod>& periods = record.periods();
    std::ptrdiff_t beyond_one_period = 0;
    for (std::size_t i = 1; i < periods.size(); ++i) {
      ASSERT_TRUE(periods[i].f_W.allFinite());
      ASSERT_LE(periods[i].f_W.norm(), device.max_force + 1e-9);
      ASSERT_LE(periods[i].torque_W.norm(), device.max_torque + 1e-9);
      const double step = (periods[i].f_W - periods[i - 1].f_W).norm();
      ASSERT_LE(step, longest_step) << "at " << periods[i].t << " s";
      beyond_one_period += step > 1.1 * (device.max_force / 7e-3) * (periods[i].t - periods[i - 1].t) ? 1 : 0;
    }
    // Only where a period came late, the next change may be greater than that of the time on the record.
    EXPECT_LE(20 * beyond_one_period, std::ssize(periods));
  }

  nanoseconds begin() const { return begin_; }

 private:
  std::unique_ptr<PressingHand> hand_;
  nanoseconds begin_{0};
  nanoseconds end_{0};
};

void drop(const Bytes& /*message*/, std::mt19937& /*random*/, const Send& /*send*/) {}

TEST_F(LinkFaults, NoneLeavesTheForceAlone) {
  wait();
  const GloveRecord record = this->record();
  const auto periods = record.between(begin(), monotonic_now());
  EXPECT_LT(greatest_sideways(periods), 0.02 * greatest_force(periods));
  EXPECT_THAT(hand().end_server(), HasSubstr("holds"));
}

TEST_F(LinkFaults, AServerThatIsKilledHoldsNoForce) {
  hand().server().signal(SIGKILL);
  wait();
  expect_no_force(record());
}

TEST_F(LinkFaults, AServerThatIsStoppedAndContinuedComesBackSoftly) {
  hand().server().signal(SIGSTOP);
  wait();
  hand().server().signal(SIGCONT);
  recover();
  const GloveRecord record = this->record();
  expect_no_force(record);
  expect_soft_return(record);
  EXPECT_THAT(hand().end_server(), HasSubstr("no force: the glove's state is"));
}

TEST_F(LinkFaults, AServerThatEndsLetsTheForceFade) {
  hand().end_server();
  wait();
  const GloveRecord record = this->record();
  const std::vector<GlovePeriod>& periods = record.periods();
  const auto last =
      std::find_if(periods.rbegin(), periods.rend(), [](const GlovePeriod& period) { return period.f_W.norm() > 0.0; });
  ASSERT_NE(last, periods.rend());
  EXPECT_LT(last->t, std::chrono::duration<double>(monotonic_now() - milliseconds(300)).count());
  EXPECT_THAT(last->reason, testing::Not(HasSubstr("no force"))) << "the server's fade, not an expiry at the glove";
}

TEST_F(LinkFaults, AGloveThatIsStoppedAndContinuedGetsNoOldForce) {
  hand().glove().signal(SIGSTOP);
  wait();
  const nanoseconds continued = monotonic_now();
  hand().glove().signal(SIGCONT);
  recover();
  const GloveRecord record = this->record();
  EXPECT_LT(record.periods().back().t, std::chrono::duration<double>(monotonic_now()).count());
  expect_pressing_again(record);
  // The commands of before the stop are old: the force goes to zero before it comes back.
  const auto after = record.between(continued, continued + kGenerous);
  EXPECT_TRUE(
      std::any_of(after.begin(), after.end(), [](const GlovePeriod& period) { return period.f_W.norm() < 1.0; }));
  EXPECT_THAT(hand().end_server(), HasSubstr("no force: the glove's state is"));
}

TEST_F(LinkFaults, AGloveThatRestartsElsewhereIsTakenUpSoftly) {
  hand().glove().signal(SIGKILL);
  const std::string file = hand().folder().path("restarted.csv");
  const auto restarted = hand().start_glove(0.2, file);
  wait(milliseconds(1500));  // the lease of the first glove, and then the distrust of the jump
  restarted->signal(SIGINT);
  restarted->wait();
  const GloveRecord record(file);
  expect_within_limits(record);
  EXPECT_LT(greatest_sideways(record.periods()), 0.5) << "the jump along the plate must not be felt";
  const double start = record.periods().front().t;
  double last = 0.0;
  for (const GlovePeriod& period : record.periods()) {
    const double force = period.f_W.norm();
    if (period.t < start + 0.3) {
      ASSERT_EQ(force, 0.0) << "the first glove has the lease";
    }
    if (last == 0.0) {
      ASSERT_LT(force, 1.0) << "a return that is not soft";
    }
    last = force;
  }
  expect_pressing_again(record);
  EXPECT_THAT(hand().end_server(), HasSubstr("no force"));
}

TEST_F(LinkFaults, StatesThatStopTakeTheForceAway) {
  relay().set_states(drop);
  wait();
  recover();
  const GloveRecord record = this->record();
  expect_no_force(record);
  expect_soft_return(record);
}

TEST_F(LinkFaults, CommandsThatStopTakeTheForceAway) {
  relay().set_commands(drop);
  wait();
  recover();
  const GloveRecord record = this->record();
  expect_no_force(record);
  expect_soft_return(record);
}

TEST_F(LinkFaults, ALossOfHalfTheMessagesMakesNoJump) {
  const auto lose = [](const Bytes& message, std::mt19937& random, const Send& send) {
    if (random() % 2 == 0) send(message, nanoseconds(0));
  };
  relay().set_states(lose);
  relay().set_commands(lose);
  wait();
  recover();
  const GloveRecord record = this->record();
  expect_no_more_force(record);
  expect_pressing_again(record);
}

TEST_F(LinkFaults, MessagesOutOfOrderMakeNoJump) {
  const auto shuffle = [](const Bytes& message, std::mt19937& random, const Send& send) {
    send(message, std::chrono::microseconds(random() % 3000));
  };
  relay().set_states(shuffle);
  relay().set_commands(shuffle);
  wait();
  recover();
  const GloveRecord record = this->record();
  expect_no_more_force(record);
  expect_pressing_again(record);
}

TEST_F(LinkFaults, MessagesThatComeTwiceChangeNothing) {
  const auto twice = [](const Bytes& message, std::mt19937& /*random*/, const Send& send) {
    send(message, nanoseconds(0));
    send(message, nanoseconds(0));
    send(message, milliseconds(30));
  };
  relay().set_states(twice);
  relay().set_commands(twice);
  wait();
  const GloveRecord record = this->record();
  expect_pressing_again(record);
}

TEST_F(LinkFaults, ADelayTakesTheForceAwayAndTheServerIsTold) {
  const auto late = [](const Bytes& message, std::mt19937& /*random*/, const Send& send) {
    send(message, milliseconds(200));
  };
  relay().set_states(late);
  relay().set_commands(late);
  wait(milliseconds(2500));  // longer than it takes the server to believe in another clock
  const GloveRecord record = this->record();
  expect_no_force(record);
  EXPECT_THAT(hand().end_server(), HasSubstr("at the glove, no force: the command answers a state that is"));
}

TEST_F(LinkFaults, ASmallerDelayDoesNotOscillate) {
  const auto late = [](const Bytes& message, std::mt19937& /*random*/, const Send& send) {
    send(message, milliseconds(25));
  };
  relay().set_states(late);
  relay().set_commands(late);
  wait(milliseconds(2000));
  expect_no_force(record());
  EXPECT_THAT(hand().end_server(), HasSubstr("at the glove, no force: the command answers a state that is"));
}

TEST_F(LinkFaults, CorruptedMessagesMakeNoJump) {
  const auto corrupt = [](const Bytes& message, std::mt19937& random, const Send& send) {
    Bytes damaged = message;
    if (random() % 3 == 0) damaged[random() % damaged.size()] ^= static_cast<std::uint8_t>(1U << (random() % 8));
    send(damaged, nanoseconds(0));
  };
  relay().set_states(corrupt);
  relay().set_commands(corrupt);
  wait(milliseconds(1000));
  recover();
  wait(milliseconds(500));
  expect_pressing_again(record());  // until then anything within the limits: a force with one wrong bit looks good
}

TEST_F(LinkFaults, NumbersThatAreNoneTakeTheForceAway) {
  relay().set_commands(Relay::changed<glissade::glove_command_t>(
      [](auto& command) { command.force_H_W_N[1] = std::numeric_limits<double>::quiet_NaN(); }));
  wait();
  recover();
  const GloveRecord record = this->record();
  expect_no_force(record);
  expect_soft_return(record);
}

TEST_F(LinkFaults, AStateThatIsNotFiniteTakesTheForceAway) {
  relay().set_states(Relay::changed<glissade::glove_state_t>(
      [](auto& state) { state.position_WH_m[0] = std::numeric_limits<double>::infinity(); }));
  wait();
  recover();
  const GloveRecord record = this->record();
  expect_no_force(record);
  expect_soft_return(record);
}

TEST_F(LinkFaults, HugeNumbersTakeTheForceAway) {
  relay().set_commands(
      Relay::changed<glissade::glove_command_t>([](auto& command) { command.force_H_W_N[0] = -1e30; }));
  relay().set_states(Relay::changed<glissade::glove_state_t>([](auto& state) { state.v_WH_m_per_s[0] = 1e30; }));
  wait();
  recover();
  const GloveRecord record = this->record();
  expect_no_force(record);
  expect_soft_return(record);
}

TEST_F(LinkFaults, AForceOfAMillionNewtonsStaysWithinTheLimits) {
  relay().set_commands(Relay::changed<glissade::glove_command_t>([](auto& command) { command.force_H_W_N[2] = 1e6; }));
  wait();
  recover();
  EXPECT_NEAR(greatest_force(record().periods()), 20.0, 1e-6);
}

TEST_F(LinkFaults, ATrackerThatJumpsAlongThePlateIsNotFelt) {
  relay().set_states(Relay::changed<glissade::glove_state_t>([](auto& state) { state.position_WH_m[0] += 0.1; }));
  wait();
  recover();
  const GloveRecord record = this->record();
  EXPECT_LT(greatest_sideways(record.periods()), 0.5);
  EXPECT_THAT(hand().end_server(), HasSubstr("no force: the glove's pose jumps"));
}

TEST_F(LinkFaults, AFrozenPoseHoldsItsForce) {
  std::vector<double> first;
  relay().set_states(Relay::changed<glissade::glove_state_t>([first](auto& state) mutable {
    if (first.empty()) first.assign(state.position_WH_m, state.position_WH_m + 3);
    std::copy(first.begin(), first.end(), state.position_WH_m);
  }));
  wait();
  recover();
  const GloveRecord record = this->record();
  expect_no_effect(record);
  expect_pressing_again(record);
}

TEST_F(LinkFaults, TimeThatGoesBackTakesTheForceAwayForATime) {
  relay().set_states(Relay::changed<glissade::glove_state_t>([](auto& state) { state.time_ns -= 1'000'000'000; }));
  wait();
  recover();
  const GloveRecord record = this->record();
  expect_no_force(record);  // the glove sees that its state of a second ago is answered
  expect_pressing_again(record);
}

TEST_F(LinkFaults, SequencesThatFallMakeNoPulses) {
  const auto falling = [next = std::optional<std::int64_t>()](auto& message) mutable {
    next = next ? *next - 1 : message.sequence;
    message.sequence = *next;
  };
  relay().set_commands(Relay::changed<glissade::glove_command_t>(falling));
  wait(milliseconds(1500));
  expect_no_force(record());
}

TEST_F(LinkFaults, OneHugeSequenceNumberLocksNobodyOut) {
  relay().set_commands([is_first = true](const Bytes& bytes, std::mt19937& /*random*/, const Send& send) mutable {
    send(bytes, nanoseconds(0));
    glissade::glove_command_t message{};
    if (!std::exchange(is_first, false)) return;
    message.decode(bytes.data(), 0, static_cast<int>(bytes.size()));
    message.sequence = std::numeric_limits<std::int64_t>::max();
    Bytes forged(bytes.size());
    message.encode(forged.data(), 0, static_cast<int>(forged.size()));
    send(forged, nanoseconds(0));
  });
  wait();
  const GloveRecord record = this->record();
  expect_no_effect(record);
}

TEST_F(LinkFaults, ASecondGloveInFreeAirFeelsNothingOfTheFirst) {
  const std::string with_other_number = hand().folder().path("second.csv");
  const std::string with_same_number = hand().folder().path("third.csv");
  const auto second = hand().start_glove(0.3, with_other_number, "2");
  const auto third = hand().start_glove(0.4, with_same_number);
  wait(milliseconds(1000));
  for (const auto& glove : {second.get(), third.get()}) {
    glove->signal(SIGINT);
    glove->wait();
  }
  const GloveRecord first = record();
  EXPECT_EQ(greatest_force(GloveRecord(with_other_number).periods()), 0.0);
  EXPECT_EQ(greatest_force(GloveRecord(with_same_number).periods()), 0.0);
  expect_no_effect(first);
}

TEST_F(LinkFaults, ASecondServerIsRefusedAndSaysSo) {
  const auto second = hand().start_server();
  wait(milliseconds(1500));
  second->signal(SIGINT);
  EXPECT_THAT(second->wait().standard_error, HasSubstr("no force: the glove obeys another server"));
  const GloveRecord record = this->record();
  expect_pressing_again(record);
  EXPECT_THAT(hand().end_server(), testing::Not(HasSubstr("another server")));
}

TEST_F(LinkFaults, AFloodChangesNothing) {
  relay().set_commands([](const Bytes& message, std::mt19937& random, const Send& send) {
    send(message, nanoseconds(0));
    for (int i = 0; i < 20; ++i) {
      Bytes junk = message;
      for (std::uint8_t& byte : junk)
        byte = static_cast<std::uint8_t>(random());
      std::copy_n(message.begin(), i < 10 ? 40 : 0, junk.begin());  // half of them with the right head
      send(junk, std::chrono::microseconds(50 * i));
    }
  });
  wait(milliseconds(1000));
  recover();
  const GloveRecord record = this->record();
  expect_no_effect(record);
  expect_pressing_again(record);
}

TEST_F(LinkFaults, FragmentsAndPacketsFromElsewhereDoNoHarm) {
  const RawSender inside("0.0.0.0");
  const RawSender outside("127.0.0.9");
  for (int i = 0; i < 200; ++i) {
    for (const auto& [group, port] : {std::pair("239.255.76.67", 7667), std::pair("239.255.76.68", 7668)}) {
      for (const char* channel : {"GLOVE_STATE", "GLOVE_COMMAND"}) {
        inside.send(hostile_fragment(channel), group, port);
        outside.send(small_message(channel, "x"), group, port);
        inside.send(small_message(channel, std::string(400, '\xff')), group, port);
      }
      inside.send(small_message("GLOVE_COMMAND", "x"), "127.0.0.1", port);
    }
    wait(milliseconds(1));
  }
  const GloveRecord record = this->record();
  expect_no_effect(record);
  hand().end_server();
}

}  // namespace
}  // namespace glissade::apps
