#pragma once

/// The bus that an end of a link was given.

#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include <glissade/devices/lcm_bus.h>

namespace glissade::devices {

/// The bus itself. Throws std::invalid_argument, in a sentence about its `user`, when there is none.
inline std::shared_ptr<LcmBus> checked_bus(std::shared_ptr<LcmBus> bus, const std::string& user) {
  if (bus == nullptr) throw std::invalid_argument(user + " needs an LCM bus.");
  return bus;
}

}  // namespace glissade::devices
