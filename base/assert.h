#pragma once

/// Checks of preconditions that a function documents with "must" and does not throw for.
///
/// GLISSADE_ASSERT(condition): if the condition is false, reports file, line and condition to the standard error and
/// ends the program. The CMake option GLISSADE_ASSERTIONS turns it on; without it the condition is compiled, but never
/// evaluated. Real-time code may use it: a check that holds allocates nothing and makes no system call.
///
/// Public headers must not use it. They are compiled with the options of the user's program, so one inline function
/// could have two definitions in one program. Sources and private headers always see the options of the library.

#ifdef GLISSADE_ASSERTIONS

#include <cstdio>
#include <cstdlib>

namespace glissade::base {

[[noreturn]] inline void assertion_failed(const char* file, int line, const char* condition) noexcept {
  std::fprintf(stderr, "%s:%d: the precondition does not hold: %s\n", file, line, condition);
  std::abort();
}

}  // namespace glissade::base

#define GLISSADE_ASSERT(condition) \
  ((condition) ? static_cast<void>(0) : ::glissade::base::assertion_failed(__FILE__, __LINE__, #condition))

#else

#define GLISSADE_ASSERT(condition) static_cast<void>(sizeof((condition) ? 1 : 0))

#endif
