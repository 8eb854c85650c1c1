#include <algorithm>

#include <glissade/apps/latency/latency_stages.h>

namespace glissade::apps {

void LatencyStages::record(const WayStamps& way) noexcept {
  // A sample that comes while a tick starts may be read before the receiving thread has looked at the clock.
  const std::chrono::nanoseconds received = std::min(way.received, way.read);
  transport.record(received - way.measured);
  wait.record(way.read - received);
  computation.record(way.handed_over - way.read);
  way_back.record(way.arrived - way.handed_over);
  whole.record(way.arrived - way.measured);
}

}  // namespace glissade::apps
