#include <algorithm>
#include <utility>

#include <glissade/apps/latency/latency_glove.h>
#include <glissade/apps/latency/latency_rules.h>
#include <glissade/lcmtypes/glove_command_t.hpp>
#include <glissade/lcmtypes/glove_state_t.hpp>

namespace glissade::apps {

namespace {

constexpr std::chrono::milliseconds kLongestStep{10};  // after a pause of the machine

/// Down by 5 mm, and from there to and fro.
geometry::PoseTrajectory pressing_way() {
  constexpr int kTurns = 1000;  // of a quarter of a second each: more than any run needs
  constexpr double kAmplitude = 0.02;
  constexpr double kDepth = 0.005;
  std::vector<geometry::TimedPose> rows{{}};
  for (int i = 1; i <= kTurns; ++i) {
    const double x = i % 2 == 0 ? kAmplitude : 0.0;
    rows.push_back({i * std::chrono::milliseconds(250), Eigen::Isometry3d(Eigen::Translation3d(x, 0.0, -kDepth))});
  }
  return geometry::PoseTrajectory(rows);
}

/// Calls `note(message)` for each message of the type on the channel.
template <typename Message, typename Note>
std::unique_ptr<devices::LcmBus::Subscription> on_message(devices::LcmBus& bus, const char* channel, Note note) {
  return bus.subscribe(channel, [note](std::span<const std::uint8_t> bytes) {
    Message message;
    if (message.decode(bytes.data(), 0, static_cast<int>(bytes.size())) >= 0) note(message);
  });
}

}  // namespace

LatencyHand::LatencyHand() : glove_(pressing_way()), state_(glove_.state()) {}

const devices::GloveState& LatencyHand::step(std::chrono::nanoseconds deadline,
                                             const devices::SafeCommand& command) noexcept {
  const std::chrono::nanoseconds passed = deadline - std::exchange(last_deadline_, deadline);
  state_ = glove_.step(std::min<std::chrono::nanoseconds>(passed, kLongestStep), command);
  state_.time = clock_.now();
  return state_;
}

LinkedGlove::LinkedGlove(const std::shared_ptr<devices::LcmBus>& bus, SharedStamps& arrivals)
    : host_(bus, hand_.descriptor()) {
  subscription_ = on_message<glissade::glove_command_t>(
      *bus, "GLOVE_COMMAND",
      [this, &arrivals](const glissade::glove_command_t& command) { arrivals.note(command.sequence, clock_.now()); });
  thread_ = std::make_unique<realtime::PeriodicThread>(
      clock_,
      realtime::PeriodicThreadOptions{
          .period = kLatencyGlovePeriod, .fifo_priority = realtime::kHapticPriority, .name = "glove"},
      [this](const realtime::PeriodicTick& now) {
        tick(now.deadline);
        return true;
      });
}

// A state that cannot be encoded or sent counts as lost on the way.
void LinkedGlove::tick(std::chrono::nanoseconds deadline) noexcept {
  try {
    host_.publish(hand_.step(deadline, host_.newest_command(hand_.state())));
  } catch (...) {  // NOLINT(bugprone-empty-catch): a lost message is no reason to end the thread
  }
}

std::unique_ptr<devices::LcmBus::Subscription> note_states(devices::LcmBus& bus, SharedStamps& received) {
  return on_message<glissade::glove_state_t>(bus, "GLOVE_STATE", [&received](const glissade::glove_state_t& state) {
    received.note(state.sequence, realtime::SteadyClock().now());
  });
}

DirectGlove::DirectGlove(SharedStamps& received, SharedStamps& arrivals) : received_(received), arrivals_(arrivals) {
  driver_ = std::make_unique<realtime::PeriodicThread>(
      clock_,
      realtime::PeriodicThreadOptions{
          .period = kLatencyGlovePeriod, .fifo_priority = realtime::kHapticPriority, .name = "glove"},
      [this](const realtime::PeriodicTick& now) {
        const devices::GloveState& state = hand_.step(now.deadline, commands_.latest());
        states_.publish(state);
        received_.note(state.sequence, clock_.now());
        return true;
      });
}

bool DirectGlove::read(devices::GloveState& newest) noexcept {
  has_state_ = states_.update() || has_state_;
  if (has_state_) newest = states_.value();
  return has_state_;
}

void DirectGlove::command(const devices::SafeCommand& command) noexcept {
  commands_.publish(command);
  arrivals_.note(command.values().sequence, clock_.now());
}

StampedGlove::StampedGlove(devices::GloveDevice& device, std::size_t capacity) : device_(device) {
  answers_.reserve(capacity);
}

bool StampedGlove::read(devices::GloveState& newest) noexcept {
  read_ = clock_.now();
  return device_.read(newest);
}

void StampedGlove::command(const devices::SafeCommand& command) noexcept {
  if (answers_.size() < answers_.capacity()) {  // more would allocate
    const devices::GloveCommand& values = command.values();
    answers_.push_back({values.sequence, values.state_sequence, values.state_time, read_, clock_.now()});
  }
  device_.command(command);
}

void StampedGlove::add_ways(const SharedStamps& received, const SharedStamps& arrivals, LatencyStages& stages) const {
  std::int64_t last_state = -1;
  for (const Answer& answer : answers_) {
    if (std::exchange(last_state, answer.state) == answer.state) continue;
    const auto state_received = received.at(answer.state);
    const auto arrived = arrivals.at(answer.command);
    if (state_received && arrived) {
      stages.record({answer.measured, *state_received, answer.read, answer.handed_over, *arrived});
    } else {
      ++stages.lost;
    }
  }
}

}  // namespace glissade::apps
