#include "emulation/port_runner.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glissade/realtime/periodic_thread.h>

namespace glissade::bridges {
namespace {

using std::chrono::nanoseconds;

bool is_understood(const PluggedDevice& plugged) {
  constexpr double kTolerance = 0.03;
  const double rate = plugged.port.baud_rate();
  return plugged.baud_rate == 0 || rate == 0.0 || std::abs(rate - plugged.baud_rate) < kTolerance * plugged.baud_rate;
}

}  // namespace

PortRunner::PortRunner(std::vector<PluggedDevice> plugged) : plugged_(std::move(plugged)), start_(clock_.now()) {
  plug();
  thread_ = std::jthread([this](const std::stop_token& stop) {
    realtime::FifoShare share(realtime::kLinkPriority, realtime::kLinkShare);  // as a device, which is never late
    while (!stop.stop_requested()) {
      turn();
      share.check();
    }
  });
}

std::string PortRunner::port(std::size_t index) const {
  return at_rest([&] { return plugged_[index].port.name(); });
}

void PortRunner::unplug() {
  at_rest([&] {
    for (PluggedDevice& plugged : plugged_)
      plugged.port.unplug();
  });
}

void PortRunner::plug() {
  at_rest([&] {
    for (PluggedDevice& plugged : plugged_)
      plugged.port.plug();
  });
}

void PortRunner::serve(PluggedDevice& plugged, nanoseconds now) {
  const std::string heard = plugged.port.read();
  if (!heard.empty() && is_understood(plugged)) plugged.device->receive(heard, now);
  const std::string said = plugged.device->send_until(now);
  if (!said.empty() && is_understood(plugged)) plugged.port.write(said);
}

/// Lets the devices do what is due, and waits until something may be due again.
void PortRunner::turn() {
  std::vector<pollfd> waiting;
  nanoseconds patience = std::chrono::milliseconds(1);
  {
    const std::scoped_lock lock(mutex_);
    const nanoseconds now = clock_.now() - start_;
    for (PluggedDevice& plugged : plugged_) {
      serve(plugged, now);
      if (const auto next = plugged.device->next_time()) patience = std::min(patience, *next - now);
      plugged.port.add_to(waiting);
    }
  }
  const timespec time{0, std::max<long>(0, patience.count())};
  ppoll(waiting.data(), waiting.size(), &time, nullptr);
}

}  // namespace glissade::bridges
