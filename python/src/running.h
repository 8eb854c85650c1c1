#pragma once

/// Objects with threads of their own. The threads end before the interpreter does, and are given up in a forked child.

#include <memory>
#include <utility>

#include <pybind11/pybind11.h>

namespace glissade::python {

class Running {
 public:
  Running() = default;
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;
  virtual ~Running() = default;

  /// Ends the threads, for good. The caller holds the interpreter lock. Later calls do nothing.
  virtual void end() noexcept = 0;
  /// In a forked child, which has none of the threads: forgets them, because nobody can wait for their end.
  virtual void abandon() noexcept = 0;
};

/// Remembers the object for the end of the program. Throws std::runtime_error if the program ends already.
void end_with_program(const std::shared_ptr<Running>& running);

/// A new object that ends with the program.
template <typename Object, typename... Arguments>
std::shared_ptr<Object> make_running(Arguments&&... arguments) {
  const auto object = std::make_shared<Object>(std::forward<Arguments>(arguments)...);
  end_with_program(object);
  return object;
}

}  // namespace glissade::python
