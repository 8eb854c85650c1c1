#pragma once

/// Bytes as documents show them.

#include <sstream>
#include <string>

namespace glissade::bridges::dynamixel {

/// The bytes of hexadecimal numbers such as "FF 0A".
inline std::string bytes_of(const std::string& hexadecimal) {
  std::istringstream numbers(hexadecimal);
  std::string bytes;
  unsigned number = 0;
  while (numbers >> std::hex >> number)
    bytes.push_back(static_cast<char>(number));
  return bytes;
}

}  // namespace glissade::bridges::dynamixel
