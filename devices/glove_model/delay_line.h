#pragma once

/// Values on their way, each with the time when it arrives.

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace glissade::devices {

/// Keeps at most `capacity` values; a further value replaces the oldest. Allocates only at construction.
template <typename Value>
class DelayLine {
 public:
  explicit DelayLine(std::size_t capacity) : entries_(std::max<std::size_t>(capacity, 1)) {}

  void push(const Value& value, std::chrono::nanoseconds arrives) noexcept {
    if (count_ == entries_.size()) {
      drop(1);
      ++overtaken_;
    }
    Entry& entry = entries_[(first_ + count_) % entries_.size()];
    entry.value = value;
    entry.arrives = arrives;
    ++count_;
  }

  /// Copies the value that was pushed last among those that have arrived, and returns true. Drops this value and all
  /// values pushed before it, also those that have not arrived: an older value is of no use. Cost O(capacity).
  bool take(std::chrono::nanoseconds now, Value& newest) noexcept {
    for (std::size_t i = count_; i > 0; --i) {
      const Entry& entry = entries_[(first_ + i - 1) % entries_.size()];
      if (entry.arrives > now) continue;
      newest = entry.value;
      drop(i);
      overtaken_ += static_cast<std::int64_t>(i) - 1;
      return true;
    }
    return false;
  }

  /// Number of values that were dropped because a newer one was there.
  std::int64_t overtaken() const noexcept { return overtaken_; }

 private:
  struct Entry {
    Value value{};
    std::chrono::nanoseconds arrives{0};
  };

  void drop(std::size_t count) noexcept {
    first_ = (first_ + count) % entries_.size();
    count_ -= count;
  }

  std::vector<Entry> entries_;
  std::size_t first_ = 0;
  std::size_t count_ = 0;
  std::int64_t overtaken_ = 0;
};

/// The number of values that are on their way for `delay` (seconds), if one is pushed every 1/rate seconds (rate in
/// Hz).
inline std::size_t delay_line_capacity(double delay, double rate) noexcept {
  return static_cast<std::size_t>(delay * rate) + 2;
}

inline std::chrono::nanoseconds nanoseconds_of(double seconds) noexcept {
  return std::chrono::nanoseconds(static_cast<std::int64_t>(seconds * 1e9 + 0.5));
}

}  // namespace glissade::devices
