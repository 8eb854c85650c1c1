#pragma once

/// An emulator of Haply's Inverse Service: a WebSocket on this machine, an Inverse3 with a VerseGrip, and the hand that
/// holds it. For tests of the bridge, and for people without a device.

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

#include <Eigen/Core>

#include <glissade/bridges/haply.h>
#include <glissade/devices/simulated_glove.h>

namespace glissade::bridges {

/// Faults of the service.
struct HaplyFaults {
  double garbage = 0.0;               ///< share of the answers that another text replaces
  double cut = 0.0;                   ///< share of the answers of which a part is lost
  std::chrono::nanoseconds delay{0};  ///< from a message to its answer
};

/// A hand at the middle of the workspace, without a motion of its own. The world frame of the hand is the frame of the
/// device.
devices::SimulatedGlove resting_haply_hand();

struct HaplyEmulatorOptions {
  unsigned short port = 0;     ///< 0: any that is free
  bool is_before_3_5 = false;  ///< an older service, which has another key for the force
  bool has_handle = true;      ///< a VerseGrip
  HaplyFilters filters;
  HaplyFaults faults;
  std::uint64_t seed = 1;  ///< of the faults
  /// The hand that holds the tip. It presses a button while it is closed.
  devices::SimulatedGlove hand = resting_haply_hand();
  /// Time from the first message of a program to the start of the hand's script.
  std::chrono::nanoseconds wait{0};
};

/// The state of the device.
struct EmulatedHaply {
  Eigen::Vector3d f_C_D = Eigen::Vector3d::Zero();  ///< what the device exerts on the hand, N
  Eigen::Vector3d p_DC = Eigen::Vector3d::Zero();
  bool is_pressed = false;
  std::uint64_t messages = 0;        ///< messages with a force, also with a zero force
  std::uint64_t other_messages = 0;  ///< messages that the service does not understand
};

/// Runs in a thread of its own from construction to destruction.
class HaplyEmulator {
 public:
  /// Throws std::runtime_error if the system refuses the port.
  explicit HaplyEmulator(HaplyEmulatorOptions options);
  ~HaplyEmulator();

  /// The address of the service, for `HaplyOptions`. Any thread may call this and the following functions.
  std::string service() const;
  EmulatedHaply state() const;
  /// Starts the script of the hand.
  void begin_script();
  /// Disconnects the arm, or connects it again.
  void unplug();
  void plug();
  /// Sets whether the arm knows its position.
  void set_calibrated(bool is_calibrated);
  /// Ends the service, or starts it again at the same port.
  void stop_service();
  void start_service();

 private:
  class Service;

  std::unique_ptr<Service> service_;
};

}  // namespace glissade::bridges
