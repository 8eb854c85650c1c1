#pragma once

/// The files of devices/presets, compiled into the library.

#include <span>
#include <string_view>

namespace glissade::devices {

struct PresetFile {
  std::string_view name;  ///< without the ending
  std::string_view text;
};

/// All files, in alphabetic order.
std::span<const PresetFile> preset_files() noexcept;

}  // namespace glissade::devices
