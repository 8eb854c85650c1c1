#pragma once

/// Records the system calls of one thread, and lets the system carry them out. The timer is not recorded: sleeping
/// until a deadline and reading the clock.

#include <atomic>
#include <cstdint>
#include <string>
#include <thread>
#include <vector>

namespace glissade::test_support {

struct SystemCall {
  int number = 0;
  std::int64_t at = 0;  ///< what the counter of the watch told at the call
};

/// Its name, such as "write", or "number 123".
std::string name_of(const SystemCall& call);

/// A filter in the kernel halts the watched thread in each system call, until a thread of this object has recorded it.
class SystemCallWatch {
 public:
  /// `counter` is recorded with each call, and must outlive the watch.
  explicit SystemCallWatch(const std::atomic<std::int64_t>& counter);
  /// The watched thread must have ended before.
  ~SystemCallWatch();
  SystemCallWatch(const SystemCallWatch&) = delete;
  SystemCallWatch& operator=(const SystemCallWatch&) = delete;

  /// From here to its end, the calling thread is watched. One thread, once. Returns false if the system refuses.
  bool begin_in_this_thread() noexcept;

  /// Waits for the end of the watched thread.
  std::vector<SystemCall> finish();

 private:
  void record_calls();
  bool record_next_call(int listener);

  const std::atomic<std::int64_t>& counter_;
  std::atomic<int> listener_{-1};
  std::atomic<bool> should_end_{false};
  std::vector<SystemCall> calls_;
  std::thread recorder_;
};

}  // namespace glissade::test_support
