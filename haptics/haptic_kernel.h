#pragma once

/// One tick of the haptic thread: device states and contact set (the simulation's newest answer) in, device commands
/// out. The kernel owns no clock, no thread and no device, so the same code runs in real time, offline and in tests.

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/contact/spring.h>
#include <glissade/devices/glove_device.h>
#include <glissade/devices/safety_envelope.h>
#include <glissade/haptics/contact_set.h>
#include <glissade/haptics/coupling.h>
#include <glissade/haptics/finger_forces.h>

namespace glissade::contact {
class MultiPartSliding;
}

namespace glissade::haptics {

class ContactProjection;
struct HandInDevice;
class HandLedger;
class Holds;

/// What the kernel knows of a part.
struct KernelPart {
  Eigen::Vector3d p_Vref = Eigen::Vector3d::Zero();  ///< the part's own compliance point: `SlidingPart::p_Vref`
  double radius = 0.0;                               ///< metres, about it: `SlidingPart::radius`
  contact::CouplingStiffness stiffness{};            ///< of the simulation
  bool is_scripted = false;                          ///< no hand can hold it
};

/// The parts of a simulation.
std::vector<KernelPart> kernel_parts(const contact::MultiPartSliding& sliding);

/// A hand in a device.
struct KernelHand {
  devices::DeviceDescriptor device;
  /// Number of the part that the hand takes at the first state of its glove, if the grip is closed in that state. None
  /// for a hand with fingers.
  std::optional<std::size_t> part{};
  /// A hand with fingers holds what the simulation decides (`HandAnswer::part`), and its joints feel what stops them.
  /// Without them, the hand holds by its grip.
  std::optional<FingerHand> fingers{};
};

/// A device of a loop, and what its hand takes. The first devices lead the hands of the simulation, which take hold
/// with their fingers.
template <typename Device>
struct HandInLoop {
  /// `part` is that of a hand without fingers: number of the part that it grasps at the first state, by default the
  /// first part, which several hands may hold; none: it is told later, or the hand closes on one.
  HandInLoop(Device* device_of_hand, std::optional<std::size_t> part_in_hand = 0)
      : device(device_of_hand), part(part_in_hand) {}

  Device* device;
  std::optional<std::size_t> part;
};

/// A hand that closes takes no part whose bounding sphere is farther from the hand root than this, metres.
inline constexpr double kGripReach_m = 0.2;

/// A hand after one tick.
struct HandTick {
  std::optional<std::size_t> part;  ///< number of the part that it holds
  contact::Wrench contacts;         ///< wrench of the contacts on the hand about the ghost's reference point
  contact::Wrench pull;             ///< the same of other hands on the part
  double contact_share = 1.0;       ///< of the force of the contacts: less than 1 where they are old or were left
  bool is_unsolved = false;         ///< the contacts have no solution, so their wrench goes towards zero
  /// Wrench of contacts, pull and damper about the hand root, through the safety envelope. Zero without a state.
  devices::SafeCommand command;
};

/// The outcome of one tick. Entries beyond the number of parts and hands are not used.
struct HapticTick {
  Ghosts ghosts;
  std::array<HandTick, hands::kMaxHands> hands{};
};

/// Real-time safe: bounded work, no allocation, no lock, no system call after construction. Not thread-safe.
class HapticKernel {
 public:
  /// A hand that holds a part moves the part's ghost rigidly with it, from the visible pose that the part has then. The
  /// coupling of a hand and a part is the result of `coupling_for` with the device, the part's stiffness and `period`,
  /// the usual time between two ticks. If the simulation is stiffer than the device allows, the contact forces that the
  /// simulation reports differ from the force on the hand. To avoid this, construct the simulation with the stiffness
  /// that `coupling_for` returns. Throws as `coupling_for` does, and std::invalid_argument for no hands, no parts, more
  /// than hands::kMaxHands or kMaxParts, for a part to hold that is scripted or does not exist, for a hand with fingers
  /// that is given a part, for limits of fingers that are no range, and for joints of a wrist that are none.
  HapticKernel(std::vector<KernelPart> parts, const std::vector<KernelHand>& hands,
               std::chrono::nanoseconds period = kTickPeriod);
  ~HapticKernel();
  HapticKernel(const HapticKernel&) = delete;
  HapticKernel& operator=(const HapticKernel&) = delete;

