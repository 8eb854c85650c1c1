#pragma once

/// Measures how long the force takes from the sample of a glove, over each kind of link, on an idle and on a busy
/// machine; beside it, how late an empty loop wakes up, and how long a bare round trip of two datagrams takes.

#include <chrono>
#include <functional>
#include <memory>
#include <string_view>
#include <vector>

#include <glissade/apps/latency/latency_stages.h>
#include <glissade/apps/run/session_recorder.h>
#include <glissade/realtime/latency_histogram.h>
#include <glissade/viewer/view_scene.h>

namespace glissade::apps {

/// Over one link, under one load.
struct LinkFigures {
  std::string_view link;  ///< "in process", "memq://" or "udpm://"
  LatencyStages stages;
  realtime::LatencyHistogram haptic_lateness;  ///< of the ticks of the haptic loop
  realtime::LatencyHistogram bare_lateness;    ///< of an empty loop that runs beside it
};

/// Under one load.
struct LoadFigures {
  std::vector<LinkFigures> links;
  realtime::LatencyHistogram round_trip;  ///< see `send_pings`
};

struct LatencyFigures {
  LoadFigures idle;
  LoadFigures loaded;
  bool has_fifo_scheduling = false;
  std::shared_ptr<const SessionRecorder> slice{};  ///< the ticks of the first slice in process, idle
};

/// The box, the plate and the hand of the measurement.
viewer::ViewScene latency_view();

/// What of the latency is the library's. Each figure is a quotient of quantiles of the same run.
struct LatencyRatios {
  double lateness_p50 = 0.0;  ///< haptic loop to empty loop, over all links
  double lateness_p99 = 0.0;
  double udpm_p50 = 0.0;  ///< the whole way over udpm:// to a bare round trip and half a tick of waiting
};

/// What the ratios should not exceed.
inline constexpr LatencyRatios kLatencyTargets{.lateness_p50 = 1.2, .lateness_p99 = 2.0, .udpm_p50 = 1.5};

LatencyRatios latency_ratios(const LoadFigures& figures);

/// Measures for `duration`, and some seconds more for the set-up. All links and loads, and the bare round trip, take
/// turns in slices of about a second, so that a slow moment of the machine affects all alike. Calls `watch` with the
/// time measured so far. Call it while the process has only one thread (`HelperProcess`). Throws std::invalid_argument
/// when this machine has no route for multicast, and std::runtime_error when a glove is not heard.
LatencyFigures measure_latency(std::chrono::milliseconds duration,
                               const std::function<void(std::chrono::milliseconds)>& watch);

}  // namespace glissade::apps
