#include <algorithm>
#include <stdexcept>
#include <string_view>

#include <glissade/haptics/haptic_server.h>

#include "loop/haptic_sample.h"

namespace glissade::haptics {

namespace {

constexpr double kLongestCatchUp_ms = 250.0;

/// A device whose rates are slow needs long for its fade.
std::chrono::nanoseconds longest_fade(const devices::DeviceDescriptor& device) noexcept {
  const auto time = [](double maximum, double rate) { return rate > 0.0 ? maximum / rate : 0.0; };
  const double slowest_s =
      std::max({time(device.max_force, device.max_force_rate), time(device.max_torque, device.max_torque_rate), 0.5});
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
      std::chrono::duration<double>(2.0 * std::min(slowest_s, 1e6)));
}

}  // namespace

HapticServer::HapticServer(devices::GloveDevice& device, SlidingSimulation& simulation, realtime::Clock& clock,
                           Sink sink, const HapticServerOptions& options)
    : device_(device),
      simulation_(simulation),
      clock_(clock),
      sink_(std::move(sink)),
      options_(options),
      kernel_(simulation.part(), simulation.stiffness(), device.descriptor(), simulation.result().X_WV,
              options.period) {
  validate_tick_period(options.period);
  if (!sink_) throw std::invalid_argument("a haptic server needs a sink for its states, not an empty function");
  ContactSet at_start;
  at_start.X_WV = simulation.result().X_WV;
  sets_.publish(at_start);
  simulation_thread_ = std::make_unique<realtime::PeriodicThread>(
      clock, realtime::PeriodicThreadOptions{.period = kTickPeriod, .name = "simulation"},
      [this](const realtime::PeriodicTick&) { return simulation_tick(); });
  haptic_thread_ = std::make_unique<realtime::PeriodicThread>(
      clock,
      realtime::PeriodicThreadOptions{
          .period = options.period, .fifo_priority = options.fifo_priority, .name = "haptic"},
      [this](const realtime::PeriodicTick& timing) { return haptic_tick(timing); });
}

bool HapticServer::haptic_tick(const realtime::PeriodicTick& timing) noexcept {
  const bool should_end = should_end_.load(std::memory_order_relaxed);
  if (!device_.read(state_)) return !should_end;  // no device yet
  const bool is_ending = should_end || (options_.ticks > 0 && ticks() == options_.ticks);
  if (is_ending || emergency_.load(std::memory_order_relaxed) || has_failed()) kernel_.stop();
  sets_.update();
  const ContactSet& set = sets_.value();
  const HapticTick tick = kernel_.tick(state_, set, timing.start);
  device_.command(tick.command);
  if (is_ending) return go_on_fading(tick, timing.start);
  ghosts_.publish({tick.X_WG, timing.start});
  report(tick, set, timing.start);
  return true;
}

void HapticServer::report(const HapticTick& tick, const ContactSet& set, std::chrono::nanoseconds now) noexcept {
  const devices::HapticState sample = make_sample(tick, set, state_, now);
  statistics_.contact_set_age.record(sample.contact_set_age);
  statistics_.unsolved_ticks += sample.are_contacts_unsolved ? 1 : 0;
  if (!sink_failed_) sink_failed_ = !guarded([&] { sink_(sample); });
  ticks_.fetch_add(1, std::memory_order_relaxed);
}

bool HapticServer::go_on_fading(const HapticTick& tick, std::chrono::nanoseconds now) noexcept {
  if (!fading_since_) fading_since_ = now;
  const devices::GloveCommand& command = tick.command.values();
  const bool is_at_rest = command.f_H_W.isZero(0.0) && command.t_H_W.isZero(0.0);
  if (!is_at_rest && now - *fading_since_ < longest_fade(device_.descriptor())) return true;
  done_.store(options_.ticks > 0 && ticks() == options_.ticks, std::memory_order_release);
  return false;
}

bool HapticServer::simulation_tick() noexcept {
  return guarded([this] { answer_newest_ghost(); }) && !has_failed();
}

/// Runs `work`; keeps the message of an exception, the first one. Returns whether there was none.
template <typename Work>
bool HapticServer::guarded(const Work& work) noexcept {
  try {
    work();
    return true;
  } catch (const std::exception& error) {
    fail(error.what());
  } catch (...) {
    fail("an exception of unknown type");
  }
  return false;
}

void HapticServer::fail(std::string_view message) noexcept {
  if (is_failing_.exchange(true)) return;
  std::copy_n(message.begin(), std::min(message.size(), failure_.size() - 1), failure_.begin());
  failed_.store(true, std::memory_order_release);
}

void HapticServer::answer_newest_ghost() {
  if (!ghosts_.update()) return;
  const Ghost& ghost = ghosts_.value();
  const std::chrono::nanoseconds start = clock_.now();
  // An answer that takes long must not slow the part down: the slew is a speed.
  const std::chrono::nanoseconds passed = answered_ ? ghost.time - *answered_ : kTickPeriod;
  const double milliseconds = std::chrono::duration<double, std::milli>(passed).count();
  simulation_.advance(ghost.X_WG, std::clamp(milliseconds, 1.0, kLongestCatchUp_ms));
  answered_ = ghost.time;
  sets_.publish(make_contact_set(simulation_.result(), simulation_.part(), ++set_sequence_, ghost.time, scratch_));
  statistics_.simulation.record(clock_.now() - start);
}

void HapticServer::stop() {
  should_end_.store(true, std::memory_order_relaxed);
  haptic_thread_->join();
  simulation_thread_->stop();
  statistics_.haptic = haptic_thread_->statistics();
  statistics_.has_fifo_scheduling = haptic_thread_->scheduling().is_fifo;
}

}  // namespace glissade::haptics
