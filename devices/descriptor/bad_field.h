#pragma once

/// Which field of a descriptor is wrong.

#include <optional>
#include <string_view>

namespace glissade::devices {

struct DeviceDescriptor;

struct BadField {
  std::string_view name;  ///< of `DeviceDescriptor`, or of a joint
  std::string_view rule;  ///< which it breaks, such as "must not be negative"
  double value = 0.0;     ///< SI units
};

/// The first field that `validate` refuses. Never throws.
std::optional<BadField> first_bad_field(const DeviceDescriptor& descriptor) noexcept;

}  // namespace glissade::devices
