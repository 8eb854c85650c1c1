#include "lcm/wearers_view.h"

#include <algorithm>
#include <cstdint>
#include <span>

#include "lcm/haptic_state_message.h"

namespace glissade::devices {

WearersView::WearersView(const std::shared_ptr<LcmBus>& bus) {
  subscription_ = bus->subscribe(kHapticStateChannel, [this](std::span<const std::uint8_t> message) {
    HapticState state;
    if (decode(message, state) == MessageError::kNone)
      answered_.store(clock_.now() - state.contact_set_age, std::memory_order_relaxed);
  });
}

std::optional<std::chrono::nanoseconds> WearersView::age() const noexcept {
  const std::chrono::nanoseconds answered = answered_.load(std::memory_order_relaxed);
  if (answered == std::chrono::nanoseconds(0)) return std::nullopt;
  return clock_.now() - answered;
}

double pace_for(std::chrono::nanoseconds age) noexcept {
  constexpr std::chrono::duration<double> kFluent = std::chrono::milliseconds(20);
  constexpr std::chrono::duration<double> kFrozen = std::chrono::milliseconds(100);
  constexpr std::chrono::seconds kPatience{3};
  if (age > kPatience) return 1.0;
  return std::clamp((kFrozen - age) / (kFrozen - kFluent), 0.0, 1.0);
}

}  // namespace glissade::devices
