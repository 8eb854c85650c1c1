#pragma once

/// A glove without hardware: the firmware of LucidGloves, five servos and the fingers of a wearer, behind a
/// pseudo-terminal or a TCP port. For tests of the bridge, and for everybody who has no glove.

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include <glissade/bridges/opengloves.h>

namespace glissade::bridges {

/// A finger in the glove.
class FingerModel {
 public:
  virtual ~FingerModel() = default;
  /// The curl after `dt_s` seconds, for a wearer who moves the finger to `wanted`, where the servo's string permits at
  /// most `most`. All curls lie between 0 and 1.
  virtual double advance(double wanted, double most, double dt_s) = 0;
};

/// Follows the wearer with a time constant of 60 ms. The string does not stretch.
std::unique_ptr<FingerModel> first_order_finger();

/// What may be wrong with a wire.
struct EmulatorFaults {
  double garbage = 0.0;               ///< share of the states before which random bytes come
  double half_lines = 0.0;            ///< share of the states of which a part is lost
  bool echo = false;                  ///< everything comes back to the host
  std::chrono::nanoseconds delay{0};  ///< from the arrival of a limit to the servo
};

struct EmulatorOptions {
  OpenGlovesEncoding encoding = OpenGlovesEncoding::kAlpha;
  double rate_Hz = 90.0;  ///< of the states, at most
  int full_scale = 4095;  ///< the number of a closed finger
  /// After a state, the firmware waits so long for a line. On USB, that of LucidGloves waits a second.
  std::chrono::nanoseconds line_patience{std::chrono::seconds(1)};
  std::string link;             ///< path of a link to the pseudo-terminal, which stays the same; empty: none
  bool is_tcp = false;          ///< a TCP port of this machine in place of a pseudo-terminal
  unsigned short tcp_port = 0;  ///< 0: any that is free
  EmulatorFaults faults;
  std::uint64_t seed = 1;  ///< of the faults
  /// The curls to which the wearer moves the fingers, at a time after the start. In the thread of the emulator.
  std::function<FingerValues(std::chrono::nanoseconds)> wearer;
  std::function<std::unique_ptr<FingerModel>()> finger = first_order_finger;
};

/// Closes and opens all fingers, each a little later than the one before.
FingerValues busy_wearer(std::chrono::nanoseconds time);

/// The state of the glove.
struct EmulatedGlove {
  std::array<int, kFingers> limits{};  ///< the last ones that arrived, 0 to 1000; 0: free
  FingerValues curls{};
  std::uint64_t limit_lines = 0;     ///< lines with limits that arrived
  std::uint64_t stopping_lines = 0;  ///< those of them that do not leave all fingers free
  std::uint64_t other_lines = 0;     ///< other lines; the firmware ignores them, or does anything
};

/// Runs in a thread of its own from construction to destruction.
class OpenGlovesEmulator {
 public:
  /// Throws std::invalid_argument for options out of range, std::system_error if the system refuses a port.
  explicit OpenGlovesEmulator(EmulatorOptions options);
  ~OpenGlovesEmulator();

  /// For `SerialStream`: the link if there is one. Any thread, as the functions below.
  std::string port() const;
  EmulatedGlove state() const;
  /// The port vanishes, as if the plug were pulled; and comes back, under the same name if it has a link or is a TCP
  /// port. The servos keep their limits.
  void unplug();
  void plug();

 private:
  class Board;

  std::unique_ptr<Board> board_;
};

}  // namespace glissade::bridges
