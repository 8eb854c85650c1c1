#pragma once

/// Long work for Python: without the interpreter lock, in several threads, and with an end on Ctrl-C.

#include <chrono>
#include <cstdint>
#include <functional>

namespace glissade::python {

/// Calls worker(i) for each i from 0 to `count` − 1, with one worker for each thread. There are `threads` threads, 1 to
/// 1024, or as many as the system has. The calling thread must hold the interpreter lock, which it gives back
/// meanwhile. Rethrows the exception of the lowest i that throws. Throws std::invalid_argument for another number of
/// threads, and pybind11::error_already_set after a signal such as Ctrl-C.
void for_each(std::int64_t count, int threads, const std::function<std::function<void(std::int64_t)>()>& make_worker);

/// Looks for signals, such as Ctrl-C, some times a second, however often it is called. Does nothing in threads other
/// than the main thread, which alone handles signals.
class SignalCheck {
 public:
  SignalCheck();

  /// Called without the interpreter lock. Throws pybind11::error_already_set after a signal.
  void operator()() {
    if (--calls_left_ == 0) look();
  }

 private:
  void look();

  bool is_main_thread_;
  std::int64_t calls_ = 1;  // between two looks at the clock: reading it takes as long as a short query
  std::int64_t calls_left_ = 1;
  std::chrono::steady_clock::time_point looked_;
  std::chrono::steady_clock::time_point next_;
};

}  // namespace glissade::python
