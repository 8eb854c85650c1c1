#pragma once

/// The times of single calls of a benchmark.

#include <chrono>
#include <cstdint>
#include <string>

#include <benchmark/benchmark.h>

#include <glissade/realtime/latency_histogram.h>

#include "seconds_each.h"

namespace glissade::bench {

/// Google Benchmark times whole loops. It has no quantiles of single iterations, leaves out no calls in between, and
/// starts none by a clock. Benchmarks that need one of these time their calls by this class.
class CallTimes {
 public:
  /// Times `call` and counts it.
  template <typename Clock = std::chrono::steady_clock, typename Call>
  void measure(const Call& call) {
    const auto start = Clock::now();
    call();
    record(Clock::now() - start);
  }

  void record(std::chrono::nanoseconds time) {
    histogram_.record(time);
    total_ += time;
  }

  std::int64_t count() const { return static_cast<std::int64_t>(histogram_.count()); }
  std::chrono::nanoseconds total() const { return total_; }

  /// Sets the counters PREFIXp50_ms, PREFIXp99_ms and PREFIXmax_ms, or none if there was no call.
  void report_ms(benchmark::State& state, const std::string& prefix = "") const {
    report(state, prefix, "_ms", std::chrono::milliseconds(1));
  }
  /// The same in nanoseconds.
  void report_ns(benchmark::State& state, const std::string& prefix = "") const {
    report(state, prefix, "_ns", std::chrono::nanoseconds(1));
  }

  /// Makes all calls the time of one iteration of a benchmark with manual time: the counter `tick` is the mean.
  void report_tick(benchmark::State& state) const {
    state.SetIterationTime(std::chrono::duration<double>(total_).count());
    if (count() > 0) state.counters["tick"] = seconds_each(histogram_.count());
  }

 private:
  void report(benchmark::State& state, const std::string& prefix, const char* suffix,
              std::chrono::duration<double, std::nano> unit) const {
    if (count() == 0) return;
    state.counters[prefix + "p50" + suffix] = histogram_.quantile(0.5) / unit;
    state.counters[prefix + "p99" + suffix] = histogram_.quantile(0.99) / unit;
    state.counters[prefix + "max" + suffix] = histogram_.max() / unit;
  }

  realtime::LatencyHistogram histogram_;
  std::chrono::nanoseconds total_{0};
};

}  // namespace glissade::bench
