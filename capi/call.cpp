#include "call.h"

#include <algorithm>
#include <array>
#include <cstring>

#include <glissade/realtime/clock.h>

namespace glissade::c {

namespace {

thread_local std::array<char, 1024> last_error{};  // no string: to keep it may not fail

}  // namespace

GlissadeStatus fail(GlissadeStatus status, const char* sentence) noexcept {
  const std::size_t length = std::min(std::strlen(sentence), last_error.size() - 1);
  std::copy_n(sentence, length, last_error.begin());
  last_error[length] = '\0';
  return status;
}

}  // namespace glissade::c

const char* glissade_version(void) {
  return GLISSADE_VERSION;
}

const char* glissade_last_error(void) {
  return glissade::c::last_error.data();
}

int64_t glissade_now_ns(void) {
  return glissade::realtime::SteadyClock().now().count();
}
