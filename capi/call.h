#pragma once

/// What every function of the C interface does with exceptions and pointers.

#include <exception>
#include <stdexcept>
#include <string>

#include "glissade.h"

namespace glissade::c {

/// Keeps the sentence for `glissade_last_error` of this thread, cut to 1023 bytes. Returns `status`.
GlissadeStatus fail(GlissadeStatus status, const char* sentence) noexcept;

/// Runs `work`. An exception becomes a status and a sentence.
template <typename Work>
GlissadeStatus call(const Work& work) noexcept {
  try {
    work();
    return GLISSADE_OK;
  } catch (const std::logic_error& error) {  // std::invalid_argument, std::out_of_range, std::length_error
    return fail(GLISSADE_INVALID, error.what());
  } catch (const std::exception& error) {
    return fail(GLISSADE_FAILED, error.what());
  } catch (...) {
    return fail(GLISSADE_FAILED, "an exception of unknown type");
  }
}

/// The object at `pointer`; throws std::invalid_argument, naming the argument, if it is null.
template <typename T>
T& at(T* pointer, const char* argument) {
  if (pointer == nullptr) throw std::invalid_argument(std::string(argument) + " is null");
  return *pointer;
}

/// The same for an array, which may be null if it is empty.
template <typename T>
T* array(T* pointer, std::size_t count, const char* argument) {
  return count == 0 ? pointer : &at(pointer, argument);
}

}  // namespace glissade::c
