#include "loop/kernel_hands.h"

#include <string>

namespace glissade::haptics {

std::vector<KernelHand> with_fingers(std::vector<KernelHand> hands, const grasping::GraspSimulation& simulation) {
  if (simulation.hand_count() > hands.size())
    throw std::invalid_argument("the simulation has " + std::to_string(simulation.hand_count()) +
                                " hands, more than the loop has devices (" + std::to_string(hands.size()) + ")");
  for (std::size_t h = 0; h < simulation.hand_count(); ++h) {
    hands[h].part.reset();
    hands[h].fingers = finger_hand(*simulation.model(h));
  }
  return hands;
}

}  // namespace glissade::haptics
