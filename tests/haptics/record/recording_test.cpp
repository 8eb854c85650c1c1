// A recorded run can be repeated to the bit, and any change of the recording is found.

#include <fstream>
#include <iterator>
#include <memory>
#include <optional>
#include <random>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/contact/spring.h>
#include <glissade/devices/event_log.h>
#include <glissade/devices/simulated_glove.h>
#include <glissade/grasping/grasp_simulation.h>
#include <glissade/haptics/haptic_server.h>
#include <glissade/haptics/offline_run.h>
#include <glissade/haptics/recording.h>

#include "held_part.h"
#include "poses.h"
#include "sweeps/sweep_variants.h"
#include "temporary_folder.h"

namespace glissade::haptics {
namespace {

using std::chrono::milliseconds;
using test_support::at;

constexpr std::int64_t kRecordedTicks = 600;

devices::SimulatedGlove recorded_hand() {
  return devices::SimulatedGlove(
      geometry::PoseTrajectory({{milliseconds(0), at(0.0, 0.0, 0.0)}, {milliseconds(300), at(0.04, 0.01, 0.0)}}));
}

grasping::GraspSimulation recorded_parts(const contact::SlidingRules& rules = {}) {
  return {{test_support::wall(0.03)},
          {{.part_V = test_support::cube(0.04), .stiffness = contact::CouplingStiffness{1000.0, 1.0}}},
          {},
          {.sliding = rules}};
}

RecordingHead recorded_head() {
  return {.gloves = {{.device = 1, .session = 1, .descriptor = recorded_hand().descriptor()}},
          .events = {devices::to_event(milliseconds(0), "HEAD", {1, 2, 3})}};
}

/// A hand presses a cube on a wall, lets go and takes hold again.
void record(LoopObserver& observer) {
  devices::SimulatedGlove glove = recorded_hand();
  grasping::GraspSimulation parts = recorded_parts();
  run_offline({{&glove}}, parts, kRecordedTicks, [](const devices::HapticState&) {},
              {.before_tick =
                   [](std::int64_t tick, HoldRequests& hands) {
                     if (tick == 400) hands.release(0);
                     if (tick == 500) hands.grasp(0, 0);
                   },
               .observer = &observer});
}

/// A glove that makes one step with each tick that reads it.
class RecordedDevice final : public devices::GloveDevice {
 public:
  const devices::DeviceDescriptor& descriptor() const noexcept override { return glove_.descriptor(); }
  bool read(devices::GloveState& newest) noexcept override {
    newest = glove_.step(kTickPeriod, command_);
    return true;
  }
  void command(const devices::SafeCommand& command) noexcept override { command_ = command; }

 private:
  devices::SimulatedGlove glove_ = recorded_hand();
  devices::SafeCommand command_;
};

class Recording : public testing::Test {
 protected:
  Recording() {
    LogRecorder recorder(path_, recorded_head());
    record(recorder);
    recorder.close();
  }

  /// What is found, reading and repeating: nothing if all is as it was.
  std::string fault(const std::string& path, const contact::SlidingRules& rules = {}) {
    devices::EventLogReader log(path);
    grasping::GraspSimulation parts = recorded_parts(rules);
    Replay replay(parts, {{.device = recorded_hand().descriptor(), .part = 0}}, kTickPeriod, recorded_head());
    while (const auto event = log.next()) {
      if (!replay.take(*event)) break;
    }
    log.damage().empty() ? replay.finish() : replay.settle();
    ticks_ = replay.ticks();
    answers_ = replay.answers();
    return log.damage() + replay.difference();
  }

