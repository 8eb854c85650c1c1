#pragma once

/// A second process that releases a device when the first process cannot, because it was killed or hangs. For devices
/// that keep the last command.

#include <chrono>
#include <string>
#include <string_view>

#include <sys/types.h>

namespace glissade::bridges {

/// The second process is a fork. Of the first process, it keeps only the descriptor of the device's connection. Over
/// this connection, it sends bytes that release the device
/// - at once when the first process ends, even by SIGKILL, without a call of `disarm`;
/// - when nobody calls `renew` for 0.1 s.
/// Signals of a terminal do not reach the second process. It ends with the first process. A second process that has
/// ended, or does not listen, is replaced by another one. One thread calls all functions.
class ReleaseGuard {
 public:
  /// Starts the second process. Throws WireError if the system refuses one.
  ReleaseGuard();
  /// Ends the second process within half a second. Does not release the device.
  ~ReleaseGuard();
  ReleaseGuard(const ReleaseGuard&) = delete;
  ReleaseGuard& operator=(const ReleaseGuard&) = delete;

  /// From now on the device behind this descriptor is guarded. `release` is at most 100 bytes. It is sent three times,
  /// and must work after a command that was cut. Throws WireError if there is no second process.
  void arm(int descriptor, std::string_view release);
  /// Reports that the first process is well. Call this function at least every 50 ms while armed. Throws WireError if
  /// there is no second process.
  void renew();
  /// Call this function when the device is released or gone. The second process closes its descriptor, and stays
  /// silent.
  void disarm() noexcept;

  /// The process id of the second process.
  pid_t id() const noexcept { return id_; }

 private:
  void start();
  void end() noexcept;
  void replace();
  void kill_now() noexcept;
  bool send_arming() const noexcept;
  bool send(std::string_view packet, int descriptor) const noexcept;

  int socket_ = -1;
  pid_t id_ = -1;
  int guarded_ = -1;  ///< −1 while disarmed
  std::string release_;
  std::chrono::steady_clock::time_point renewed_{};
};

}  // namespace glissade::bridges
