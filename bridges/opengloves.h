#pragma once

/// Constants and types for OpenGloves, the protocol of LucidGloves and similar gloves, for the bridge and the emulator.

#include <glissade/bridges/finger_values.h>
#include <glissade/devices/glove_device.h>
#include <glissade/devices/glove_model.h>

namespace glissade::bridges {

inline constexpr unsigned kOpenGlovesBaudRate = 115200;
inline constexpr unsigned short kOpenGlovesTcpPort = 65432;

/// How a glove writes its lines. A glove understands lines of its own encoding only.
enum class OpenGlovesEncoding {
  kAlpha,   ///< letters with numbers: A1024B0C17D0E4095F2047G2047P0
  kLegacy,  ///< 13 numbers: 1024&0&17&0&4095&2047&2047&0&0&0&0&0&0
};

/// The numbers that the sensor of a finger gives. The firmware of LucidGloves scales the range that it has seen since
/// its start to the whole range of the board's converter: 0 to 4095 on an ESP32, 0 to 1023 on an AVR.
struct SensorRange {
  double open = 0.0;
  double closed = 4095.0;  ///< differs from `open`; may be less
};

/// The preset "opengloves": servos, strings, sensors and link of such a glove.
devices::GloveModel opengloves_model();

/// The descriptor of such a glove, from its model. The glove renders limits of the fingers, and no force on the hand.
devices::DeviceDescriptor opengloves_descriptor();

}  // namespace glissade::bridges
