#pragma once

/// A histogram of durations in fixed memory: record millions of durations in a real-time loop, and read quantiles
/// afterwards.

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>

namespace glissade::realtime {

/// A log-linear histogram of nanoseconds: exact below 128 ns, 64 buckets per power of two above, up to 2^40 ns (18
/// minutes).
///
/// Not thread-safe: read a histogram in the thread that records, or after that thread has been joined.
class LatencyHistogram {
 public:
  /// A reported quantile is never below the exact quantile, and exceeds it by at most this fraction.
  static constexpr double kRelativeError = 1.0 / 64.0;

  /// Adds one duration. A negative duration counts as 0. Quantiles do not distinguish durations of 2^40 ns or more;
  /// `max()` is exact for these too. Wait-free, no allocation.
  void record(std::chrono::nanoseconds duration) noexcept;

  std::uint64_t count() const noexcept { return count_; }

  /// The largest recorded duration, exact; 0 when nothing was recorded.
  std::chrono::nanoseconds max() const noexcept { return std::chrono::nanoseconds(max_); }

  /// The `p`-quantile: the smallest recorded duration d such that at least the fraction `p` of all durations is at most
  /// d. `p` is clamped to 0…1. The result is rounded up by at most the fraction `kRelativeError`, and 0 when nothing
  /// was recorded. quantile(0.5) is the median, quantile(1) is max().
  std::chrono::nanoseconds quantile(double p) const noexcept;

 private:
  static constexpr int kLinearBits = 6;  ///< 2^6 buckets per power of two
  static constexpr int kValueBits = 40;
  static constexpr std::size_t kBuckets = std::size_t{kValueBits - kLinearBits + 1} << kLinearBits;

  static std::size_t bucket_of(std::int64_t nanoseconds) noexcept;
  static std::int64_t largest_in(std::size_t bucket) noexcept;

  std::array<std::uint64_t, kBuckets> counts_{};
  std::uint64_t count_ = 0;
  std::int64_t max_ = 0;
};

}  // namespace glissade::realtime
