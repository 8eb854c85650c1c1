#pragma once

/// The state after one haptic tick, for viewers and recorders, and its publisher. A tick is one cycle of the 1 kHz loop
/// that computes the forces. A part is an object that hands move. Frames: W world; V visible part, i.e. the displayed
/// pose of the part; G ghost, i.e. the pose that the part would have if nothing were in the way.

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string_view>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <glissade/base/export.h>
#include <glissade/devices/glove_device.h>
#include <glissade/devices/lcm_bus.h>
#include <glissade/devices/safety_envelope.h>
#include <glissade/geometry/displacement.h>
#include <glissade/hands/hand.h>
#include <glissade/realtime/clock.h>
#include <glissade/realtime/periodic_thread.h>
#include <glissade/realtime/spsc_ring.h>

namespace glissade::devices {

/// State of the part in the simulation. Messages carry the number of the state. These numbers never change their
/// meaning. The target is the pose to which the hand pulls the part. A contact pushes while it exerts a force.
enum class PartState : std::int32_t {
  kUnknown = 0,     ///< the state was not reported, or its number is unknown to this program
  kReleased = 1,    ///< no hand holds the part, and the part stands still
  kFree = 2,        ///< the part is at its target
  kSliding = 3,     ///< contacts push, and the part moves along the contacts
  kResting = 4,     ///< contacts push, and the part stands still
  kCatchingUp = 5,  ///< no contact pushes, but the part is not at its target yet
};

/// Number of part states; their values run from 0 to kPartStates − 1.
inline constexpr std::int32_t kPartStates = 6;

/// The name of a state, such as "sliding"; "unknown" for any other value.
GLISSADE_EXPORT std::string_view name_of(PartState state);

/// The state with this number; kUnknown for any other number.
GLISSADE_EXPORT PartState part_state_from_number(std::int32_t number) noexcept;

/// Maximum number of parts and of hands in a `HapticState`.
inline constexpr std::size_t kHapticParts = 4;
inline constexpr std::size_t kHapticHands = 4;

/// Maximum number of contacts in a `HapticState`. Without friction, at most six contacts of a single part push at once.
inline constexpr std::size_t kHapticContacts = 24;

/// Maximum number of patches in a `HapticState`. A part in a corner has three patches.
inline constexpr std::size_t kHapticPatches = 8;

/// A part after one haptic tick.
struct HapticPartState {
  Eigen::Isometry3d X_WG = Eigen::Isometry3d::Identity();  ///< equal to X_WV for a part that no hand holds
  Eigen::Isometry3d X_WV = Eigen::Isometry3d::Identity();
  Eigen::Vector3d p_Vref = Eigen::Vector3d::Zero();  ///< the reference point, where the spring of each hand acts
  PartState state = PartState::kUnknown;
  std::int32_t contact_count = 0;  ///< number of contacts that push

