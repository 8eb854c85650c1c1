#pragma once

#include <stdexcept>
#include <vector>

#include <glissade/haptics/haptic_kernel.h>

namespace glissade::haptics {

/// The hands of a kernel, from those of a loop. Throws std::invalid_argument for a device that is null.
template <typename Hand>
std::vector<KernelHand> kernel_hands(const std::vector<Hand>& hands) {
  std::vector<KernelHand> result;
  for (const Hand& hand : hands) {
    if (hand.device == nullptr) throw std::invalid_argument("a haptic loop needs a device, not a null pointer");
    result.push_back({hand.device->descriptor(), hand.part, hand.fingers});
  }
  return result;
}

}  // namespace glissade::haptics
