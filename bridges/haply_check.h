#pragma once

/// Lists the devices of Haply's Inverse Service, and checks one, in sentences for people.

#include <functional>
#include <string>

#include <glissade/bridges/haply_wire.h>

namespace glissade::bridges {

/// `say` receives a line for each device of the service, with what keeps it from being used. Throws
/// std::invalid_argument if the address is not "HOST" or "HOST:PORT", and WireError if there is no service.
void list_haply_devices(const std::string& service, const std::function<void(const std::string&)>& say);

/// Connects, exchanges messages without a force for some seconds, and ends. `say` receives a sentence for each finding:
/// the version of the service, the devices, the filters that change the force, the rate, the first numbers, and
/// warnings. Ends early when `goes_on` returns false. Returns whether a bridge can work with the device. Throws what
/// `HaplyWire` throws at its construction.
bool check_haply(const HaplyOptions& options, const std::function<bool()>& goes_on,
                 const std::function<void(const std::string&)>& say);

}  // namespace glissade::bridges
