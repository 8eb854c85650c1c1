#include <algorithm>
#include <stdexcept>

#include <glissade/haptics/haptic_server.h>

#include "loop/haptic_sample.h"

namespace glissade::haptics {

namespace {
constexpr double kLongestCatchUp_ms = 250.0;
}  // namespace

HapticServer::HapticServer(devices::GloveDevice& device, SlidingSimulation& simulation, realtime::Clock& clock,
                           Sink sink, const HapticServerOptions& options)
    : device_(device),
      simulation_(simulation),
      clock_(clock),
      sink_(std::move(sink)),
      options_(options),
      kernel_(simulation.part(), simulation.stiffness(), device.descriptor(), simulation.result().X_WV) {
  if (!sink_) throw std::invalid_argument("a haptic server needs a sink for its states, not an empty function");
  ContactSet at_start;
  at_start.X_WV = simulation.result().X_WV;
  sets_.publish(at_start);
  simulation_thread_ = std::make_unique<realtime::PeriodicThread>(
      clock, realtime::PeriodicThreadOptions{.period = kTickPeriod}, [this](const realtime::PeriodicTick&) {
        simulation_tick();
        return true;
      });
  haptic_thread_ = std::make_unique<realtime::PeriodicThread>(
      clock, realtime::PeriodicThreadOptions{.period = kTickPeriod, .fifo_priority = options.fifo_priority},
      [this](const realtime::PeriodicTick& timing) { return haptic_tick(timing); });
}

bool HapticServer::haptic_tick(const realtime::PeriodicTick& timing) noexcept {
  if (!device_.read(state_)) return true;  // no device yet
  if (state_.sequence != state_sequence_) {
    state_sequence_ = state_.sequence;
    state_arrival_ = timing.start;
  }
  sets_.update();
  const ContactSet& set = sets_.value();
  HapticTick tick = kernel_.tick(state_, set);
  const bool device_is_silent = timing.start - state_arrival_ > options_.device_timeout;
  if (device_is_silent) {
    tick.command.f_H_W.setZero();
    tick.command.t_H_W.setZero();
  }
  device_.command(tick.command);
  ghosts_.publish({tick.X_WG, timing.start});

  devices::HapticState sample = make_sample(tick, set, state_.X_WH.translation(), timing.start);
  sample.has_no_device = device_is_silent;
  statistics_.contact_set_age.record(sample.contact_set_age);
  sink_(sample);

  const std::int64_t done = ticks_.load(std::memory_order_relaxed) + 1;
  ticks_.store(done, std::memory_order_relaxed);
  if (done != options_.ticks) return true;
  done_.store(true, std::memory_order_release);
  return false;
}

void HapticServer::simulation_tick() {
  if (!ghosts_.update()) return;
  const Ghost& ghost = ghosts_.value();
  const std::chrono::nanoseconds start = clock_.now();
  // An answer that takes long must not slow the part down: the slew is a speed.
  const double milliseconds = std::chrono::duration<double, std::milli>(ghost.time - answered_).count();
  simulation_.advance(ghost.X_WG, std::clamp(milliseconds, 1.0, kLongestCatchUp_ms));
  answered_ = ghost.time;
  sets_.publish(make_contact_set(simulation_.result(), simulation_.part(), ++set_sequence_, ghost.time, scratch_));
  statistics_.simulation.record(clock_.now() - start);
}

void HapticServer::stop() {
  haptic_thread_->stop();
  simulation_thread_->stop();
  statistics_.haptic = haptic_thread_->statistics();
  statistics_.has_fifo_scheduling = haptic_thread_->scheduling().is_fifo;
}

}  // namespace glissade::haptics
