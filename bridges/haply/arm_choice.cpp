#include "haply/arm_choice.h"

#include <algorithm>
#include <vector>

#include <glissade/bridges/wire.h>

namespace glissade::bridges {
namespace {

/// The device with this id, or the only one; null if there is none.
template <typename Device>
const Device* chosen(const std::vector<Device>& devices, const std::string& id, const std::string& kind,
                     const std::string& option) {
  const auto has_id = [&](const Device& device) { return device.id == id; };
  if (!id.empty()) {
    const auto found = std::find_if(devices.begin(), devices.end(), has_id);
    return found == devices.end() ? nullptr : &*found;
  }
  if (devices.size() < 2) return devices.empty() ? nullptr : &devices.front();
  std::string ids;
  for (const Device& device : devices)
    ids += (ids.empty() ? "" : ", ") + device.id;
  throw WireError("there is more than one " + kind + ": choose one of " + ids + " by " + option);
}

}  // namespace

const HaplyArm& chosen_arm(const ServiceMessage& message, const std::string& id) {
  if (const HaplyArm* arm = chosen(message.arms, id, "Inverse3", "--arm")) return *arm;
  throw WireError((id.empty() ? "the service has no Inverse3" : "the service has no Inverse3 '" + id + "'") +
                  std::string("; is it plugged in, and on?"));
}

const HaplyHandle* chosen_handle(const ServiceMessage& message, const std::string& id) {
  return chosen(message.handles, id, "VerseGrip", "--handle");
}

std::string trouble_of(const HaplyArm& arm) {
  const std::string name = "device " + arm.id;
  if (arm.config && arm.config->type != "inverse3" && arm.config->type != "inverse3x")
    return name + " is of the type '" + arm.config->type + "', whose limits are not known; use an Inverse3";
  if (!arm.status.has_power) return name + " has no power; plug in its power supply";
  if (!arm.status.is_calibrated)
    return name + " is not calibrated; put the grip on the inkwell until its light is steady";
  if (!arm.status.is_ready) return name + " is not ready; Haply Hub says why";
  return {};
}

}  // namespace glissade::bridges
