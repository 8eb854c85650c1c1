#pragma once

/// The configurations that are compiled into the library.

#include <span>
#include <string_view>

namespace glissade::bridges::dynamixel {

struct PresetHand {
  std::string_view name;
  std::string_view text;  ///< of the file
};

/// By their names.
std::span<const PresetHand> preset_hands();

}  // namespace glissade::bridges::dynamixel
