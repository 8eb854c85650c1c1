#pragma once

/// A second process of the program that does one piece of work after the other.

#include <atomic>
#include <functional>

#include <sys/types.h>

namespace glissade::apps {

/// The process is a fork: it has all memory of the first one at that moment as a copy, and `SharedStamps` in common. It
/// ends with the first one, however that one ends.
class HelperProcess {
 public:
  /// Does the work with this number until `should_end` is true; runs in the second process.
  using Work = std::function<void(char number, const std::atomic<bool>& should_end)>;

  /// Call it while this process has only one thread: a fork has a copy of the calling thread only, and what the others
  /// have locked stays locked. Throws std::system_error when the system refuses a process.
  explicit HelperProcess(const Work& work);
  /// Ends the process and waits for that.
  ~HelperProcess();
  HelperProcess(const HelperProcess&) = delete;
  HelperProcess& operator=(const HelperProcess&) = delete;

  /// Starts the work `number`, which must not be going on yet.
  void begin(char number);

  /// Waits for the end of the work. Throws std::runtime_error with the message of the exception that the work has
  /// thrown, or if the process is no more.
  void end();

 private:
  [[noreturn]] void serve(const Work& work, int socket) noexcept;

  std::atomic<bool>* should_end_;  ///< shared
  int socket_ = -1;
  pid_t id_ = -1;
};

}  // namespace glissade::apps
