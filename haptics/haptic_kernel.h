#pragma once

/// Computes one tick of the haptic thread, i.e. the device commands from the device states and the contact set (the
/// simulation's newest answer). The kernel owns no clock, no thread and no device, so the same code runs in real time,
/// offline and in tests.

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/base/export.h>
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

/// The kernel's data of a part.
struct KernelPart {
  Eigen::Vector3d p_Vref = Eigen::Vector3d::Zero();  ///< the part's own compliance point; see `SlidingPart::p_Vref`
  double radius = 0.0;                               ///< metres, about `p_Vref`; see `SlidingPart::radius`
  contact::CouplingStiffness stiffness{};            ///< in the simulation
  bool is_scripted = false;                          ///< a script moves the part, so no hand can hold it
};

/// The parts of a simulation.
GLISSADE_EXPORT std::vector<KernelPart> kernel_parts(const contact::MultiPartSliding& sliding);

/// A hand in a device.
struct KernelHand {
  devices::DeviceDescriptor device;
  /// Number of the part that the hand takes at the first state of its glove, if the grip is closed in this state. Must
  /// have no value for a hand with fingers.
  std::optional<std::size_t> part{};
  /// If set, the hand has fingers: it gets joint torques, and holds the part that the simulation chooses
  /// (`HandAnswer::part`). A hand without fingers takes and releases parts by its grip.
  std::optional<FingerHand> fingers{};
};

/// A device of a loop, and the part that its hand takes. The first devices lead the simulation's hands with fingers.
template <typename Device>
struct HandInLoop {
  /// `part_in_hand` is the number of the part that a hand without fingers grasps at its first state, by default the
  /// first part. Several hands may hold one part. Without a value, the hand grasps a part later, by a call of `grasp`
  /// or by its grip.
  HandInLoop(Device* device_of_hand, std::optional<std::size_t> part_in_hand = 0)
      : device(device_of_hand), part(part_in_hand) {}

  Device* device;
  std::optional<std::size_t> part;
};

/// Greatest distance (metres) from the hand root to the bounding sphere of a part that a closing hand takes.
inline constexpr double kGripReach_m = 0.2;

/// A hand after one tick.
struct HandTick {
  std::optional<std::size_t> part;  ///< number of the part that the hand holds
  contact::Wrench contacts;         ///< wrench of the contacts on the hand about the ghost's reference point
  contact::Wrench pull;             ///< wrench of other hands' pull on the part, about the same point
  double contact_share = 1.0;       ///< allowed share of the contact force; see `HapticHandState::contact_share`
  bool is_unsolved = false;         ///< the contacts have no solution, so their wrench goes towards zero
  /// Wrench of contacts, pull and damper about the hand root, limited by the safety envelope. A device that takes
  /// half-spaces gets the half-spaces of the contacts instead, without friction and pull. Zero without a state.
  devices::SafeCommand command;
};

/// The outcome of one tick. Entries beyond the number of parts and hands are not used.
struct HapticTick {
  Ghosts ghosts;
  std::array<HandTick, hands::kMaxHands> hands{};
};

/// Real-time safe: bounded work, no allocation, no lock, no system call after construction. Not thread-safe.
class GLISSADE_EXPORT HapticKernel {
 public:
  /// When a hand takes hold of a part, the part's ghost moves rigidly with the hand, starting from the part's visible
  /// pose. The coupling of a hand and a part is the result of `coupling_for` with the device, the part's stiffness and
  /// `period`, the usual time between two ticks. If the simulation is stiffer than the device allows, the contact
  /// forces that the simulation reports differ from the force on the hand. To avoid this, construct the simulation with
  /// the stiffness that `coupling_for` returns. Throws what `coupling_for` throws. Also throws std::invalid_argument in
  /// these cases: no hands or more than hands::kMaxHands; no parts or more than kMaxParts; a held part that is scripted
  /// or does not exist; a hand that has both fingers and a part; limits of a finger that do not form a range; invalid
  /// wrist joints.
  HapticKernel(std::vector<KernelPart> parts, const std::vector<KernelHand>& hands,
               std::chrono::nanoseconds period = kTickPeriod);
  ~HapticKernel();
  HapticKernel(const HapticKernel&) = delete;
  HapticKernel& operator=(const HapticKernel&) = delete;

  /// The hand takes hold of the part in the next tick in which the hand has a finite pose, and lets go of any other
  /// part. Several hands may hold one part: each hand adds its spring, and feels the pull of the others. A hand that
  /// already holds the part takes hold of it anew. Returns false and does nothing if `can_grasp` is false.
  bool grasp(std::size_t hand, std::size_t part) noexcept;
  /// Whether the hand exists and has no fingers, and the part exists and can be held.
  bool can_grasp(std::size_t hand, std::size_t part) const noexcept;
  /// The hand lets go in the next tick, and its force fades. Does nothing if the hand does not exist, has fingers or
  /// holds nothing.
  void release(std::size_t hand) noexcept;

  /// Computes the tick at time `now`. `states` has the newest state of each hand. The entry of a hand without a state
  /// is null. `set` is the newest contact set. `now` is a time on the clock of `ContactSet::time`, and never goes back.
  /// If a pose is not finite or not plausible, the ghost stays unchanged, and the force fades. An opening hand lets go.
  /// A closing hand grasps the part whose bounding sphere about the compliance point is nearest to the hand root. An
  /// opening or closing takes effect after three states in a row with the same `GloveState::grip`. If a contact set has
  /// a number that is not finite, it counts as a set without contacts, with the parts at their last poses. A hand with
  /// fingers follows the decisions of the set instead of its grip, and gets joint torques.
  HapticTick tick(std::span<const devices::GloveState* const> states, const ContactSet& set,
                  std::chrono::nanoseconds now) noexcept;

  /// Emergency stop: the force of all hands fades to zero and stays there.
  void stop() noexcept;

  /// The coupling for a link without delay. The hand and the part must exist.
  const Coupling& coupling(std::size_t hand, std::size_t part) const;
  /// The coupling of the hand in the last tick, with the link delay from the glove (`GloveState::link_delay`) smoothed
  /// over 0.1 s.
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
  void hold(HandInDevice& hand, const Rendering& r) noexcept;

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
