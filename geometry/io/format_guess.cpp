#include "io/format_guess.h"

#include <algorithm>

#include <glissade/base/byte_order.h>

#include "io/text_scanner.h"

namespace glissade::geometry {
namespace {

bool is_binary_stl(std::string_view beginning, std::uint64_t size) {
  constexpr std::uint64_t kHeader = 84;
  constexpr std::uint64_t kTriangle = 50;
  if (beginning.size() < kHeader) return false;
  return size == kHeader + kTriangle * base::number_at<std::uint32_t>(beginning, kHeader - 4);
}

/// Whether a line begins with "v" and a number.
bool has_obj_vertex(std::string_view text) {
  LineScanner lines(text);
  while (lines.next()) {
    const std::string_view line = lines.line();
    if (!line.starts_with("v ") && !line.starts_with("v\t")) continue;
    const std::size_t number = line.find_first_not_of(kBlanks, 1);
    if (number != std::string_view::npos && line.find_first_of("+-.0123456789", number) == number) return true;
  }
  return false;
}

}  // namespace

std::string_view format_guess(std::string_view beginning, std::uint64_t size) {
  if (beginning.starts_with("glTF")) return "glTF";
  if (is_binary_stl(beginning, size)) return "STL";
  const std::string_view text = without_byte_order_mark(beginning);
  if (text.starts_with("ply\n") || text.starts_with("ply\r")) return "PLY";
  if (text.substr(std::min(text.size(), text.find_first_not_of(" \t\r\n"))).starts_with('{')) return "glTF";
  if (text.find("facet") != std::string_view::npos && text.find("vertex") != std::string_view::npos) return "STL";
  return has_obj_vertex(text) ? "OBJ" : "";
}

}  // namespace glissade::geometry
