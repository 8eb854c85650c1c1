#pragma once

/// A histogram of durations in fixed memory. A real-time loop can record millions of durations, and a program can read
/// quantiles afterwards.

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>

#include <glissade/base/export.h>

namespace glissade::realtime {

/// A log-linear histogram of durations in nanoseconds. Each duration below 128 ns has its own bucket. From 128 ns to
/// 2^40 ns (18 minutes), each power of two has 64 buckets.
///
/// Not thread-safe. Only the recording thread may read a histogram until this thread has been joined.
class GLISSADE_EXPORT LatencyHistogram {
 public:
  /// A reported quantile is never below the exact quantile. If the exact quantile is below 18 minutes, the reported
  /// quantile exceeds it by at most the fraction kRelativeError.
  static constexpr double kRelativeError = 1.0 / 64.0;

  /// Adds one duration. A negative duration counts as 0. All durations of 2^40 ns or more share the last bucket, so
  /// quantiles do not distinguish them. Wait-free, no allocation.
  void record(std::chrono::nanoseconds duration) noexcept;

  /// Adds all durations of `other`.
  void add(const LatencyHistogram& other) noexcept;

  std::uint64_t count() const noexcept { return count_; }

  /// Number of recorded durations of at most `duration`. Durations up to (1 + kRelativeError) × `duration` may also
  /// count. To draw a histogram, use the difference of two results as the height of a bar.
  std::uint64_t count_up_to(std::chrono::nanoseconds duration) const noexcept;

  /// The exact largest recorded duration; 0 if nothing was recorded.
  std::chrono::nanoseconds max() const noexcept { return std::chrono::nanoseconds(max_); }

  /// The `p`-quantile: the smallest recorded duration d such that at least the fraction `p` of all durations is at most
  /// d. `p` is clamped to 0…1. The result is rounded up (see `kRelativeError`), and is 0 if nothing was recorded.
  /// quantile(0.5) is the median, and quantile(1) is max().
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
