#pragma once

/// Figures of a measurement of latencies, without measuring.

#include <glissade/apps/latency/latency_run.h>

namespace glissade::test_support {

inline apps::LatencyFigures given_latency_figures() {
  using std::chrono::microseconds;
  apps::LatencyFigures figures;
  for (apps::LoadFigures* load : {&figures.idle, &figures.loaded}) {
    load->links = {{.link = "in process"}, {.link = "udpm://"}};
    for (apps::LinkFigures& link : load->links) {
      link.stages.record({microseconds(0), microseconds(100), microseconds(500), microseconds(510), microseconds(900)});
      link.stages.lost = 2;
      link.haptic_lateness.record(microseconds(30));
      link.bare_lateness.record(microseconds(20));
    }
    load->round_trip.record(microseconds(100));
  }
  return figures;
}

}  // namespace glissade::test_support
