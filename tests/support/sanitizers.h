#pragma once

/// Random tests do a twentieth of their work under a sanitizer, which slows them down about as much.

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define GLISSADE_SANITIZED 1
#elif defined(__has_feature)  // clang
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define GLISSADE_SANITIZED 1
#endif
#endif
#ifndef GLISSADE_SANITIZED
#define GLISSADE_SANITIZED 0
#endif

namespace glissade::test_support {

inline constexpr bool kSanitized = GLISSADE_SANITIZED == 1;

/// `count`, or a twentieth of it under a sanitizer.
constexpr int affordable(int count) {
  return kSanitized ? count / 20 : count;
}

}  // namespace glissade::test_support
