#pragma once

/// A second process that lets a device go of the hand when the first one cannot: because it was killed, or hangs. For
/// devices that keep the last command for ever.

#include <string_view>

#include <sys/types.h>

namespace glissade::bridges {

/// The second process is a fork. It has nothing of the first one but the descriptor of the device's connection, and
/// sends a text there that releases the device
/// - at once when the first process ends, even by SIGKILL, without a call of `disarm`;
/// - when nobody calls `renew` for 0.1 s.
/// Signals of a terminal do not reach it. It ends with the first process. One thread calls all functions.
class ReleaseGuard {
 public:
  /// Throws std::system_error if the system refuses a process.
  ReleaseGuard();
  /// Ends the second process and waits for that. Does not release.
  ~ReleaseGuard();
  ReleaseGuard(const ReleaseGuard&) = delete;
  ReleaseGuard& operator=(const ReleaseGuard&) = delete;

  /// From now on the device behind this descriptor is guarded. `release` is at most 100 bytes. It is sent three times,
  /// each time after a line break, because the last command may have been cut.
  void arm(int descriptor, std::string_view release) noexcept;
  /// The first process is well. Call it at least every 50 ms while armed. Returns false if the second process is no
  /// more, so that nothing is guarded.
  bool renew() noexcept;
  /// The device is released, or gone: the second process closes its descriptor and sends nothing more.
  void disarm() noexcept;

  /// The number of the second process.
  pid_t id() const noexcept { return id_; }

 private:
  bool send(std::string_view packet, int descriptor) const noexcept;

  int socket_ = -1;
  pid_t id_ = -1;
};

}  // namespace glissade::bridges
