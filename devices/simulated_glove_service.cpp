#include <algorithm>
#include <utility>

#include <glissade/devices/glove_model.h>
#include <glissade/devices/simulated_glove_service.h>

#include "lcm/wearers_view.h"

namespace glissade::devices {

SimulatedGloveService::SimulatedGloveService(const std::shared_ptr<LcmBus>& bus, SimulatedGlove glove,
                                             realtime::Clock& clock, const LcmGloveHostOptions& options,
                                             Observer observer, bool waits_for_server)
    : host_(bus, glove.descriptor(), options),
      view_(std::make_unique<WearersView>(bus)),
      glove_(std::move(glove)),
      observer_(std::move(observer)),
      waits_for_server_(waits_for_server),
      state_(glove_.state()) {
  thread_ = std::make_unique<realtime::PeriodicThread>(
      clock,
      realtime::PeriodicThreadOptions{
          .fifo_priority = realtime::kLinkPriority, .fifo_share = realtime::kLinkShare, .name = "glove"},
      [this](const realtime::PeriodicTick& now) { return tick(now.deadline); });
}

SimulatedGloveService::~SimulatedGloveService() {
  stop();
}

void SimulatedGloveService::stop() {
  host_.stop();
  should_end_.store(true, std::memory_order_release);
  thread_->join();
}

LinkLosses SimulatedGloveService::link_losses() const noexcept {
  return glove_.link_losses();
}

/// Returns false when nothing is left to do.
bool SimulatedGloveService::tick(std::chrono::nanoseconds deadline) noexcept {
  const SafeCommand command = host_.newest_command(state_);
  const HandWrench held = half_space_wrench(command.values().half_spaces, state_.X_WH);
  greatest_force_ = std::max(greatest_force_, (command.values().f_H_W + held.f_H_W).norm());
  // More than a period where deadlines were skipped.
  const std::chrono::nanoseconds passed = last_deadline_ ? deadline - *last_deadline_ : std::chrono::nanoseconds(0);
  last_deadline_ = deadline;
  const bool has_server = host_.statistics().accepted > 0;
  const std::chrono::nanoseconds script_before = glove_.script_time();
  const std::int64_t sequence_before = state_.sequence;
  const double pace_without_server = waits_for_server_ ? 0.0 : 1.0;
  state_ = glove_.step(passed, command, has_server ? pace_for(age_of_answers(command)) : pace_without_server);
  const std::chrono::nanoseconds script_passed = glove_.script_time() - script_before;
  state_.time = deadline - glove_.state_age();  // on the clock of the thread
  if (state_.sequence != sequence_before) send(state_);
  if (observer_ && !observer_(state_, command)) host_.stop();
  script_time_.store(script_time() + script_passed, std::memory_order_relaxed);
  if (has_server) waited_.store(waited() + passed - script_passed, std::memory_order_relaxed);
  if (!should_end_.load(std::memory_order_acquire)) return true;
  constexpr int kLongestEnd = 100;  // periods; longer than any fade of this glove
  return !command.values().is_at_rest() && ++ending_ticks_ < kLongestEnd;
}

/// Of what the wearer sees and feels, the older.
std::chrono::nanoseconds SimulatedGloveService::age_of_answers(const SafeCommand& command) const noexcept {
  return std::max(command.age(), view_->age().value_or(std::chrono::nanoseconds(0)));
}

// A state that cannot be encoded or sent counts as lost on the way: the server sees the gap in the sequence.
void SimulatedGloveService::send(const GloveState& state) noexcept {
  try {
    host_.publish(state);
  } catch (...) {  // NOLINT(bugprone-empty-catch): a lost message is no reason to end the thread
  }
}

}  // namespace glissade::devices
