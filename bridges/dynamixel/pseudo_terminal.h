#pragma once

/// An emulated device behind a pseudo-terminal of this machine, which looks like a serial port to other programs.

#include <atomic>
#include <memory>
#include <string>
#include <thread>

#include "dynamixel/emulated_device.h"

namespace glissade::bridges::dynamixel {

/// Runs the device in a thread of its own, on the clock of the machine. The device must not be used otherwise
/// meanwhile.
class PseudoTerminal {
 public:
  /// Throws std::runtime_error if the system has no pseudo-terminal.
  explicit PseudoTerminal(std::shared_ptr<EmulatedDevice> device);
  /// Unplugs the device: programs that read from the port get an error.
  ~PseudoTerminal();
  PseudoTerminal(const PseudoTerminal&) = delete;
  PseudoTerminal& operator=(const PseudoTerminal&) = delete;

  /// The path of the port, such as "/dev/pts/3".
  const std::string& path() const noexcept { return path_; }

 private:
  void run();

  std::shared_ptr<EmulatedDevice> device_;
  int master_ = -1;
  int kept_open_ = -1;  // without it, the port reports an error until a program opens it
  std::string path_;
  std::atomic<bool> should_stop_{false};
  std::thread thread_;
};

}  // namespace glissade::bridges::dynamixel
