#pragma once

/// Random tests do a twentieth of their work under a sanitizer, which slows them down about as much.

namespace glissade::test_support {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kSanitized = true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif
#else
inline constexpr bool kSanitized = false;
#endif

/// `count`, or a twentieth of it under a sanitizer.
constexpr int affordable(int count) {
  return kSanitized ? count / 20 : count;
}

}  // namespace glissade::test_support
