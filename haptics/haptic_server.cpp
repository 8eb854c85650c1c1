#include <algorithm>
#include <stdexcept>
#include <string_view>

#include <sys/resource.h>

#include <glissade/haptics/haptic_server.h>

#include "loop/answer.h"
#include "loop/haptic_sample.h"

namespace glissade::haptics {

namespace {

/// A device whose rates are slow needs long for its fade.
std::chrono::nanoseconds longest_fade(const devices::DeviceDescriptor& device) noexcept {
  const auto time = [](double maximum, double rate) { return rate > 0.0 ? maximum / rate : 0.0; };
  const double slowest_s =
      std::max({time(device.max_force, device.max_force_rate), time(device.max_torque, device.max_torque_rate), 0.5});
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
      std::chrono::duration<double>(2.0 * std::min(slowest_s, 1e6)));
}

std::int64_t page_faults_of_this_thread() noexcept {
  rusage usage{};
  getrusage(RUSAGE_THREAD, &usage);
  return usage.ru_minflt + usage.ru_majflt;
}

std::vector<KernelHand> kernel_hands(const std::vector<HandOfServer>& hands) {
  std::vector<KernelHand> result;
  for (const HandOfServer& hand : hands) {
    if (hand.device == nullptr) throw std::invalid_argument("a haptic server needs a device, not a null pointer");
    result.push_back({hand.device->descriptor(), hand.part});
  }
  return result;
}

}  // namespace

HapticServer::HapticServer(const std::vector<HandOfServer>& hands, MultiPartSliding& sliding, realtime::Clock& clock,
                           Sink sink, const HapticServerOptions& options)
    : clock_(clock),
      sink_(std::move(sink)),
      options_(options),
      kernel_(kernel_parts(sliding), kernel_hands(hands), options.period),
      answerer_(std::make_unique<Answerer>(sliding)) {
  validate_tick_period(options.period);
  if (!sink_) throw std::invalid_argument("a haptic server needs a sink for its states, not an empty function");
  for (const HandOfServer& hand : hands)
    hands_.push_back({hand.device});
  sets_.publish(answerer_->at_start());
  simulation_thread_ = std::make_unique<realtime::PeriodicThread>(
      clock, realtime::PeriodicThreadOptions{.period = kTickPeriod, .name = "simulation"},
      [this](const realtime::PeriodicTick&) { return simulation_tick(); });
  haptic_thread_ = std::make_unique<realtime::PeriodicThread>(
      clock,
      realtime::PeriodicThreadOptions{
          .period = options.period, .fifo_priority = options.fifo_priority, .spin = options.spin, .name = "haptic"},
      [this](const realtime::PeriodicTick& timing) { return haptic_tick(timing); });
}

HapticServer::~HapticServer() {
  stop();
}

/// Returns whether any device has a state.
bool HapticServer::read_devices() noexcept {
  bool any = false;
  for (std::size_t h = 0; h < hands_.size(); ++h) {
    if (hands_[h].device->read(hands_[h].state)) states_[h] = &hands_[h].state;
    any = any || states_[h] != nullptr;
  }
  return any;
}

void HapticServer::take_events() noexcept {
  Event event;
  for (std::size_t i = 0; i < events_.capacity() && events_.pop(event); ++i) {
    if (event.part) {
      kernel_.grasp(event.hand, *event.part);
    } else {
      kernel_.release(event.hand);
    }
  }
}

bool HapticServer::haptic_tick(const realtime::PeriodicTick& timing) noexcept {
  const bool should_end = should_end_.load(std::memory_order_relaxed);
  if (!read_devices()) return !should_end;
  const bool is_ending = should_end || (options_.ticks > 0 && ticks() == options_.ticks);
  if (is_ending || emergency_.load(std::memory_order_relaxed) || has_failed()) kernel_.stop();
  take_events();
  sets_.update();
  const ContactSet& set = sets_.value();
  const HapticTick tick = kernel_.tick({states_.data(), hands_.size()}, set, timing.start);
  for (std::size_t h = 0; h < hands_.size(); ++h) {
    if (states_[h] != nullptr) hands_[h].device->command(tick.hands[h].command);
  }
  if (is_ending) return go_on_fading(tick, timing.start);
  ghosts_.publish(tick.ghosts);
  report(tick, set, timing.start);
  return true;
}

void HapticServer::report(const HapticTick& tick, const ContactSet& set, std::chrono::nanoseconds now) noexcept {
  if (ticks() == 0) page_faults_before_ = page_faults_of_this_thread();
  const devices::HapticState sample = make_sample(ticks() + 1, tick, set, {states_.data(), hands_.size()}, now);
  statistics_.contact_set_age.record(sample.contact_set_age);
  const bool any_unsolved =
      std::any_of(tick.hands.begin(), tick.hands.end(), [](const HandTick& hand) { return hand.is_unsolved; });
  statistics_.unsolved_ticks += any_unsolved ? 1 : 0;
  if (!sink_failed_) sink_failed_ = !guarded([&] { sink_(sample); });
  ticks_.fetch_add(1, std::memory_order_relaxed);
}

bool HapticServer::go_on_fading(const HapticTick& tick, std::chrono::nanoseconds now) noexcept {
  if (!fading_since_) fading_since_ = now;
  bool goes_on = false;
  for (std::size_t h = 0; h < hands_.size(); ++h) {
    const devices::GloveCommand& command = tick.hands[h].command.values();
    const bool is_at_rest = command.f_H_W.isZero(0.0) && command.t_H_W.isZero(0.0);
    goes_on = goes_on || (!is_at_rest && now - *fading_since_ < longest_fade(hands_[h].device->descriptor()));
  }
  if (goes_on) return true;
  if (ticks() > 0) statistics_.page_faults = page_faults_of_this_thread() - page_faults_before_;
  done_.store(options_.ticks > 0 && ticks() == options_.ticks, std::memory_order_release);
  return false;
}

bool HapticServer::simulation_tick() noexcept {
  return guarded([this] { answer_newest_ghosts(); }) && !has_failed();
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

void HapticServer::answer_newest_ghosts() {
  if (!ghosts_.update()) return;
  const std::chrono::nanoseconds start = clock_.now();
  sets_.publish(answerer_->answer(ghosts_.value(), kTickPeriod));
  statistics_.simulation.record(clock_.now() - start);
}

void HapticServer::stop() {
  should_end_.store(true, std::memory_order_relaxed);
  haptic_thread_->join();
  simulation_thread_->stop();
  statistics_.haptic = haptic_thread_->statistics();
  statistics_.scheduling = scheduling();
}

}  // namespace glissade::haptics
