#pragma once

/// A simulated glove on an LCM bus. Like a real glove, it publishes states and receives commands, in a separate thread
/// of 1 kHz. A glove of a model publishes each of its own measurements once.

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>

#include <glissade/base/export.h>
#include <glissade/devices/lcm_bus.h>
#include <glissade/devices/lcm_glove.h>
#include <glissade/devices/simulated_glove.h>
#include <glissade/realtime/clock.h>
#include <glissade/realtime/periodic_thread.h>

namespace glissade::devices {

class WearersView;

/// The service runs from construction to `stop` or destruction. The simulated hand waits at the start of its script,
/// i.e. of its given trajectory, until the first command arrives. So the server, which sends the commands, and the
/// glove may start in either order. After that, the script follows the clock, even if the thread misses periods. The
/// wearer sees the parts on the channel HAPTIC_STATE. The wearer slows down when the parts lag behind the hand or the
/// server is slow, stops when the parts stand still, and waits for at most three seconds.
class GLISSADE_EXPORT SimulatedGloveService {
 public:
  /// Receives the new state and the command that led to this state, in each period, in the thread of the service. After
  /// the first result false, the force fades and stays at zero.
  using Observer = std::function<bool(const GloveState&, const SafeCommand&)>;

  /// If `waits_for_server` is false, the script follows the clock from the start on. Throws std::invalid_argument when
  /// the bus is null or cannot receive. The clock must outlive the service.
  SimulatedGloveService(const std::shared_ptr<LcmBus>& bus, SimulatedGlove glove, realtime::Clock& clock,
                        const LcmGloveHostOptions& options = {}, Observer observer = {}, bool waits_for_server = true);
  ~SimulatedGloveService();

  /// Elapsed time of the script. Any thread.
  std::chrono::nanoseconds script_time() const noexcept { return script_time_.load(std::memory_order_relaxed); }

  /// Lets the force fade and ends the thread within a tenth of a second. Afterwards, the results of the functions below
  /// no longer change.
  void stop();

  /// The extra time that the wearer has needed for the script because forces or displayed parts were old. Any thread.
  std::chrono::nanoseconds waited() const noexcept { return waited_.load(std::memory_order_relaxed); }

  /// Greatest norm of all commanded forces, N. Valid after `stop`.
  double greatest_force() const noexcept { return greatest_force_; }
  /// Numbers of messages that the link of the glove's model has lost. Valid after `stop`.
  LinkLosses link_losses() const noexcept;
  /// Statistics of the messages from the server. Any thread.
  LinkStatistics link_statistics() const noexcept { return host_.statistics(); }
  /// Whether another glove sends under the same number. Any thread.
  bool shares_number() const noexcept { return host_.shares_number(); }

 private:
  bool tick(std::chrono::nanoseconds deadline) noexcept;
  std::chrono::nanoseconds age_of_answers(const SafeCommand& command) const noexcept;
  void send(const GloveState& state) noexcept;

  LcmGloveHost host_;
  std::unique_ptr<WearersView> view_;
  SimulatedGlove glove_;
  Observer observer_;  ///< may be empty
  bool waits_for_server_;
  GloveState state_;  ///< as sent
  std::optional<std::chrono::nanoseconds> last_deadline_;
  std::atomic<std::chrono::nanoseconds> script_time_{std::chrono::nanoseconds(0)};
  std::atomic<std::chrono::nanoseconds> waited_{std::chrono::nanoseconds(0)};
  double greatest_force_ = 0.0;
  std::atomic<bool> should_end_{false};
  int ending_ticks_ = 0;
  std::unique_ptr<realtime::PeriodicThread> thread_;
};

}  // namespace glissade::devices
