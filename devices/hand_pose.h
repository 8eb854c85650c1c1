#pragma once

/// The pose of a hand from a separate tracker, over LCM on the channel HAND_POSE. For gloves that measure the fingers
/// only. Frames: W world, T tracker.

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>

#include <Eigen/Geometry>

#include <glissade/base/export.h>
#include <glissade/devices/glove_device.h>
#include <glissade/devices/lcm_bus.h>
#include <glissade/realtime/clock.h>
#include <glissade/realtime/triple_buffer.h>

namespace glissade::devices {

class ClockDifference;
class LinkMonitor;

/// One measurement of a tracker.
struct TrackedPose {
  std::int64_t sequence = 0;         ///< ≥ 0, increases with every pose
  std::chrono::nanoseconds time{0};  ///< of the measurement, on a monotonic clock of the sender
  bool is_valid = true;              ///< false while the tracker does not see the hand
  Eigen::Isometry3d X_WT = Eigen::Isometry3d::Identity();
  bool has_velocity = false;                       ///< whether the tracker measures v_WT and w_WT
  Eigen::Vector3d v_WT = Eigen::Vector3d::Zero();  ///< velocity of the origin of T, in world axes; m/s
  Eigen::Vector3d w_WT = Eigen::Vector3d::Zero();  ///< angular velocity of T, in world axes; rad/s
};

/// The tracker's end of the link.
class GLISSADE_EXPORT HandPosePublisher {
 public:
  /// For the glove with the number `device`. Throws std::invalid_argument when the bus is null.
  HandPosePublisher(std::shared_ptr<LcmBus> bus, std::int64_t device);

  /// Returns false when the operating system does not accept the message. May block.
  bool publish(const TrackedPose& pose);

 private:
  std::shared_ptr<LcmBus> bus_;
  std::int64_t device_;
  std::int64_t session_;
};

struct HandPoseOptions {
  std::int64_t device = 1;  ///< number in the messages; poses with other numbers are ignored
  double rate_Hz = 60.0;    ///< poses that the tracker sends per second, at least
  /// Poses of another tracker with the same number are accepted after the first tracker has been silent for this time.
  std::chrono::nanoseconds lease{std::chrono::milliseconds(500)};
};

/// The glove's end of the link. Computes velocities from two poses if the tracker does not measure them. The sender may
/// use the clock of another machine. The message with the shortest delay so far gives the difference of the clocks.
class GLISSADE_EXPORT HandPoseSource {
 public:
  /// Throws std::invalid_argument when the bus is null or cannot receive, or the rate is outside 1 to 100,000 Hz.
  HandPoseSource(std::shared_ptr<LcmBus> bus, const HandPoseOptions& options);
  ~HandPoseSource();

  /// Writes the newest pose and its velocities into `state`. The time of `state`, on the clock of this process, becomes
  /// that of the older measurement. So the force fades if poses are missing, as it does if states are missing. Before
  /// the first pose, returns false and leaves `state` unchanged. Wait-free, one thread.
  bool join(GloveState& state) noexcept;

  /// Time of the newest pose, on the clock of this process; no value before the first pose. Any thread.
  std::optional<std::chrono::nanoseconds> newest() const noexcept;
  /// Statistics of the messages. Any thread.
  LinkStatistics statistics() const noexcept;

 private:
  void take(TrackedPose pose, std::chrono::nanoseconds now) noexcept;

  std::shared_ptr<LcmBus> bus_;
  HandPoseOptions options_;
  realtime::SteadyClock clock_;
  std::unique_ptr<LinkMonitor> monitor_;
  std::unique_ptr<ClockDifference> difference_;
  std::optional<TrackedPose> last_;        ///< of the receive thread, with the time of this process
  std::chrono::nanoseconds last_sent_{0};  ///< its time on the sender's clock
  std::atomic<std::chrono::nanoseconds> newest_;
  realtime::TripleBuffer<TrackedPose> poses_;
  bool has_pose_ = false;  ///< of the thread of `join`
  std::unique_ptr<LcmBus::Subscription> subscription_;
};

}  // namespace glissade::devices
