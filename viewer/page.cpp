#include <charconv>
#include <stdexcept>
#include <string>

#include <glissade/viewer/page.h>

extern "C" {
extern const char glissade_page_begin;
extern const char glissade_page_end;
}

namespace glissade::viewer {

std::string_view page() noexcept {
  return {&glissade_page_begin, &glissade_page_end};
}

std::array<double, 3> color(std::string_view name) {
  // The palette of light screens comes first, see page/src/palette.css.
  const std::string declaration = "--" + std::string(name) + ": #";
  const std::size_t place = page().find(declaration);
  if (place == std::string_view::npos) throw std::logic_error("the page has no colour " + std::string(name));
  const char* digits = page().data() + place + declaration.size();
  std::array<double, 3> rgb{};
  for (double& value : rgb) {
    int byte = 0;
    digits = std::from_chars(digits, digits + 2, byte, 16).ptr;
    value = byte / 255.0;
  }
  return rgb;
}

}  // namespace glissade::viewer
