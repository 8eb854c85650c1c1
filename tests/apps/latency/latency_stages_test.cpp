/// From stamps to stages, with stamps that are given.

#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/apps/latency/latency_glove.h>
#include <glissade/apps/latency/latency_stages.h>
#include <glissade/apps/latency/shared_stamps.h>

namespace glissade::apps {
namespace {

using realtime::LatencyHistogram;
using std::chrono::nanoseconds;

TEST(LatencyStages, EachStageIsTheTimeBetweenItsStamps) {
  LatencyStages stages;
  stages.record({nanoseconds(1000), nanoseconds(1001), nanoseconds(1011), nanoseconds(1013), nanoseconds(1050)});
  EXPECT_EQ(stages.transport.max(), nanoseconds(1));
  EXPECT_EQ(stages.wait.max(), nanoseconds(10));
  EXPECT_EQ(stages.computation.max(), nanoseconds(2));
  EXPECT_EQ(stages.way_back.max(), nanoseconds(37));
  EXPECT_EQ(stages.whole.max(), nanoseconds(50));
}

TEST(LatencyStages, StagesSumToWholeEvenIfReadPrecedesArrivalStamp) {
  LatencyStages stages;
  stages.record({nanoseconds(0), nanoseconds(70), nanoseconds(60), nanoseconds(65), nanoseconds(100)});
  const nanoseconds sum = stages.transport.max() + stages.wait.max() + stages.computation.max() + stages.way_back.max();
  EXPECT_EQ(sum, stages.whole.max());
  EXPECT_EQ(stages.wait.max(), nanoseconds(0));
}

TEST(SharedStamps, TheFirstStampOfANumberCountsUntilAllAreCleared) {
  SharedStamps stamps(10);
  EXPECT_EQ(stamps.at(3), std::nullopt);
  stamps.note(3, nanoseconds(30));
  stamps.note(3, nanoseconds(40));
  EXPECT_EQ(stamps.at(3), nanoseconds(30));
  for (const std::int64_t outside : {-1, 10}) {
    stamps.note(outside, nanoseconds(1));
    EXPECT_EQ(stamps.at(outside), std::nullopt) << outside;
  }
  stamps.clear();
  EXPECT_EQ(stamps.at(3), std::nullopt);
}

/// A device whose states are given.
class GivenStates final : public devices::GloveDevice {
 public:
  const devices::DeviceDescriptor& descriptor() const noexcept override { return descriptor_; }
  bool read(devices::GloveState& newest) noexcept override {
    newest = state;
    return true;
  }
  void command(const devices::SafeCommand& command) noexcept override { last = command.values(); }

  devices::GloveState state;
  devices::GloveCommand last;

 private:
  devices::DeviceDescriptor descriptor_{.name = "given"};
};

/// A haptic loop by hand: answers the state of `device` with the command `sequence`.
void tick(StampedGlove& glove, devices::SafetyEnvelope& envelope, std::int64_t sequence) {
  devices::GloveState state;
  ASSERT_TRUE(glove.read(state));
  devices::GloveCommand command;
  command.sequence = sequence;
  command.state_sequence = state.sequence;
  command.state_time = state.time;
  glove.command(envelope.limit(command, state, state.time));
}

TEST(StampedGlove, SampleReadTwiceCountsOnceAndWithoutCommandIsLost) {
  GivenStates device;
  StampedGlove glove(device, 100);
  devices::SafetyEnvelope envelope(device.descriptor());
  SharedStamps received(10);
  SharedStamps arrivals(10);
  const nanoseconds now = realtime::SteadyClock().now();
  const nanoseconds later = now + std::chrono::hours(1);
  device.state.sequence = 1;
  device.state.time = now;
  tick(glove, envelope, 1);
  tick(glove, envelope, 2);
  device.state.sequence = 2;
  device.state.time = now + nanoseconds(1);
  tick(glove, envelope, 3);
  EXPECT_EQ(device.last.sequence, 3);
  for (const std::int64_t state : {1, 2})
    received.note(state, now + nanoseconds(1));
  arrivals.note(1, later);
  arrivals.note(2, later + std::chrono::hours(1));

  LatencyStages stages;
  glove.add_ways(received, arrivals, stages);
  EXPECT_EQ(stages.whole.count(), 1U);
  EXPECT_EQ(stages.whole.max(), later - now) << "the way of the first command";
  EXPECT_EQ(stages.lost, 1U);
}

TEST(StampedGlove, SamplesBeyondCapacityAreLost) {
  GivenStates device;
  StampedGlove glove(device, 2);
  devices::SafetyEnvelope envelope(device.descriptor());
  for (device.state.sequence = 1; device.state.sequence <= 5; ++device.state.sequence)
    tick(glove, envelope, device.state.sequence);
  LatencyStages stages;
  glove.add_ways(SharedStamps(10), SharedStamps(10), stages);
  EXPECT_EQ(stages.lost, 2U);
  EXPECT_EQ(device.last.sequence, 5) << "all commands reach the device";
}

}  // namespace
}  // namespace glissade::apps
