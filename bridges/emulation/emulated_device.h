#pragma once

/// A device at the other end of a line, emulated: it gets bytes and sends bytes, at given times. `EmulatedLine` puts it
/// behind a ByteStream on a simulated clock, `PortRunner` behind a port of this machine.

#include <chrono>
#include <optional>
#include <string>
#include <string_view>

namespace glissade::bridges {

/// Times are those of the caller's clock, and never go back. Not thread-safe.
class EmulatedDevice {
 public:
  virtual ~EmulatedDevice() = default;

  /// Bytes arrive from the host.
  virtual void receive(std::string_view bytes, std::chrono::nanoseconds now) = 0;

  /// Lets time pass until `now`, and returns the bytes that have reached the host since the last call.
  virtual std::string send_until(std::chrono::nanoseconds now) = 0;

  /// When the next bytes will reach the host, as far as it is known; no value if nothing is on its way.
  virtual std::optional<std::chrono::nanoseconds> next_time() const = 0;
};

}  // namespace glissade::bridges
