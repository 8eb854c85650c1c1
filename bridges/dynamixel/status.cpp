#include "dynamixel/status.h"

#include <array>
#include <string_view>

namespace glissade::bridges::dynamixel {
namespace {

struct HardwareErrorText {
  std::uint8_t bit;
  std::string_view text;
};

constexpr std::array<HardwareErrorText, 5> kHardwareErrorTexts{
    {{kInputVoltageError, "the supply voltage is out of range; check the supply and its cable"},
     {kOverheatingError, "it is too hot; let it cool down, or lower the largest current"},
     {kEncoderError, "its position sensor is broken"},
     {kElectricalError, "its motor gets too little power or an electric shock; check the supply and the cables"},
     {kOverloadError, "it was overloaded for too long; lower the largest current"}}};

}  // namespace

std::string to_text(StatusError error) {
  switch (error) {
    case StatusError::kNone:
      return {};
    case StatusError::kResultFail:
      return "the servo could not process the instruction";
    case StatusError::kInstruction:
      return "the servo does not know the instruction";
    case StatusError::kChecksum:
      return "the checksum was wrong when the instruction arrived";
    case StatusError::kDataRange:
      return "the value is out of range, or the bus watchdog has made the goals read-only";
    case StatusError::kDataLength:
      return "the value has fewer bytes than the register";
    case StatusError::kDataLimit:
      return "the value exceeds the servo's limit";
    case StatusError::kAccess:
      return "the register cannot be accessed; registers of the EEPROM are locked while the torque is on";
  }
  return "the servo reports the unknown error " + std::to_string(static_cast<int>(error));
}

std::string hardware_error_text(std::uint8_t bits) {
  std::string result;
  unsigned rest = bits;
  for (const HardwareErrorText& known : kHardwareErrorTexts) {
    if ((bits & known.bit) == 0) continue;
    if (!result.empty()) result += "; also ";
    result += known.text;
    rest &= ~static_cast<unsigned>(known.bit);
  }
  if (rest == 0) return result;
  if (!result.empty()) result += "; also ";
  return result + "it reports the unknown hardware error " + std::to_string(rest);
}

}  // namespace glissade::bridges::dynamixel
