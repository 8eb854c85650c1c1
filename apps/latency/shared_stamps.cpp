#include <cerrno>
#include <memory>
#include <system_error>

#include <sys/mman.h>

#include <glissade/apps/latency/shared_stamps.h>

namespace glissade::apps {

SharedStamps::SharedStamps(std::size_t capacity) : capacity_(capacity) {
  void* memory = mmap(nullptr, capacity * sizeof(Stamp), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED)
    throw std::system_error(errno, std::generic_category(), "No memory to share with a process");
  stamps_ = static_cast<Stamp*>(memory);
  std::uninitialized_value_construct_n(stamps_, capacity);
}

SharedStamps::~SharedStamps() {
  munmap(stamps_, capacity_ * sizeof(Stamp));
}

void SharedStamps::clear() noexcept {
  for (std::size_t i = 0; i < capacity_; ++i)
    stamps_[i].store(0, std::memory_order_relaxed);
}

void SharedStamps::note(std::int64_t sequence, std::chrono::nanoseconds time) noexcept {
  if (!holds(sequence)) return;
  std::int64_t none = 0;
  stamps_[sequence].compare_exchange_strong(none, time.count(), std::memory_order_relaxed);
}

std::optional<std::chrono::nanoseconds> SharedStamps::at(std::int64_t sequence) const noexcept {
  if (!holds(sequence)) return std::nullopt;
  const std::int64_t time = stamps_[sequence].load(std::memory_order_relaxed);
  if (time == 0) return std::nullopt;
  return std::chrono::nanoseconds(time);
}

}  // namespace glissade::apps
