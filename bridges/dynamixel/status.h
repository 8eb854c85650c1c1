#pragma once

/// The error byte of a servo's answer, and the servo's hardware errors, as sentences.

#include <cstdint>
#include <string>

namespace glissade::bridges::dynamixel {

/// The bit of the error byte that announces a hardware error.
inline constexpr std::uint8_t kAlert = 0x80;

/// The other bits: a number. 0 means no error.
enum class StatusError : std::uint8_t {
  kNone = 0,
  kResultFail = 1,
  kInstruction = 2,
  kChecksum = 3,
  kDataRange = 4,
  kDataLength = 5,
  kDataLimit = 6,
  kAccess = 7,
};

constexpr StatusError error_number(std::uint8_t error) noexcept {
  return StatusError{static_cast<std::uint8_t>(error & ~kAlert)};
}
constexpr bool has_alert(std::uint8_t error) noexcept {
  return (error & kAlert) != 0;
}

/// Why the servo refused an instruction, such as "the value is out of range". Empty for kNone.
std::string to_text(StatusError error);

/// Bits of the register Hardware Error Status.
inline constexpr std::uint8_t kInputVoltageError = 0x01;
inline constexpr std::uint8_t kOverheatingError = 0x04;
inline constexpr std::uint8_t kEncoderError = 0x08;
inline constexpr std::uint8_t kElectricalError = 0x10;
inline constexpr std::uint8_t kOverloadError = 0x20;

/// What has happened to the servo, and what helps. Empty for 0.
std::string hardware_error_text(std::uint8_t bits);

}  // namespace glissade::bridges::dynamixel
