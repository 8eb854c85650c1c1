#pragma once

/// Moments by sequence number, in memory that a process and its children share.

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace glissade::apps {

/// Holds the moment of each sequence number from 0 to a capacity. Any number of threads of the process that makes it,
/// and of the processes that are forked from it later, may use it at once.
class SharedStamps {
 public:
  /// Throws std::system_error when the system has no memory to share.
  explicit SharedStamps(std::size_t capacity);
  ~SharedStamps();
  SharedStamps(const SharedStamps&) = delete;
  SharedStamps& operator=(const SharedStamps&) = delete;

  /// Forgets everything. Nobody may call `note` meanwhile.
  void clear() noexcept;

  /// The first call for a sequence number counts; numbers beyond the capacity do not. Wait-free.
  void note(std::int64_t sequence, std::chrono::nanoseconds time) noexcept;

  std::optional<std::chrono::nanoseconds> at(std::int64_t sequence) const noexcept;

 private:
  using Stamp = std::atomic<std::int64_t>;  // nanoseconds; 0: none yet
  static_assert(Stamp::is_always_lock_free);

  bool holds(std::int64_t sequence) const noexcept {
    return sequence >= 0 && static_cast<std::uint64_t>(sequence) < capacity_;
  }

  std::size_t capacity_;
  Stamp* stamps_;
};

}  // namespace glissade::apps
