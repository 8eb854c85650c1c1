#pragma once

/// A buffer that passes the newest value from one thread to another. Neither thread locks or waits. Use `TripleBuffer`
/// for states and commands, where only the newest value matters. Use `SpscRing` where every value matters.

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace glissade::realtime {

/// A buffer of three slots. One slot belongs to the writer, one slot belongs to the reader, and the middle slot belongs
/// to neither. `publish` exchanges the writer's slot for the middle slot. `update` exchanges the reader's slot for the
/// middle slot.
///
/// Thread-safety: one writer thread and one reader thread. Progress: every function is wait-free, with a bounded number
/// of steps. Allocates nothing, unless T's assignment allocates.
template <typename T>
class TripleBuffer {
 public:
  /// All three slots start as `initial`, which does not count as published.
  explicit TripleBuffer(const T& initial = T{}) : slots_{Slot{initial}, Slot{initial}, Slot{initial}} {}

  TripleBuffer(const TripleBuffer&) = delete;
  TripleBuffer& operator=(const TripleBuffer&) = delete;

  /// Writer: makes `value` the newest value. It replaces a published value that no `update` has taken yet.
  void publish(const T& value) noexcept(std::is_nothrow_copy_assignable_v<T>) {
    write_slot() = value;
    publish();
  }

  /// Writer: the slot to fill in place before `publish()`. The slot holds an arbitrary older value, so overwrite the
  /// whole slot.
  T& write_slot() noexcept { return slots_[writer_].value; }

  /// Writer: makes the contents of `write_slot()` the newest value.
  void publish() noexcept {
    writer_ = between_.exchange(static_cast<std::uint8_t>(writer_ | kFresh), std::memory_order_acq_rel) & kIndex;
  }

  /// Reader: if a value was published since the last call, takes the newest value and returns true. Otherwise returns
  /// false.
  bool update() noexcept {
    if ((between_.load(std::memory_order_relaxed) & kFresh) == 0) return false;
    reader_ = between_.exchange(reader_, std::memory_order_acq_rel) & kIndex;
    return true;
  }

  /// Reader: the value last taken by `update()`, or the initial value. The value does not change until the next
  /// `update()`.
  const T& value() const noexcept { return slots_[reader_].value; }

  /// Reader: calls `update()` and returns `value()`.
  const T& latest() noexcept {
    update();
    return value();
  }

 private:
  /// In bytes. A fixed number, because std::hardware_destructive_interference_size may differ between translation
  /// units.
  static constexpr std::size_t kCacheLineBytes = 64;
  static constexpr std::uint8_t kIndex = 3;
  static constexpr std::uint8_t kFresh = 4;  ///< set in `between_` by `publish`, cleared by the next `update`

  struct alignas(kCacheLineBytes) Slot {
    T value;
  };

  std::array<Slot, 3> slots_;
  alignas(kCacheLineBytes) std::uint8_t writer_ = 0;
  alignas(kCacheLineBytes) std::uint8_t reader_ = 1;
  alignas(kCacheLineBytes) std::atomic<std::uint8_t> between_{2};

  static_assert(std::atomic<std::uint8_t>::is_always_lock_free);
};

}  // namespace glissade::realtime
