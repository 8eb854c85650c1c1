#pragma once

/// A second process that lets a device go of the hand when the first one cannot: because it was killed, or hangs. For
/// devices that keep the last command.

#include <chrono>
#include <string>
#include <string_view>

#include <sys/types.h>

namespace glissade::bridges {

/// The second process is a fork. It has nothing of the first one but the descriptor of the device's connection, and
/// sends bytes there that release the device
/// - at once when the first process ends, even by SIGKILL, without a call of `disarm`;
/// - when nobody calls `renew` for 0.1 s.
/// Signals of a terminal do not reach it. It ends with the first process. A second process that is no more, or does not
/// listen, is replaced by another one. One thread calls all functions.
class ReleaseGuard {
 public:
  /// Starts the second process. Throws WireError if the system refuses one.
  ReleaseGuard();
  /// Ends the second process within half a second. Does not release.
  ~ReleaseGuard();
  ReleaseGuard(const ReleaseGuard&) = delete;
  ReleaseGuard& operator=(const ReleaseGuard&) = delete;

  /// From now on the device behind this descriptor is guarded. `release` is at most 100 bytes. It is sent three times,
  /// and must work after a command that was cut. Throws WireError if there is no second process.
  void arm(int descriptor, std::string_view release);
  /// The first process is well. Call it at least every 50 ms while armed. Throws WireError if there is no second
  /// process.
  void renew();
  /// The device is released, or gone: the second process closes its descriptor and sends nothing more.
  void disarm() noexcept;

  /// The number of the second process.
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
