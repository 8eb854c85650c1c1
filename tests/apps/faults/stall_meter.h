#pragma once

/// How late threads get a processor while a test runs.

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <stop_token>
#include <thread>
#include <vector>

namespace glissade::test_support {

/// On each processor, a thread sleeps for a millisecond again and again.
class StallMeter {
 public:
  StallMeter();

  /// Ends them; returns the longest time by which one of them woke late.
  std::chrono::nanoseconds end();

 private:
  void watch(std::size_t processor, const std::stop_token& stop);

  std::atomic<std::int64_t> longest_ns_{0};
  std::vector<std::jthread> threads_;
};

}  // namespace glissade::test_support
