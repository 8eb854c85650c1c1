#pragma once

/// Runs emulated devices behind ports of this machine.

#include <chrono>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include <glissade/realtime/clock.h>

#include "emulation/emulated_device.h"
#include "emulation/emulated_port.h"

namespace glissade::bridges {

/// An emulated device and its port.
struct PluggedDevice {
  EmulatedPort port;
  std::shared_ptr<EmulatedDevice> device;
  unsigned baud_rate = 0;  ///< a host with another one is not understood; 0: any
};

/// Runs the devices in one thread, on the clock of the machine, from construction to destruction. The devices' time
/// begins at 0.
class PortRunner {
 public:
  /// Plugs all ports. Throws std::system_error if the system refuses one.
  explicit PortRunner(std::vector<PluggedDevice> plugged);

  // Any thread:
  std::string port(std::size_t index) const;
  /// The ports vanish, as if the plug were pulled, and come back. The devices go on.
  void unplug();
  void plug();
  /// Calls `look` while the devices rest.
  template <typename Look>
  auto at_rest(const Look& look) const {
    const std::scoped_lock lock(mutex_);
    return look();
  }

 private:
  void turn();
  void serve(PluggedDevice& plugged, std::chrono::nanoseconds now);

  mutable std::mutex mutex_;  // of ports and devices; the thread holds it only for a moment
  std::vector<PluggedDevice> plugged_;
  realtime::SteadyClock clock_;
  std::chrono::nanoseconds start_;
  std::jthread thread_;  // the last, so that it ends first
};

}  // namespace glissade::bridges
