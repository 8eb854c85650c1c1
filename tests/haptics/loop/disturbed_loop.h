#pragma once

/// Glove, link, haptic loop and simulation, which take turns on a simulated clock, with the times of a real loop: a
/// tick that takes longer than a period makes the loop skip deadlines. Parts of it fail on demand.

#include <algorithm>
#include <chrono>
#include <functional>
#include <optional>
#include <utility>

#include <glissade/devices/safety_envelope.h>
#include <glissade/devices/simulated_glove.h>
#include <glissade/haptics/haptic_kernel.h>
#include <glissade/realtime/periodic_loop.h>

namespace glissade::haptics {

/// What a device, its wearer and a simulation are.
class DisturbedWorld {
 public:
  virtual ~DisturbedWorld() = default;

  virtual devices::SimulatedGlove& glove() = 0;
  virtual HapticKernel& kernel() = 0;
  virtual ContactSet at_start() = 0;
  virtual void answer(const Ghosts& ghosts, ContactSet& set) = 0;
};

/// What goes wrong. Times are since the start. An empty function disturbs nothing.
struct Failure {
  using Time = std::chrono::nanoseconds;

  std::function<bool(Time now)> holds_simulation{};           ///< the simulation does not answer now
  std::function<void(Time now, ContactSet& set)> corrupts{};  ///< changes the set of the tick that starts now
  std::function<Time(Time start)> tick_time{};                ///< how long the tick that starts now takes
};

class DisturbedLoop {
 public:
  using Time = std::chrono::nanoseconds;
  /// Gets a command, and the state of the hand on which it acts.
  using See = std::function<void(Time now, const devices::GloveCommand& command, const devices::GloveState& state)>;

  /// `world` must outlive the loop.
  DisturbedLoop(DisturbedWorld& world, Failure failure)
      : world_(world),
        failure_(std::move(failure)),
        state_(world.glove().state()),
        envelope_(world.glove().descriptor(), 6.0),
        set_(world.at_start()) {}

  /// Until that time since the start. `see_server` gets each command of the kernel; `see_hand` what the glove does,
  /// every millisecond.
  void run(Time end, const See& see_server, const See& see_hand) {
    while (now_ < end) {
      now_ += kTickPeriod;
      move_hand();
      see_hand(now_, given_.values(), state_);
      while (next_start() <= now_)
        tick(see_server);
      answer();
    }
  }

  const realtime::PeriodicStatistics& statistics() const { return statistics_; }

 private:
  Time next_start() const { return std::max(schedule_.deadline(), busy_until_); }

  /// The command is sent when the tick ends.
  void tick(const See& see_server) {
    const Time start = next_start();
    deliver(start);
    ContactSet set = set_;
    if (failure_.corrupts) failure_.corrupts(start, set);
    const devices::GloveState* const newest = &state_;
    on_its_way_ = world_.kernel().tick({&newest, 1}, set, start);
    busy_until_ = start + (failure_.tick_time ? failure_.tick_time(start) : Time(0));
    schedule_.finish_tick(start, busy_until_, statistics_);
    see_server(start, on_its_way_->hands[0].command.values(), state_);
  }

  void deliver(Time time) {
    if (!on_its_way_ || busy_until_ > time) return;
    command_ = on_its_way_->hands[0].command.values();
    ghosts_ = on_its_way_->ghosts;
    on_its_way_.reset();
  }

  /// A period of the glove: a measurement, and the newest command until the next one.
  void move_hand() {
    deliver(now_);
    state_ = world_.glove().step(kTickPeriod, given_);
    given_ = envelope_.limit(command_, state_, now_);
    state_.link_delay = envelope_.link_delay();
  }

  void answer() {
    if (!ghosts_ || (failure_.holds_simulation && failure_.holds_simulation(now_))) return;
    world_.answer(*ghosts_, set_);
    ghosts_.reset();
  }

  DisturbedWorld& world_;
  Failure failure_;
  Time now_{0};
  devices::GloveState state_;         // as the haptic loop knows it
  devices::SafetyEnvelope envelope_;  // at the glove's end
  devices::GloveCommand command_;     // the newest that came
  devices::SafeCommand given_;
  ContactSet set_;
  realtime::PeriodicSchedule schedule_{kTickPeriod, kTickPeriod};
  realtime::PeriodicStatistics statistics_;
  Time busy_until_{0};
  std::optional<HapticTick> on_its_way_;
  std::optional<Ghosts> ghosts_;  // that the simulation has not answered
};

}  // namespace glissade::haptics
