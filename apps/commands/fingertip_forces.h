#pragma once

/// How hard the tips of a hand's fingers press.

#include <array>
#include <cstddef>
#include <string_view>

#include <glissade/devices/glove_device.h>
#include <glissade/grasping/hand_model.h>
#include <glissade/haptics/contact_set.h>
#include <glissade/haptics/finger_forces.h>

namespace glissade::apps {

/// Thumb, index, middle, ring and little finger.
inline constexpr std::size_t kFingers = 5;
inline constexpr std::array<std::string_view, kFingers> kFingerNames{"thumb", "index", "middle", "ring", "little"};

/// For a wearer of a simulated glove whose fingers are at their targets. The glove's springs (`haptics::FingerForces`)
/// give the torques of the joints. The forces of the contacts are those, none of which pulls, whose torques come
/// nearest to them. The load of a held part is not in them.
class FingertipForces {
 public:
  explicit FingertipForces(const grasping::HandModel& hand);

  /// N, for each finger the sum of the contacts of its last segment. `targets` are the angles (rad) to which the wearer
  /// closes the hand.
  std::array<double, kFingers> update(const devices::JointValues& targets, const haptics::HandAnswer& hand);

 private:
  haptics::FingerForces springs_;
};

}  // namespace glissade::apps
