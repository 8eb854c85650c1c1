#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <utility>

#include <glissade/devices/lcm_glove.h>

#include "lcm/checked_bus.h"
#include "lcm/glove_messages.h"

namespace glissade::devices {

std::optional<GloveInfo> find_glove(const std::shared_ptr<LcmBus>& bus, std::int64_t device,
                                    std::chrono::milliseconds timeout) {
  checked_bus(bus, "The search for a glove");
  std::mutex mutex;
  std::condition_variable has_come;
  std::optional<GloveInfo> found;
  const auto subscription = bus->subscribe(kGloveInfoChannel, [&](std::span<const std::uint8_t> message) {
    GloveInfo info;
    if (decode(message, info) != MessageError::kNone || info.device != device) return;
    const std::lock_guard lock(mutex);
    if (!found) found = std::move(info);
    has_come.notify_all();
  });
  std::unique_lock lock(mutex);
  has_come.wait_for(lock, timeout, [&] { return found.has_value(); });
  return found;
}

}  // namespace glissade::devices
