#pragma once

/// A simulation for Python, which a view may show while it moves.

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <utility>

#include <glissade/devices/haptic_state.h>
#include <glissade/simulation/simulation.h>

#include "guarded.h"

namespace glissade::python {

/// The newest state of a simulation for a view. Any threads.
class ShownState {
 public:
  bool is_watched() const noexcept { return is_watched_; }
  void watch() noexcept { is_watched_ = true; }
  void put(const devices::HapticState& state) {
    const std::lock_guard lock(mutex_);
    newest_ = state;
  }
  /// The newest state, once.
  std::optional<devices::HapticState> take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(newest_, {});
  }

 private:
  std::atomic<bool> is_watched_{false};
  std::mutex mutex_;
  std::optional<devices::HapticState> newest_;
};

/// Shows itself after each step, if a view watches it.
class ShownSimulation : public simulation::Simulation {
 public:
  explicit ShownSimulation(const simulation::Scene& scene) : Simulation(scene), scene_(scene) {}

  void advance(std::span<const Eigen::Isometry3d> X_WG, double milliseconds) {
    Simulation::advance(X_WG, milliseconds);
    show_after(milliseconds);
  }
  void advance(std::span<const std::optional<grasping::Posture>> hands, double milliseconds) {
    Simulation::advance(hands, milliseconds);
    show_after(milliseconds);
  }

  /// From now on, shows its states.
  std::shared_ptr<ShownState> watch();
  const simulation::Scene& scene() const { return scene_; }

 private:
  void show_after(double milliseconds);
  /// A hand for each part that the caller leads, with the wrench of the contacts on it.
  void show_led_parts(devices::HapticState& state);

  simulation::Scene scene_;
  std::shared_ptr<ShownState> shown_ = std::make_shared<ShownState>();
  double time_ms_ = 0.0;
  std::int64_t steps_ = 0;
};

using GuardedSimulation = Guarded<ShownSimulation>;

}  // namespace glissade::python
