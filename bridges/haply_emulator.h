#pragma once

/// Haply's Inverse Service without hardware: a WebSocket on this machine, an Inverse3 with a VerseGrip, and the hand
/// that holds it. For tests of the bridge, and for everybody who has no device.

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

#include <Eigen/Core>

#include <glissade/bridges/haply.h>
#include <glissade/devices/simulated_glove.h>

namespace glissade::bridges {

/// What may be wrong with the service.
struct HaplyFaults {
  double garbage = 0.0;               ///< share of the answers that are another text
  double cut = 0.0;                   ///< share of the answers of which a part is lost
  std::chrono::nanoseconds delay{0};  ///< from a message to its answer
};

/// A hand at the middle of the workspace, without a motion of its own. The world of the hand is the device.
devices::SimulatedGlove resting_haply_hand();

struct HaplyEmulatorOptions {
  unsigned short port = 0;     ///< 0: any that is free
  bool is_before_3_5 = false;  ///< the service; the key of the force was another one
  bool has_handle = true;      ///< a VerseGrip
  HaplyFilters filters;
  HaplyFaults faults;
  std::uint64_t seed = 1;  ///< of the faults
  /// Presses a button while the hand is closed.
  devices::SimulatedGlove hand = resting_haply_hand();
  /// From the first message of a program to the start of the hand's script.
  std::chrono::nanoseconds wait{0};
};

/// The state of the device.
struct EmulatedHaply {
  Eigen::Vector3d f_C_D = Eigen::Vector3d::Zero();  ///< what the device exerts on the hand, N
  Eigen::Vector3d p_DC = Eigen::Vector3d::Zero();
  bool is_pressed = false;
  std::uint64_t messages = 0;        ///< with a force, also of 0
  std::uint64_t other_messages = 0;  ///< that the service does not understand
};

/// Runs in a thread of its own from construction to destruction.
class HaplyEmulator {
 public:
  /// Throws std::runtime_error if the system refuses the port.
  explicit HaplyEmulator(HaplyEmulatorOptions options);
  ~HaplyEmulator();

  /// The address of the service, for `HaplyOptions`. Any thread, as the functions below.
  std::string service() const;
  EmulatedHaply state() const;
  /// The hand begins with its script now.
  void begin_script();
  /// The arm loses its cable, or gets it back.
  void unplug();
  void plug();
  /// The arm forgets where it is, or knows it again.
  void set_calibrated(bool is_calibrated);
  /// The service ends, or starts again at the same port.
  void stop_service();
  void start_service();

 private:
  class Service;

  std::unique_ptr<Service> service_;
};

}  // namespace glissade::bridges
