#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include <glissade/realtime/latency_histogram.h>

namespace glissade::realtime {

// Each value below 2^(kLinearBits + 1) has a bucket of its own. Of a larger value, the leading kLinearBits + 1 bits
// choose the bucket: `shift` bits are cut off, and each shift has 2^kLinearBits buckets, after those of the previous
// shift.
std::size_t LatencyHistogram::bucket_of(std::int64_t nanoseconds) noexcept {
  constexpr std::int64_t kLargest = (std::int64_t{1} << kValueBits) - 1;
  const auto value = static_cast<std::uint64_t>(std::clamp(nanoseconds, std::int64_t{0}, kLargest));
  const int shift = std::max(static_cast<int>(std::bit_width(value)) - kLinearBits - 1, 0);
  return (static_cast<std::size_t>(shift) << kLinearBits) + static_cast<std::size_t>(value >> shift);
}

std::int64_t LatencyHistogram::largest_in(std::size_t bucket) noexcept {
  constexpr std::size_t kPerShift = std::size_t{1} << kLinearBits;
  const std::size_t shift = bucket < 2 * kPerShift ? 0 : bucket / kPerShift - 1;
  const std::size_t leading = bucket - shift * kPerShift;
  return static_cast<std::int64_t>(((leading + 1) << shift) - 1);
}

void LatencyHistogram::record(std::chrono::nanoseconds duration) noexcept {
  ++counts_[bucket_of(duration.count())];
  ++count_;
  max_ = std::max(max_, static_cast<std::int64_t>(duration.count()));
}

void LatencyHistogram::add(const LatencyHistogram& other) noexcept {
  for (std::size_t i = 0; i < kBuckets; ++i)
    counts_[i] += other.counts_[i];
  count_ += other.count_;
  max_ = std::max(max_, other.max_);
}

std::uint64_t LatencyHistogram::count_up_to(std::chrono::nanoseconds duration) const noexcept {
  if (duration < std::chrono::nanoseconds::zero()) return 0;
  const auto end = counts_.begin() + static_cast<std::ptrdiff_t>(bucket_of(duration.count())) + 1;
  return std::accumulate(counts_.begin(), end, std::uint64_t{0});
}

std::chrono::nanoseconds LatencyHistogram::quantile(double p) const noexcept {
  const double wanted = std::ceil(std::clamp(p, 0.0, 1.0) * static_cast<double>(count_));
  const auto rank =
      std::clamp(static_cast<std::uint64_t>(wanted), std::uint64_t{1}, std::max(count_, std::uint64_t{1}));
  std::uint64_t seen = 0;
  for (std::size_t i = 0; i < kBuckets; ++i) {
    seen += counts_[i];
    // The last bucket also holds all durations beyond its range, of which only the maximum is known.
    if (seen >= rank) return std::chrono::nanoseconds(i + 1 == kBuckets ? max_ : std::min(largest_in(i), max_));
  }
  return std::chrono::nanoseconds(0);
}

}  // namespace glissade::realtime
