#pragma once

/// The wire to an Inverse3 of Haply, through Haply's Inverse Service. The tip of the arm is a hand without fingers.
/// A VerseGrip on the tip gives its orientation, and its buttons close the hand.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <glissade/bridges/haply.h>
#include <glissade/bridges/wire.h>

namespace glissade::bridges {

struct HaplyOptions {
  std::string service = "localhost";  ///< "HOST" or "HOST:PORT"; an address, or localhost
  std::string arm;                    ///< the id of the device; empty: the only one
  std::string handle;                 ///< the id of the VerseGrip; empty: the only one, if there is one
  /// The pose of the device: its origin is at the mounting plate, X points to the right, Y forward and Z up.
  Eigen::Isometry3d X_WD = Eigen::Isometry3d::Identity();
};

/// What passes over the wire, for people.
struct HaplyTraffic {
  std::string arm;                                  ///< its id; empty before the first connection
  std::optional<std::string> handle;                ///< the id of the VerseGrip of the last state
  std::uint64_t states = 0;                         ///< since the wire was opened
  std::uint64_t refused = 0;                        ///< messages that were no states
  std::string last_refusal;                         ///< what was wrong with the last of them
  Eigen::Vector3d f_H_W = Eigen::Vector3d::Zero();  ///< the force that was sent, N
  /// The force (N) that the service reports as exerted. The service's filters make it differ from the sent force.
  std::optional<Eigen::Vector3d> exerted_H_W;
};

/// Sends a force 1000 times a second, each time after the service has answered the message before. The service exerts a
/// force only while messages come, so no force lasts when this process is killed or hangs.
class HaplyWire final : public Wire {
 public:
  /// Throws std::invalid_argument if the service is not "HOST" or "HOST:PORT".
  explicit HaplyWire(HaplyOptions options);
  /// Releases the device.
  ~HaplyWire() override;

  const devices::DeviceDescriptor& descriptor() const noexcept override;
  void open() override;
  bool read(devices::GloveState& state) override;
  void write(const devices::SafeCommand& command) override;
  void release() noexcept override;

  const HaplyTraffic& traffic() const noexcept;

 private:
  struct Link;

  std::unique_ptr<Link> link_;
};

}  // namespace glissade::bridges
