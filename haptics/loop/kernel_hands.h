#pragma once

#include <stdexcept>
#include <utility>
#include <vector>

#include <glissade/grasping/grasp_simulation.h>
#include <glissade/haptics/haptic_kernel.h>

namespace glissade::haptics {

/// The hands of a kernel: the first ones lead the hands of the simulation, and hold what that decides. Throws
/// std::invalid_argument where the simulation has more hands.
std::vector<KernelHand> with_fingers(std::vector<KernelHand> hands, const grasping::GraspSimulation& simulation);

/// The same, of the hands of a loop. Throws std::invalid_argument for a device that is null.
template <typename Hand>
std::vector<KernelHand> kernel_hands(const std::vector<Hand>& hands, const grasping::GraspSimulation& simulation) {
  std::vector<KernelHand> result;
  for (const Hand& hand : hands) {
    if (hand.device == nullptr) throw std::invalid_argument("a haptic loop needs a device, not a null pointer");
    result.push_back({.device = hand.device->descriptor(), .part = hand.part});
  }
  return with_fingers(std::move(result), simulation);
}

}  // namespace glissade::haptics
