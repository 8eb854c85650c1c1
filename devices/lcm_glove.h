#pragma once

/// The two ends of a glove's LCM link: `LcmGlove` for the server, i.e. the program with the haptic loop, and
/// `LcmGloveHost` for the program that drives the glove.
///
/// Each end has a session, i.e. a random number drawn at its start. Each end obeys one sender at a time, the holder of
/// the lease. Another sender gets the lease only after the holder has been silent for the time `lease`. Until then,
/// messages of the other sender are counted in `LinkStatistics::other_sender`.

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <glissade/base/export.h>
#include <glissade/devices/calibration.h>
#include <glissade/devices/glove_device.h>
#include <glissade/devices/hand_pose.h>
#include <glissade/devices/lcm_bus.h>
#include <glissade/devices/safety_envelope.h>
#include <glissade/realtime/clock.h>
#include <glissade/realtime/periodic_thread.h>
#include <glissade/realtime/spsc_ring.h>
#include <glissade/realtime/triple_buffer.h>

namespace glissade::devices {

class LinkMonitor;

/// The default number of a device.
inline constexpr std::int64_t kDefaultDevice = 1;

/// Receives the announcements of gloves, from construction on. Each `LcmGloveHost` sends its announcement on the
/// channel GLOVE_INFO five times a second. Any thread.
class GLISSADE_EXPORT GloveSearch {
 public:
  /// Throws std::invalid_argument when the bus is null or cannot receive.
  explicit GloveSearch(std::shared_ptr<LcmBus> bus);

  /// The newest announcement of the glove with this number. Waits for the first announcement. Returns no value if no
  /// announcement arrives within `timeout`.
  std::optional<GloveInfo> wait_for(std::int64_t device, std::chrono::milliseconds timeout);
  /// The numbers of all gloves found so far, in ascending order.
  std::vector<std::int64_t> heard() const;
  /// Sentences that explain why a glove is not found. They name rejected announcements and states, and gloves that send
  /// states but do not announce themselves.
  std::vector<std::string> troubles() const;

 private:
  std::shared_ptr<LcmBus> bus_;
  mutable std::mutex mutex_;
  std::condition_variable has_come_;
  std::map<std::int64_t, GloveInfo> found_;
  std::set<std::int64_t> senders_;  // of states
  std::set<std::string> refusals_;  // sentences
  std::unique_ptr<LcmBus::Subscription> infos_;
  std::unique_ptr<LcmBus::Subscription> states_;
};

struct LcmGloveOptions {
  std::int64_t device = kDefaultDevice;  ///< number of the glove; states of all other gloves are rejected
  /// `GloveInfo::session` of the glove that has the lease at the start; 0: the first sender gets the lease.
  std::int64_t glove_session = 0;
  /// Period at which the send thread polls for a new command. Polling costs the haptic thread nothing. Waking the send
  /// thread would cost the haptic thread a system call for every command.
  std::chrono::nanoseconds send_period{std::chrono::microseconds(250)};
  std::chrono::nanoseconds lease{std::chrono::milliseconds(500)};
};

/// The haptic loop's end of the link. It receives states on the channel GLOVE_STATE in the receive thread of the bus,
/// and sends every command on GLOVE_COMMAND in a separate thread. If any command was sent, the destructor sends a last
/// command with zero forces and torques.
class GLISSADE_EXPORT LcmGlove final : public GloveDevice {
 public:
  /// Throws std::invalid_argument in these cases: the bus is null or cannot receive; the descriptor is not valid; or
  /// the send period is not positive.
  LcmGlove(std::shared_ptr<LcmBus> bus, DeviceDescriptor descriptor, const LcmGloveOptions& options = {});
  ~LcmGlove() override;

  const DeviceDescriptor& descriptor() const noexcept override { return descriptor_; }
  bool read(GloveState& newest) noexcept override;
  void command(const SafeCommand& command) noexcept override;

  /// Statistics of the messages from the glove. Any thread.
  LinkStatistics statistics() const noexcept;
  /// Commands sent so far. Any thread.
  std::uint64_t commands_sent() const noexcept { return commands_sent_.load(std::memory_order_relaxed); }
  /// Commands dropped so far because the send thread was stopped for longer than `kWaitingCommands` ticks. Any thread.
  std::uint64_t commands_dropped() const noexcept { return commands_.dropped(); }

  /// Commands that may wait for the send thread.
  static constexpr std::size_t kWaitingCommands = 64;

 private:
  void send(const GloveCommand& command) noexcept;

