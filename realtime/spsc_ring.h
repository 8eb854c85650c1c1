#pragma once

/// A bounded queue from one thread to another. When the queue is full, new values are dropped and counted. No thread
/// ever waits. Use the queue for logs and recordings, where every value matters. Use `TripleBuffer` where only the
/// newest value matters.

#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

namespace glissade::realtime {

/// Thread-safety: one producer thread and one consumer thread. Any thread may call `dropped`. Progress: `push` and
/// `pop` are wait-free, with a bounded number of steps. Allocates nothing after construction, unless T's assignment
/// allocates.
template <typename T>
class SpscRing {
 public:
  /// A ring with room for `capacity` values, rounded up to a power of two. Throws std::invalid_argument if `capacity`
  /// is 0 or greater than 2^32.
  explicit SpscRing(std::size_t capacity) : slots_(checked_capacity(capacity)), mask_(slots_.size() - 1) {}

  SpscRing(const SpscRing&) = delete;
  SpscRing& operator=(const SpscRing&) = delete;

  std::size_t capacity() const noexcept { return slots_.size(); }

  /// Producer: appends `value` and returns true. If the ring is full, drops `value`, counts the drop and returns false.
  bool push(const T& value) noexcept(std::is_nothrow_copy_assignable_v<T>) {
    const std::uint64_t end = end_.load(std::memory_order_relaxed);
    if (end - begin_seen_by_producer_ == slots_.size()) {
      begin_seen_by_producer_ = begin_.load(std::memory_order_acquire);
      if (end - begin_seen_by_producer_ == slots_.size()) {
        dropped_.store(dropped_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
        return false;
      }
    }
    slots_[end & mask_] = value;
    end_.store(end + 1, std::memory_order_release);
    return true;
  }

  /// Consumer: moves the oldest value into `value` and returns true. If the ring is empty, leaves `value` unchanged and
  /// returns false.
  bool pop(T& value) noexcept(std::is_nothrow_move_assignable_v<T>) {
    const std::uint64_t begin = begin_.load(std::memory_order_relaxed);
    if (begin == end_seen_by_consumer_) {
      end_seen_by_consumer_ = end_.load(std::memory_order_acquire);
      if (begin == end_seen_by_consumer_) return false;
    }
    value = std::move(slots_[begin & mask_]);
    begin_.store(begin + 1, std::memory_order_release);
    return true;
  }

  /// Consumer: calls `take` with each value in the ring, beginning with the oldest. Values pushed during the call stay
  /// for the next call, so the call ends even if the producer never stops.
  template <typename Take>
  void pop_waiting(Take&& take) {
    std::uint64_t waiting = end_.load(std::memory_order_acquire) - begin_.load(std::memory_order_relaxed);
    for (T value{}; waiting > 0 && pop(value); --waiting)
      take(value);
  }

  /// Any thread: the number of values dropped so far.
  std::uint64_t dropped() const noexcept { return dropped_.load(std::memory_order_relaxed); }

 private:
  /// In bytes. A fixed number, because std::hardware_destructive_interference_size may differ between translation
  /// units.
  static constexpr std::size_t kCacheLineBytes = 64;

  static std::size_t checked_capacity(std::size_t capacity) {
    if (capacity == 0 || capacity > (std::size_t{1} << 32U)) {
      throw std::invalid_argument("The capacity of a ring must lie between 1 and 2^32.");
    }
    return std::bit_ceil(capacity);
  }

  std::vector<T> slots_;
  std::size_t mask_;

  // Positions only increase. Each side keeps a copy of the other side's position, and reads the other side's cache line
  // only if the ring is full or empty according to this copy.
  alignas(kCacheLineBytes) std::atomic<std::uint64_t> end_{0};
  std::uint64_t begin_seen_by_producer_ = 0;
  std::atomic<std::uint64_t> dropped_{0};
  alignas(kCacheLineBytes) std::atomic<std::uint64_t> begin_{0};
  std::uint64_t end_seen_by_consumer_ = 0;

  static_assert(std::atomic<std::uint64_t>::is_always_lock_free);
};

}  // namespace glissade::realtime
