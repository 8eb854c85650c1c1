#include <algorithm>
#include <stdexcept>
#include <string_view>

#include <sys/resource.h>

#include <glissade/haptics/haptic_server.h>

#include "loop/answer.h"
#include "loop/kernel_hands.h"
#include "loop/run_tick.h"

namespace glissade::haptics {

namespace {

/// A device whose rates are slow needs long for its fade.
std::chrono::nanoseconds longest_fade(const devices::DeviceDescriptor& device) noexcept {
  const auto time = [](double maximum, double rate) { return rate > 0.0 ? maximum / rate : 0.0; };
  const double slowest_s =
      std::max({time(device.max_force, device.max_force_rate), time(device.max_torque, device.max_torque_rate),
                time(device.max_joint_torque, device.max_joint_torque_rate), 0.5});
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
      std::chrono::duration<double>(2.0 * std::min(slowest_s, 1e6)));
}

std::int64_t page_faults_of_this_thread() noexcept {
  rusage usage{};
  getrusage(RUSAGE_THREAD, &usage);
  return usage.ru_minflt + usage.ru_majflt;
}

}  // namespace

HapticServer::HapticServer(const std::vector<HandInLoop<devices::GloveDevice>>& hands,
                           grasping::GraspSimulation& simulation, HapticServerOptions options)
    : options_(std::move(options)),
      clock_(options_.clock != nullptr ? *options_.clock : steady_clock_),
      kernel_(kernel_parts(simulation.parts()), kernel_hands(hands, simulation), options_.period),
      answerer_(std::make_unique<Answerer>(simulation)) {
  validate_tick_period(options_.period);
  for (const HandInLoop<devices::GloveDevice>& hand : hands)
    devices_.push_back(hand.device);
  record_.hand_count = static_cast<std::int32_t>(hands.size());
  sets_.publish(answerer_->at_start());
  simulation_thread_ = std::make_unique<realtime::PeriodicThread>(
      clock_,
      realtime::PeriodicThreadOptions{.period = kTickPeriod,
                                      .fifo_priority = realtime::kSimulationPriority,
                                      .fifo_share = realtime::kSimulationShare,
                                      .name = "simulation"},
      [this](const realtime::PeriodicTick&) { return simulation_tick(); });
  haptic_thread_ = std::make_unique<realtime::PeriodicThread>(
      clock_,
      realtime::PeriodicThreadOptions{.period = options_.period,
                                      .fifo_priority = realtime::kHapticPriority,
                                      .spin = options_.spin,
                                      .name = "haptic"},
      [this](const realtime::PeriodicTick& timing) { return haptic_tick(timing); });
}

HapticServer::~HapticServer() {
  stop();
}

/// Returns whether any device has a state.
bool HapticServer::read_devices() noexcept {
  bool any = false;
  for (std::size_t h = 0; h < devices_.size(); ++h) {
    record_.has_state[h] = devices_[h]->read(record_.states[h]) || record_.has_state[h];
    any = any || record_.has_state[h];
  }
  return any;
}

/// What does not fit into the tick waits for the next one.
void HapticServer::take_requests() noexcept {
  record_.requests.clear();
  HoldRequest request;
  while (!record_.requests.is_full() && requests_.pop(request))
    record_.requests.add(request);
}

bool HapticServer::haptic_tick(const realtime::PeriodicTick& timing) noexcept {
  if (timing.start - timing.deadline >= options_.period) late_ticks_.fetch_add(1, std::memory_order_relaxed);
  const bool should_end = should_end_.load(std::memory_order_relaxed);
  if (!read_devices()) return !should_end;
  const bool is_ending = should_end || (options_.ticks > 0 && ticks() == options_.ticks);
  ++record_.number;
  record_.sequence = is_ending ? 0 : ticks() + 1;
  record_.last_duration = record_.duration;
  record_.deadline = timing.deadline;
  record_.time = timing.start;
  record_.is_stopped = is_ending || emergency_.load(std::memory_order_relaxed) || has_failed();
  take_requests();
  sets_.update();
  run_tick(kernel_, record_, sets_.value());
  for (std::size_t h = 0; h < devices_.size(); ++h) {
    if (record_.has_state[h]) devices_[h]->command(record_.tick.hands[h].command);
  }
  record_.duration = clock_.now() - timing.start;
  if (options_.observer != nullptr) options_.observer->after_tick(record_);
  if (is_ending) return go_on_fading();
  ghosts_.publish(record_.tick.ghosts);
  report();
  return true;
}

void HapticServer::report() noexcept {
  const HapticTick& tick = record_.tick;
  if (ticks() == 0) page_faults_before_ = page_faults_of_this_thread();
  statistics_.contact_set_age.record(record_.state.contact_set_age);
  const bool any_unsolved =
      std::any_of(tick.hands.begin(), tick.hands.end(), [](const HandTick& hand) { return hand.is_unsolved; });
  statistics_.unsolved_ticks += any_unsolved ? 1 : 0;
  if (options_.sink && !sink_failed_) sink_failed_ = !guarded([&] { options_.sink(record_.state); });
  ticks_.fetch_add(1, std::memory_order_relaxed);
}

bool HapticServer::go_on_fading() noexcept {
  if (!fading_since_) fading_since_ = record_.time;
  bool goes_on = false;
  for (std::size_t h = 0; h < devices_.size(); ++h) {
    const devices::GloveCommand& command = record_.tick.hands[h].command.values();
    const std::chrono::nanoseconds fading = record_.time - *fading_since_;
    goes_on = goes_on || (!command.is_at_rest() && fading < longest_fade(devices_[h]->descriptor()));
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
  answer_.ghosts = ghosts_.value();
  answerer_->answer(answer_.ghosts, options_.period, answer_.set);
  if (options_.observer != nullptr) options_.observer->after_answer(answer_);
  sets_.publish(answer_.set);
  statistics_.simulation.record(clock_.now() - start);
}

void HapticServer::run_for(std::chrono::nanoseconds longest) {
  constexpr std::chrono::milliseconds kLook{10};
  const std::chrono::nanoseconds start = clock_.now();
  while (!is_done() && !has_failed() && clock_.now() - start < longest)
    clock_.sleep_until(clock_.now() + kLook);
  stop();
  if (has_failed()) throw std::runtime_error(failure());
}

void HapticServer::wait() {
  if (options_.ticks == 0)
    throw std::invalid_argument("a haptic server without a number of ticks has no end to wait for");
  run_for(std::chrono::nanoseconds::max());
}

void HapticServer::stop() {
  should_end_.store(true, std::memory_order_relaxed);
  haptic_thread_->join();
  simulation_thread_->stop();
  statistics_.haptic = haptic_thread_->statistics();
  statistics_.scheduling = scheduling();
}

}  // namespace glissade::haptics
