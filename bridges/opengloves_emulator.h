#pragma once

/// An emulated glove: the firmware of LucidGloves, five servos with strings and the fingers of a wearer, behind a
/// pseudo-terminal or a TCP port. For tests of the bridge, and for people without a glove.

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include <glissade/bridges/emulator.h>
#include <glissade/bridges/opengloves.h>
#include <glissade/devices/glove_model.h>

namespace glissade::bridges {

struct OpenGlovesEmulatorOptions {
  OpenGlovesEncoding encoding = OpenGlovesEncoding::kAlpha;
  double rate_Hz = 90.0;  ///< of the states, at most
  int full_scale = 4095;  ///< the number of a closed finger
  /// Time for which the firmware waits for a line after a state. On USB, the firmware of LucidGloves waits a second.
  std::chrono::nanoseconds line_patience{std::chrono::seconds(1)};
  std::string link;             ///< path of a link to the pseudo-terminal, which stays the same; empty: none
  bool is_tcp = false;          ///< a TCP port of this machine in place of a pseudo-terminal
  unsigned short tcp_port = 0;  ///< 0: any that is free
  LineFaults faults;
  std::uint64_t seed = 1;                          ///< of the faults
  EmulatedWearer wearer = busy_wearer;             ///< in the thread of the emulator
  devices::GloveModel model = opengloves_model();  ///< of strings, servos and fingers
};

/// The state of the glove.
struct EmulatedGlove {
  std::array<int, kFingers> limits{};  ///< the last ones that the firmware has read, 0 to 1000; 0: free
  FingerValues curls{};
  std::uint64_t limit_lines = 0;     ///< lines with limits that were read
  std::uint64_t stopping_lines = 0;  ///< those of them that do not leave all fingers free
  std::uint64_t other_lines = 0;     ///< other lines; what the firmware does with them is undefined
  std::uint64_t lost_bytes = 0;      ///< bytes that found no room in the board's buffer
  std::ptrdiff_t waiting_lines = 0;  ///< lines that the firmware has not read yet
};

/// Runs in a thread of its own from construction to destruction.
class OpenGlovesEmulator {
 public:
  /// Throws std::invalid_argument for options out of range, and std::system_error if the system refuses a port.
  explicit OpenGlovesEmulator(const OpenGlovesEmulatorOptions& options);
  ~OpenGlovesEmulator();

  /// The port for `SerialStream`, or the link if there is one. Any thread may call this and the following functions.
  std::string port() const;
  EmulatedGlove state() const;
  /// Removes the port, as if the plug were pulled, and restores it. If the port has a link or is a TCP port, its name
  /// stays the same. The servos keep their limits.
  void unplug();
  void plug();

 private:
  struct Parts;

  std::unique_ptr<Parts> parts_;
};

}  // namespace glissade::bridges
