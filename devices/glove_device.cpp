#include <cmath>
#include <stdexcept>
#include <utility>

#include <glissade/devices/glove_device.h>

namespace glissade::devices {

void validate(const DeviceDescriptor& descriptor) {
  const auto refuse = [&descriptor](std::string_view field, std::string_view rule) {
    throw std::invalid_argument("Device '" + descriptor.name + "': " + std::string(field) + " " + std::string(rule) +
                                ".");
  };
  const std::pair<std::string_view, double> limits[] = {
      {"max_force", descriptor.max_force},         {"max_torque", descriptor.max_torque},
      {"max_stiffness", descriptor.max_stiffness}, {"max_rotational_stiffness", descriptor.max_rotational_stiffness},
      {"max_damping", descriptor.max_damping},     {"max_joint_torque", descriptor.max_joint_torque}};
  for (const auto& [field, value] : limits) {
    if (!std::isfinite(value) || value < 0.0) refuse(field, "must be finite and not negative");
  }
  if (!std::isfinite(descriptor.update_rate) || descriptor.update_rate <= 0.0)
    refuse("update_rate", "must be positive");
  for (std::size_t i = 0; i < kGloveJoints; ++i) {
    const double lower = descriptor.joint_lower[i];
    const double upper = descriptor.joint_upper[i];
    if (!std::isfinite(lower) || !std::isfinite(upper) || lower >= upper) {
      refuse(kGloveJointNames[i], "needs a finite lower limit below a finite upper limit");
    }
  }
}

}  // namespace glissade::devices
