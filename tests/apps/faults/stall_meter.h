#pragma once

/// How late threads get a processor while a test runs.

#include <atomic>
#include <chrono>
#include <cstdint>
#include <thread>
#include <vector>

namespace glissade::test_support {

/// On each processor, a thread sleeps for a millisecond again and again.
class StallMeter {
 public:
  StallMeter();

  /// The longest time by which one of them woke late.
  std::chrono::nanoseconds longest() const { return std::chrono::nanoseconds(longest_ns_.load()); }

 private:
  void watch(std::size_t processor, const std::stop_token& stop);

  std::atomic<std::int64_t> longest_ns_{0};
  std::vector<std::jthread> threads_;
};

}  // namespace glissade::test_support
