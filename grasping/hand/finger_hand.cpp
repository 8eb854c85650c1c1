#include <glissade/grasping/grasp_simulation.h>

#include "hand/hand_links.h"

namespace glissade::grasping {

haptics::FingerHand finger_hand(const HandModel& hand) {
  haptics::FingerHand result;
  const std::span<const FlexValue> values = hand.chain.values();
  for (std::size_t v = 0; v < values.size(); ++v) {
    result.limits.lower[v] = values[v].lower;
    result.limits.upper[v] = values[v].upper;
  }
  for (const std::size_t l : {kWrist, kPalmLink}) {
    const ChainLink& link = hand.chain.links()[l];
    result.wrist.push_back({link.terms.front().value, link.X_PJ, link.axis_J});
  }
  return result;
}

}  // namespace glissade::grasping