  bool is_in_contact() const noexcept { return contact_count > 0; }
  /// The displacement from the visible part to its ghost: translation (metres) of `p_Vref`, and rotation vector.
  geometry::Displacement lag() const { return geometry::displacement_between(X_WV, X_WG, p_Vref); }
};

/// A hand after one haptic tick.
struct HapticHandState {
  std::int32_t part = -1;  ///< number of the part that the hand holds; −1: none
  /// The wrench on the hand, as its device received it, in world axes (N, Nm). The torque is about the origin of V, or
  /// about the hand root while the hand holds nothing.
  Eigen::Vector3d force_W = Eigen::Vector3d::Zero();
  Eigen::Vector3d torque_V_W = Eigen::Vector3d::Zero();
  /// The allowed share of the contact force. The exerted force follows this share within 75 ms. The share is less than
  /// 1 in three cases: the contacts are old; the part lags so far behind the hand that its contacts are not known to
  /// hold at the hand; or the force is still returning after one of these two cases.
  double contact_share = 1.0;
  bool are_contacts_unsolved = false;       ///< the contacts had no solution, so their force goes to zero
  LimitReasons reasons;                     ///< reasons why the device received less than the contacts demand
  std::chrono::nanoseconds state_age{0};    ///< time since the measurement of the glove's state
  LimitReasons glove_reasons;               ///< `GloveState::limits`
  std::chrono::nanoseconds command_age{0};  ///< `GloveState::command_age`
  double energy = 0.0;                      ///< `SafeCommand::energy`, J
  double glove_energy = 0.0;                ///< `GloveState::energy`
  hands::VisibleHand visible;               ///< valid only for a hand with fingers
  hands::JointValues joint_torques{};       ///< torques that the device received, Nm
};

/// The energy (J) that force and torque may still give to the hand. If the glove's states report this energy, returns
/// the value of the envelope at the glove, because its limit applies. Otherwise returns the value of the envelope at
/// the server.
inline double energy_left(const HapticHandState& hand) noexcept {
  return hand.command_age > std::chrono::nanoseconds(0) ? hand.glove_energy : hand.energy;
}

/// A contact that pushes, on a part that hands lead.
struct HapticContact {
  std::int32_t part = 0;
  Eigen::Vector3f p_V = Eigen::Vector3f::Zero();  ///< the contact point in the part's frame, metres
  Eigen::Vector3f n_W = Eigen::Vector3f::Zero();  ///< unit normal, from the obstacle to the part
};

/// The contacts of a part with one object that lie in one plane. At least one of these contacts pushes.
struct HapticPatch {
  std::int32_t part = 0;
  std::int32_t contact_count = 0;                 ///< number of contacts that push
  Eigen::Vector3f p_V = Eigen::Vector3f::Zero();  ///< centre of the contact forces in the part's frame, metres
  Eigen::Vector3f n_W = Eigen::Vector3f::Zero();  ///< unit normal, from the obstacle to the part
  float extent = 0.0F;                            ///< distance from `p_V` to the farthest of these contacts, metres
};

/// The state after one haptic tick. The tick used a contact set, i.e. the simulation's newest answer to the ghost
/// poses, with the poses X_WV and the contacts of the parts.
struct HapticState {
  std::int64_t sequence = 0;                    ///< ≥ 0, increases with every tick
  std::chrono::nanoseconds time{0};             ///< time of the tick, on the haptic loop's clock
  std::chrono::nanoseconds contact_set_age{0};  ///< age of the set's ghost poses; 0 before the first set
  bool is_contact_set_late = false;             ///< the contact set was older than 5 ms
  std::chrono::nanoseconds lateness{0};         ///< `time` minus the scheduled time of the tick
  std::chrono::nanoseconds last_duration{0};    ///< duration of the previous tick until its commands were handed over
  std::int32_t part_count = 1;
  std::int32_t hand_count = 1;
  std::int32_t contact_count = 0;     ///< number of contacts that push, at most kHapticContacts
  std::int32_t patch_count = 0;       ///< number of patches, at most kHapticPatches
  std::int32_t patches_left_out = 0;  ///< number of patches beyond kHapticPatches
  std::array<HapticPartState, kHapticParts> parts{};
  std::array<HapticHandState, kHapticHands> hands{};
  std::array<HapticContact, kHapticContacts> contacts{};
  std::array<HapticPatch, kHapticPatches> patches{};
};

/// Publishes the state of every tick on the LCM channel HAPTIC_STATE without delaying the loop. Viewers and recorders
/// listen to this channel. The haptic thread fills a ring buffer. A second thread, which the publisher starts, sends
/// the contents and calls the listener with every state.
class GLISSADE_EXPORT HapticStatePublisher {
 public:
  static constexpr std::size_t kDefaultCapacity = 1024;  ///< the states of about one second

  using Listener = std::function<void(const HapticState&)>;

  /// `listener` may be empty. The publisher's thread calls it with each state, even if the state cannot be sent. Throws
  /// std::invalid_argument when the bus is null or `capacity` is 0.
  explicit HapticStatePublisher(std::shared_ptr<LcmBus> bus, Listener listener = {},
                                std::size_t capacity = kDefaultCapacity);
  /// Publishes the states still in the ring.
  ~HapticStatePublisher();

  /// Haptic thread: queues `state` and returns true. If the ring is full, drops and counts the state, and returns
  /// false. Wait-free.
  bool push(const HapticState& state) noexcept { return ring_.push(state); }

  /// States dropped so far. Any thread.
  std::uint64_t dropped() const noexcept { return ring_.dropped(); }

 private:
  void publish_all() noexcept;

  std::shared_ptr<LcmBus> bus_;
  Listener listener_;
  realtime::SteadyClock clock_;
  realtime::SpscRing<HapticState> ring_;
  std::unique_ptr<realtime::PeriodicThread> thread_;
};

}  // namespace glissade::devices
