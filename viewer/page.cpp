#include <glissade/viewer/page.h>

extern "C" {
extern const char glissade_page_begin;
extern const char glissade_page_end;
}

namespace glissade::viewer {

std::string_view page() noexcept {
  return {&glissade_page_begin, &glissade_page_end};
}

}  // namespace glissade::viewer
