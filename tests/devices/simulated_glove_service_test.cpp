#include <algorithm>
#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glissade/devices/glove_model.h>
#include <glissade/devices/simulated_glove_service.h>

#include "eventually.h"
#include "lcm/glove_messages.h"
#include "lcm/haptic_state_message.h"
#include "lcm/wearers_view.h"

namespace glissade::devices {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;

/// Oversleeps by 4.5 ms whenever it sleeps, so that a loop of 1 ms has ticks for the deadlines 0, 4, 5, 9, 10, … ms.
class DrowsyClock final : public realtime::Clock {
 public:
  nanoseconds now() const noexcept override { return now_; }
  void sleep_until(nanoseconds deadline) noexcept override {
    std::this_thread::sleep_for(microseconds(100));  // leaves the bus time to carry the messages
    if (deadline > now_) now_ = deadline + microseconds(4500);
  }

 private:
  nanoseconds now_{0};
};

class SimulatedGloveServiceTest : public testing::Test {
 protected:
  /// The time of every state that has arrived.
  std::vector<nanoseconds> state_times() {
    const std::lock_guard lock(mutex_);
    return times_;
  }

  std::int64_t session_of_glove() {
    const std::lock_guard lock(mutex_);
    return header_.session;
  }

  std::shared_ptr<LcmBus> bus = std::make_shared<LcmBus>("memq://");

 private:
  std::mutex mutex_;
  std::vector<nanoseconds> times_;
  StateHeader header_;
  std::unique_ptr<LcmBus::Subscription> subscription_ =
      bus->subscribe(kGloveStateChannel, [this](std::span<const std::uint8_t> message) {
        GloveState state;
        const std::lock_guard lock(mutex_);
        if (decode(message, header_, state) == MessageError::kNone) times_.push_back(state.time);
      });
};

TEST_F(SimulatedGloveServiceTest, WaitsForTheFirstCommandAndThenRunsByTime) {
  DrowsyClock clock;
  SimulatedGloveService service(bus, SimulatedGlove(geometry::PoseTrajectory({geometry::TimedPose{}})), clock);
  ASSERT_TRUE(eventually([this] { return state_times().size() >= 20; }));
  EXPECT_EQ(service.script_time(), nanoseconds(0));

  const CommandHeader header{.device = kDefaultDevice, .glove_session = session_of_glove(), .session = 1};
  bus->publish(kGloveCommandChannel, encode(header, GloveCommand{}));
  // No second one comes. Soon the wearer gives up waiting for it.
  ASSERT_TRUE(eventually([&] { return service.script_time() >= milliseconds(200); }));
  EXPECT_GE(service.waited(), milliseconds(500));
  const nanoseconds before = service.script_time();
  ASSERT_TRUE(eventually([&] { return service.script_time() >= before + milliseconds(200); }));
  EXPECT_EQ((service.script_time() - before) % milliseconds(1), nanoseconds(0))
      << "deadlines, not their delays, move the script";
  service.stop();

  // The glove's clock runs from the first state on, also while the script waits.
  const std::vector<nanoseconds> times = state_times();
  for (std::size_t i = 2; i < times.size(); ++i)
    EXPECT_EQ(times[i] - times[i - 2], milliseconds(5)) << "at " << times[i].count() << " ns";
}

// The hand waits for a server, but the device measures on.
TEST_F(SimulatedGloveServiceTest, GloveOfAModelSendsEachMeasurementOnce) {
  DrowsyClock clock;
  GloveModel model;
  model.update_rate = 100.0;
  model.measurement_delay = 0.005;
  SimulatedGloveService service(bus, SimulatedGlove(geometry::PoseTrajectory({geometry::TimedPose{}}), {}, model),
                                clock);
  ASSERT_TRUE(eventually([this] { return state_times().size() >= 10; }));
  EXPECT_EQ(service.script_time(), nanoseconds(0));
  service.stop();
  const std::vector<nanoseconds> times = state_times();
  for (std::size_t i = 1; i < times.size(); ++i)
    EXPECT_EQ(times[i] - times[i - 1], milliseconds(10)) << "at " << times[i].count() << " ns";
}

// What a wearer sees is as old as the contacts, and since then it has become older.
TEST_F(SimulatedGloveServiceTest, WearersViewHasTheAgeOfTheContacts) {
  WearersView view(bus);
  EXPECT_EQ(view.age(), std::nullopt);
  bus->publish(kHapticStateChannel, encode(HapticState{.contact_set_age = milliseconds(300)}));
  ASSERT_TRUE(eventually([&] { return view.age().has_value(); }));
  EXPECT_GE(view.age(), milliseconds(300));
}

TEST(PaceOfTheWearer, FallsWithTheAgeOfAnswersUntilPatienceEnds) {
  EXPECT_EQ(pace_for(nanoseconds(0)), 1.0);
  EXPECT_EQ(pace_for(milliseconds(20)), 1.0);
  EXPECT_NEAR(pace_for(milliseconds(60)), 0.5, 1e-12);
  EXPECT_EQ(pace_for(milliseconds(100)), 0.0);
  EXPECT_EQ(pace_for(milliseconds(3000)), 0.0);
  EXPECT_EQ(pace_for(milliseconds(3001)), 1.0);
}

}  // namespace
}  // namespace glissade::devices
