#pragma once

#include <pybind11/pybind11.h>
#include <unistd.h>

namespace glissade::python {

/// Gives the interpreter lock back while it exists. At the end of the program, Python ends a thread that asks for the
/// lock, in the middle of its functions; a thread of ours stops here instead, as it will in Python 3.14.
class Unlocked {
 public:
  Unlocked() : state_(PyEval_SaveThread()) {}
  Unlocked(const Unlocked&) = delete;
  Unlocked& operator=(const Unlocked&) = delete;
  ~Unlocked() noexcept(false) {
    while (_Py_IsFinalizing() != 0)
      pause();
    PyEval_RestoreThread(state_);
  }

 private:
  PyThreadState* state_;
};

}  // namespace glissade::python