  std::shared_ptr<LcmBus> bus_;
  DeviceDescriptor descriptor_;
  std::int64_t device_;
  std::int64_t session_;
  realtime::SteadyClock clock_;
  realtime::TripleBuffer<GloveState> states_;
  bool has_state_ = false;  ///< used by the haptic thread only
  realtime::SpscRing<SafeCommand> commands_{kWaitingCommands};
  GloveCommand last_sent_;  ///< used by the send thread, and then by the destructor
  std::atomic<std::uint64_t> commands_sent_{0};
  std::unique_ptr<LinkMonitor> monitor_;
  std::unique_ptr<LcmBus::Subscription> subscription_;
  std::unique_ptr<realtime::PeriodicThread> sender_;
};

struct LcmGloveHostOptions {
  std::int64_t device = kDefaultDevice;  ///< number of this glove; commands to other gloves are rejected
  hands::HandSide side = hands::HandSide::kUnknown;
  /// The largest allowed age, in periods, of the state that a command answers. This age includes the way to the server
  /// and back. If the state is older, the force fades. A period is that of the device, but at least 1 ms.
  double patience_periods = 6.0;
  std::chrono::nanoseconds lease{std::chrono::milliseconds(500)};
  std::optional<Calibration> calibration{};    ///< without a value, the device's angles are those of the hand
  std::optional<HandPoseOptions> hand_pose{};  ///< the hand's tracker; without a value, the device measures the pose
};

/// The glove driver's end of the link. It announces the glove on GLOVE_INFO, sends states on GLOVE_STATE, and receives
/// commands on GLOVE_COMMAND. At this end, a second envelope limits each command. The driver passes states as the
/// device measures them. Before the envelope and the server get a state, the host adds the pose of a tracker and
/// applies the calibration. It also converts commands to angles of the device. Thread-safety: one thread, the driver's,
/// calls `publish` and `newest_command`.
class GLISSADE_EXPORT LcmGloveHost {
 public:
  /// `descriptor` is that of the bare device. Throws std::invalid_argument in these cases: the bus is null or cannot
  /// receive; the descriptor is not valid; the calibration is not for this device (`check_calibration`); or a device
  /// that exerts force or torque on the hand is to get its pose from a tracker.
  LcmGloveHost(std::shared_ptr<LcmBus> bus, const DeviceDescriptor& descriptor,
               const LcmGloveHostOptions& options = {});
  ~LcmGloveHost();

  /// Sends `state` together with the envelope's results of the last `newest_command`, if the present server sent this
  /// command. Also sends the announcement when it is due. Returns false when the operating system does not accept the
  /// state. Before the first pose of a tracker, sends nothing and returns false. May block.
  bool publish(const GloveState& state);

  /// The command for the device in this period. Call this function once a period. `newest` is the newest measured
  /// state. The force is zero before the first command and before the first pose of a tracker, and fades if the newest
  /// command is old. Wait-free.
  SafeCommand newest_command(const GloveState& newest) noexcept;

  /// Emergency stop: the force fades to zero and stays there. Wait-free, any thread.
  void stop() noexcept { should_stop_.store(true, std::memory_order_relaxed); }

  /// Statistics of the messages from the server. Any thread.
  LinkStatistics statistics() const noexcept;
  /// Whether another glove has announced itself under the number of this glove since construction. A server listens to
  /// one of the two only. Wait-free, any thread.
  bool shares_number() const noexcept { return shares_number_.load(std::memory_order_relaxed); }
  /// The tracker of the hand; null if the device measures the pose.
  const HandPoseSource* hand_pose() const noexcept { return hand_pose_.get(); }

 private:
  struct Heard {
    GloveCommand command;
    std::int64_t session = 0;  // of the server
  };

  bool prepare(GloveState& measured) noexcept;

  std::shared_ptr<LcmBus> bus_;
  LcmGloveHostOptions options_;
  std::unique_ptr<HandPoseSource> hand_pose_;
  std::optional<GloveState> joined_;  // the newest state with a pose
  std::int64_t session_;
  SafetyEnvelope envelope_;
  SafeCommand last_;
  std::int64_t last_session_ = 0;  // of the server that sent the command of `last_`
  std::atomic<bool> should_stop_{false};
  realtime::SteadyClock clock_;
  realtime::TripleBuffer<Heard> commands_;
  std::optional<std::chrono::nanoseconds> announced_;
  std::unique_ptr<LinkMonitor> monitor_;
  std::atomic<bool> shares_number_{false};
  std::unique_ptr<LcmBus::Subscription> subscription_;
  std::unique_ptr<LcmBus::Subscription> announcements_;
};

}  // namespace glissade::devices
