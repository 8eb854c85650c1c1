#pragma once

/// A null check for the bus given to an end of a link.

#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include <glissade/devices/lcm_bus.h>

namespace glissade::devices {

/// Returns `bus`. Throws std::invalid_argument, with a sentence that names its `user`, when it is null.
inline std::shared_ptr<LcmBus> checked_bus(std::shared_ptr<LcmBus> bus, const std::string& user) {
  if (bus == nullptr) throw std::invalid_argument(user + " needs an LCM bus.");
  return bus;
}

}  // namespace glissade::devices
