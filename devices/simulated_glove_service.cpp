#include <algorithm>
#include <utility>

#include <glissade/devices/simulated_glove_service.h>

namespace glissade::devices {

SimulatedGloveService::SimulatedGloveService(std::shared_ptr<LcmBus> bus, SimulatedGlove glove, realtime::Clock& clock)
    : host_(std::move(bus)), glove_(std::move(glove)) {
  thread_ = std::make_unique<realtime::PeriodicThread>(clock, realtime::PeriodicThreadOptions{},
                                                       [this](const realtime::PeriodicTick&) {
                                                         tick();
                                                         return true;
                                                       });
}

void SimulatedGloveService::tick() {
  const GloveCommand command = host_.newest_command();
  const bool has_server = host_.statistics().accepted > 0;
  greatest_force_ = std::max(greatest_force_, command.f_H_W.norm());
  host_.publish(glove_.step(has_server ? std::chrono::milliseconds(1) : std::chrono::nanoseconds(0), command));
  if (has_server) steps_.fetch_add(1, std::memory_order_relaxed);
}

}  // namespace glissade::devices
