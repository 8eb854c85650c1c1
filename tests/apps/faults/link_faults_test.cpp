/// What the hand gets when the network between server and glove fails. Each test has real processes, in a network
/// namespace of their own; see `PressingHand`.

#include <algorithm>
#include <limits>
#include <optional>

#include "pressing_hand_test.h"
#include "raw_sender.h"

namespace glissade::apps {
namespace {

using namespace test_support;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using testing::HasSubstr;
using Bytes = Relay::Bytes;
using Send = Relay::Send;

class LinkFaults : public PressingHandTest {};

void drop(const Bytes& /*message*/, std::mt19937& /*random*/, const Send& /*send*/) {}

TEST_F(LinkFaults, ForceIsUnchangedWithoutAFault) {
  wait();
  const GloveRecord record = this->record();
  const auto periods = record.between(begin(), monotonic_now());
  EXPECT_LT(greatest_sideways(periods), 0.02 * greatest_force(periods));
  EXPECT_THAT(hand().end_server(), HasSubstr("holds"));
}

TEST_F(LinkFaults, ForceFadesWhenStatesStop) {
  relay().set_states(drop);
  wait();
  recover();
  const GloveRecord record = this->record();
  expect_no_force(record);
  expect_soft_return(record);
}

TEST_F(LinkFaults, ForceFadesWhenCommandsStop) {
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

TEST_F(LinkFaults, ForceFadesAtALongDelayAndTheServerReportsIt) {
  const auto late = [](const Bytes& message, std::mt19937& /*random*/, const Send& send) {
    send(message, milliseconds(200));
  };
  relay().set_states(late);
  relay().set_commands(late);
  wait(milliseconds(2500));  // longer than it takes the server to believe in another clock
  const GloveRecord record = this->record();
  expect_no_force(record);
  EXPECT_THAT(hand().end_server(), HasSubstr("at the glove: no force: the command answers a state that is"));
}

// That it comes to rest is told by passivity_test, where no process waits for a processor.
TEST_F(LinkFaults, ShortDelaySoftensTheContact) {
  const auto late = [](const Bytes& message, std::mt19937& /*random*/, const Send& send) {
    send(message, milliseconds(25));
  };
  relay().set_states(late);
  relay().set_commands(late);
  wait(milliseconds(4000));
  const nanoseconds end = monotonic_now();
  const GloveRecord record = this->record();
  const double before = greatest_force(record.between(begin() - milliseconds(300), begin()));
  const auto at_once = record.between(begin() + kGenerous, begin() + milliseconds(400));
  EXPECT_EQ(greatest_force(at_once), 0.0) << "a new delay is not believed before it lasts";
  const double soft = greatest_force(record.between(begin() + milliseconds(1500), end));
  EXPECT_GT(soft, 0.02 * before);
  EXPECT_LT(soft, 0.25 * before);
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

TEST_F(LinkFaults, ForceFadesWhenCommandsAreNaN) {
  relay().set_commands(Relay::changed<glissade::glove_command_t>(
      [](auto& command) { command.force_H_W_N[1] = std::numeric_limits<double>::quiet_NaN(); }));
  wait();
  recover();
  const GloveRecord record = this->record();
  expect_no_force(record);
  expect_soft_return(record);
}

TEST_F(LinkFaults, ForceFadesWhenStatesAreNotFinite) {
  relay().set_states(Relay::changed<glissade::glove_state_t>(
      [](auto& state) { state.position_WH_m[0] = std::numeric_limits<double>::infinity(); }));
  wait();
  recover();
  const GloveRecord record = this->record();
  expect_no_force(record);
  expect_soft_return(record);
}

TEST_F(LinkFaults, ForceFadesWhenNumbersAreHuge) {
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

TEST_F(LinkFaults, ForceFadesAndReturnsWhenGloveTimeGoesBack) {
  relay().set_states(Relay::changed<glissade::glove_state_t>([](auto& state) { state.time_ns -= 1'000'000'000; }));
  wait();
  recover();
  const GloveRecord record = this->record();
  expect_no_force(record);  // the glove sees that its state of a second ago is answered
  expect_pressing_again(record);
}

TEST_F(LinkFaults, FallingSequenceNumbersGiveNoForce) {
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
  for (int i = 0; i < 1000; ++i) {  // long enough for a fade after a stall of the machine not to count
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