  std::string bytes() const {
    std::ifstream file(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  std::string changed(const std::string& bytes) {
    const std::string path = folder_.path("changed.lcmlog");
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
  }

  test_support::TemporaryFolder folder_;
  std::string path_ = folder_.path("run.lcmlog");
  std::int64_t ticks_ = 0;
  std::int64_t answers_ = 0;
};

TEST_F(Recording, ReplayIsBitIdentical) {
  EXPECT_EQ(fault(path_), "");
  EXPECT_EQ(ticks_, kRecordedTicks);
  EXPECT_EQ(answers_, kRecordedTicks);
}

TEST_F(Recording, ReplayIsBitIdenticalWithASearchThread) {
  EXPECT_EQ(fault(path_, {.has_search_thread = true}), "");
}

TEST_F(Recording, ReplayIsBitIdenticalWithEveryInstructionSet) {
  test_support::with_every_instruction_set([&](std::string_view name) { EXPECT_EQ(fault(path_), "") << name; });
}

TEST_F(Recording, ReplayOfAServerIsBitIdentical) {
  const std::string path = folder_.path("server.lcmlog");
  const contact::SlidingRules rules = contact::real_time_rules();
  LogRecorder recorder(path, recorded_head());
  {
    BackgroundObserver observer({&recorder});
    RecordedDevice device;
    grasping::GraspSimulation parts = recorded_parts(rules);
    HapticServer server({{&device}}, parts, {.ticks = kRecordedTicks, .observer = &observer});
    while (server.ticks() < kRecordedTicks / 2)
      std::this_thread::sleep_for(milliseconds(1));
    EXPECT_TRUE(server.release(0));
    EXPECT_TRUE(server.grasp(0, 0));
    while (!server.is_done())
      std::this_thread::sleep_for(milliseconds(1));
    server.stop();
    ASSERT_EQ(observer.dropped(), 0U);
  }
  recorder.close();
  EXPECT_EQ(fault(path, rules), "");
  EXPECT_GE(ticks_, kRecordedTicks) << "and the ticks of the fade";
  EXPECT_GT(answers_, 0);
}

TEST_F(Recording, WithoutItsBeginningIsRefusedInASentence) {
  FlightRecorder recorder(recorded_head(), 1 << 20);
  record(recorder);
  const std::string path = folder_.path("flight.lcmlog");
  recorder.write(path);
  EXPECT_NE(fault(path).find("in the recording: only a run from its beginning on can be repeated"), std::string::npos);
  EXPECT_EQ(ticks_, 0);
}

TEST_F(Recording, ReplayWithOtherRulesIsDetected) {
  EXPECT_NE(fault(path_, {.friction = {.at_rest = 0.3, .sliding = 0.3}}), "");
}

TEST_F(Recording, HasTheLcmMessagesOfEveryTick) {
  devices::EventLogReader log(path_);
  std::int64_t states = 0;
  std::int64_t haptic_states = 0;
  std::int64_t infos = 0;
  while (const auto event = log.next()) {
    states += glove_state_of(*event) ? 1 : 0;
    haptic_states += haptic_state_of(*event) ? 1 : 0;
    infos += glove_info_of(*event) ? 1 : 0;
  }
  EXPECT_EQ(states, kRecordedTicks);
  EXPECT_EQ(haptic_states, kRecordedTicks);
  EXPECT_EQ(infos, kRecordedTicks / 200) << "five announcements a second";
}

TEST_F(Recording, ThatIsCutOffGivesAllBeforeTheEnd) {
  const std::string whole = bytes();
  EXPECT_NE(fault(changed(whole.substr(0, whole.size() - 5))).find("the file ends within an event"), std::string::npos);
  EXPECT_GE(ticks_, kRecordedTicks - 1);
}

TEST_F(Recording, ThatIsCutOffBetweenTwoEventsOfATickIsFoundOut) {
  std::vector<devices::LogEvent> events;
  devices::EventLogReader log(path_);
  while (const auto event = log.next())
    events.push_back(*event);
  std::size_t last_tick = events.size() - 1;
  while (events[last_tick].channel != "HAPTIC_TICK")
    --last_tick;
  ASSERT_LT(last_tick + 1, events.size());
  for (std::size_t count = last_tick + 1; events.at(count).channel != "CONTACT_SET"; ++count) {
    const std::string path = folder_.path("cut.lcmlog");
    devices::EventLogWriter writer(path);
    for (std::size_t i = 0; i < count; ++i)
      writer.write(events[i]);
    writer.close();
    EXPECT_NE(fault(path).find("the recording ends within tick 600"), std::string::npos) << count;
  }
}

TEST_F(Recording, WithoutATickIsNoRun) {
  const std::string path = folder_.path("empty.lcmlog");
  devices::EventLogWriter writer(path);
  writer.write(recorded_head().events.front());
  writer.close();
  EXPECT_EQ(fault(path), "there is no tick in the recording");
}

/// Where the numbers of events are in a log: 8 bytes each, which mean nothing.
std::set<std::size_t> places_of_numbers(const std::string& path) {
  std::set<std::size_t> places;
  devices::EventLogReader log(path);
  std::size_t begin = 0;
  while (const auto event = log.next()) {
    for (std::size_t i = 4; i < 12; ++i)
      places.insert(begin + i);
    begin += 28 + event->channel.size() + event->message.size();
  }
  return places;
}

TEST_F(Recording, WithOneChangedBitIsFoundOut) {
  const std::string whole = bytes();
  const std::set<std::size_t> numbers = places_of_numbers(path_);
  constexpr std::uint64_t kSeed = 5;
  std::mt19937_64 random(kSeed);
  for (int i = 0; i < 20; ++i) {
    std::string flipped = whole;
    const std::size_t place = 4 + random() % (whole.size() - 4);  // without the first sync word it is no log at all
    if (numbers.contains(place)) continue;
    flipped[place] = static_cast<char>(static_cast<unsigned char>(flipped[place]) ^ (1U << random() % 8U));
    const std::string path = changed(flipped);
    EXPECT_NE(fault(path), "") << "seed " << kSeed << ", byte " << place << " of " << whole.size();
  }
}

// The simulation is ahead of the ticks then.
TEST_F(Recording, WithTwoChangesTellsTheFirst) {
  std::vector<devices::LogEvent> events;
  devices::EventLogReader log(path_);
  while (const auto event = log.next())
    events.push_back(*event);
  int ticks = 0;
  for (devices::LogEvent& event : events) {
    ticks += event.channel == "HAPTIC_TICK" ? 1 : 0;
    if (ticks == 300 && event.channel == "HAPTIC_STATE") event.message.back() ^= 1U;
    if (ticks == 302 && event.channel == "CONTACT_SET") event.message.back() ^= 1U;
  }
  const std::string path = folder_.path("two.lcmlog");
  devices::EventLogWriter writer(path);
  for (const devices::LogEvent& event : events)
    writer.write(event);
  writer.close();
  EXPECT_EQ(fault(path), "the event on HAPTIC_STATE after tick 300 differs");
  EXPECT_EQ(ticks_, 300);
}

TEST_F(Recording, FlightRecordingHasABoundedSize) {
  constexpr std::size_t kMost = 1 << 20;
  FlightRecorder recorder(recorded_head(), kMost);
  record(recorder);
  const std::string path = folder_.path("flight.lcmlog");
  recorder.write(path);
  devices::EventLogReader log(path);
  std::size_t size = 0;
  std::optional<devices::HapticState> newest;
  while (const auto event = log.next()) {
    size += event->message.size();
    if (const auto state = haptic_state_of(*event)) newest = state;
  }
  EXPECT_EQ(log.damage(), "");
  EXPECT_LE(size, kMost);
  EXPECT_GE(size, kMost / 2);
  ASSERT_TRUE(newest);
  EXPECT_EQ(newest->sequence, kRecordedTicks);
  EXPECT_EQ(devices::EventLogReader(path).next(), recorded_head().events.front()) << "although the rest is newer";
}

}  // namespace
}  // namespace glissade::haptics
