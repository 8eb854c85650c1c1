#pragma once

/// The output of a measurement of latencies: text, JSON, and a page.

#include <string>

#include <nlohmann/json_fwd.hpp>

#include <glissade/apps/latency/latency_run.h>

namespace glissade::apps {

/// Tables, and a line for each ratio with its target.
std::string to_text(const LatencyFigures& figures);

/// One object; all durations in µs.
nlohmann::ordered_json to_json(const LatencyFigures& figures);

/// An HTML page with the figures and a histogram of each stage in `folder`; returns its path.
std::string write_latency_report(const LatencyFigures& figures, const std::string& folder);

}  // namespace glissade::apps