  /// The hand takes hold of the part in the next tick in which it has a finite pose; from then on it holds no other.
  /// Several hands may hold one part: each adds its spring, and feels the pull of the others. A hand that holds the
  /// part already takes hold of it anew. Returns false, and does nothing, if there is no such hand, or no such part
  /// that can be held.
  bool grasp(std::size_t hand, std::size_t part) noexcept;
  /// Whether there is such a hand without fingers, and such a part that can be held.
  bool can_grasp(std::size_t hand, std::size_t part) const noexcept;
  /// In the next tick the hand lets go; its force fades. Nothing happens if it holds nothing, if it has fingers or if
  /// there is no such hand.
  void release(std::size_t hand) noexcept;

  /// Computes the tick at time `now`. `states` has the newest state of each hand; the entry of a hand without a state
  /// is null. `set` is the newest contact set. `now` is on the clock of `ContactSet::time`, and never goes back. A pose
  /// that is not finite or not plausible leaves the ghost unchanged, and the force fades. A hand that opens lets go. A
  /// hand that closes grasps the part whose bounding sphere, about the compliance point, is nearest to the hand root.
  /// The kernel follows an opening or closing after three states in a row with the same `GloveState::grip`. A contact
  /// set with a number that is not finite counts as one without contacts, whose parts are where they last were. A hand
  /// with fingers follows the decisions of the set instead of its grip, and gets torques at its joints.
  HapticTick tick(std::span<const devices::GloveState* const> states, const ContactSet& set,
                  std::chrono::nanoseconds now) noexcept;

  /// Emergency stop: the force of all hands fades to zero and stays there.
  void stop() noexcept;

  /// The coupling without delay of the link. Both numbers must be below those of hands and parts.
  const Coupling& coupling(std::size_t hand, std::size_t part) const;
  /// The coupling of the hand in the last tick: with the delay that the glove tells (`GloveState::link_delay`),
  /// smoothed over 0.1 s.
  const Coupling& present_coupling(std::size_t hand) const;

 private:
  struct Rendering;

  const ContactSet& usable(const ContactSet& set) noexcept;
  void follow_grip(std::size_t hand, const devices::GloveState& state, const ContactSet& set) noexcept;
  void follow_decision(std::size_t hand, const HandAnswer& answer) noexcept;
  std::optional<std::size_t> nearest_part(const Eigen::Vector3d& p_WH, const ContactSet& set) const noexcept;
  double seconds_since_last_tick(std::chrono::nanoseconds now) noexcept;
  HandTick render(std::size_t hand, const devices::GloveState& state, const ContactSet& set,
                  std::chrono::nanoseconds age, std::chrono::nanoseconds now, double dt) noexcept;
  void refer(HandInDevice& hand, Rendering& r) noexcept;
  void exert(HandInDevice& hand, Rendering& r) noexcept;
  double book(HandInDevice& hand, const Rendering& r) noexcept;
  void fill(HandInDevice& hand, const Rendering& r, devices::GloveCommand& command) noexcept;

  std::vector<KernelPart> parts_;
  std::chrono::nanoseconds period_;
  std::vector<std::unique_ptr<HandInDevice>> hands_;
  ContactSet last_poses_;  // of the parts; without rows
  std::unique_ptr<Holds> holds_;
  std::unique_ptr<ContactProjection> contacts_;
  std::unique_ptr<HandLedger> ledger_;
  std::optional<std::chrono::nanoseconds> last_tick_;
};

}  // namespace glissade::haptics
