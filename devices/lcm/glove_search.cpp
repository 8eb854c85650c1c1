#include <utility>

#include <glissade/devices/lcm_glove.h>

#include "lcm/checked_bus.h"
#include "lcm/glove_messages.h"

namespace glissade::devices {

GloveSearch::GloveSearch(std::shared_ptr<LcmBus> bus) : bus_(checked_bus(std::move(bus), "The search for a glove")) {
  subscription_ = bus_->subscribe(kGloveInfoChannel, [this](std::span<const std::uint8_t> message) {
    GloveInfo info;
    if (decode(message, info) != MessageError::kNone) return;
    const std::lock_guard lock(mutex_);
    const std::int64_t device = info.device;
    found_.insert_or_assign(device, std::move(info));
    has_come_.notify_all();
  });
}

std::optional<GloveInfo> GloveSearch::wait_for(std::int64_t device, std::chrono::milliseconds timeout) {
  std::unique_lock lock(mutex_);
  has_come_.wait_for(lock, timeout, [&] { return found_.contains(device); });
  const auto found = found_.find(device);
  return found == found_.end() ? std::nullopt : std::optional(found->second);
}

std::vector<std::int64_t> GloveSearch::heard() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::int64_t> numbers;
  for (const auto& [device, info] : found_)
    numbers.push_back(device);
  return numbers;
}

}  // namespace glissade::devices
