#pragma once

/// Objects that one thread at a time may use, for any number of Python threads.

#include <mutex>
#include <utility>

#include "unlocked.h"

namespace glissade::python {

/// Every use waits for the one before, and runs without the interpreter lock. (With it, a thread that waits here would
/// stop a thread that works here and looks for signals.)
template <typename Object>
class Guarded {
 public:
  template <typename... Arguments>
  explicit Guarded(Arguments&&... arguments) : object_(std::forward<Arguments>(arguments)...) {}

  /// The result of work(object), which must touch no Python object.
  template <typename Work>
  auto with(const Work& work) {
    const Unlocked unlocked;
    const std::lock_guard lock(mutex_);
    return work(object_);
  }

 private:
  std::recursive_mutex mutex_;  // recursive: a signal handler may use the object that its thread works on
  Object object_;
};

}  // namespace glissade::python
