#pragma once

/// What Haply's Inverse Service says: its JSON messages, from version 3.1 on.
/// Frames: D the device, with X to the right, Y forward and Z up, its origin at the mounting plate; C the cursor, i.e.
/// the tip that the hand holds; G the handle, a VerseGrip.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace glissade::bridges {

/// What the service tells of an arm in its first message only.
struct ArmConfig {
  std::string type;  ///< "inverse3", "inverse3x" or "minverse"
  std::string port;
  std::string handedness;
  int hardware = 0;  ///< `device_info.major_version`
  int firmware = 0;  ///< `device_info.minor_version`
  // Filters of the service, from version 3.5 on.
  std::optional<double> force_gate;  ///< the gain of what weakens a force that oscillates
  std::optional<double> damping_N_s_per_m;
};

/// Whether an arm can be used. The defaults hold for what a service does not tell.
struct ArmStatus {
  bool is_ready = true;
  bool is_calibrated = true;
  bool has_power = true;
  bool is_in_use = false;  ///< by any program
};

/// A force-feedback arm.
struct HaplyArm {
  std::string id;
  std::optional<ArmConfig> config;
  ArmStatus status;
  Eigen::Vector3d p_DC = Eigen::Vector3d::Zero();  ///< m
  Eigen::Vector3d v_DC = Eigen::Vector3d::Zero();  ///< m/s
  /// The force that the service exerts, N. From version 3.5 on.
  std::optional<Eigen::Vector3d> f_C_D;
};

/// A VerseGrip, with a cable or without.
struct HaplyHandle {
  std::string id;
  bool is_wireless = false;
  std::optional<Eigen::Quaterniond> R_DG;  ///< none before the first measurement
  bool is_pressed = false;                 ///< any of its buttons
};

/// How the service wants the force: the key was renamed in version 3.5.
enum class ForceKey { kValues, kVector };

struct ServiceMessage {
  ForceKey force_key = ForceKey::kValues;
  std::vector<HaplyArm> arms;
  std::vector<HaplyHandle> handles;
};

/// Ignores keys that it does not know. Throws std::invalid_argument, naming the key, for text that is no message of the
/// service: no JSON, a key that is missing or of another type, a quaternion that is no rotation.
/// Only the first message of a connection has `config`, and only it tells `force_key`.
ServiceMessage decode_service_message(std::string_view text);

/// The other end, for the emulator.
std::string encode_service_message(const ServiceMessage& message);

}  // namespace glissade::bridges
