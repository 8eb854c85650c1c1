#include "io/plain_text.h"

#include <algorithm>
#include <string>

#include "io/mesh_file.h"
#include "io/text_scanner.h"

namespace glissade::geometry {

bool is_utf16(std::string_view bytes) {
  if (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF")) bytes.remove_prefix(2);
  // The keywords of all formats are ASCII, of which UTF-16 makes pairs of a zero and another byte.
  constexpr std::size_t kLetters = 3;
  if (bytes.size() < 2 * kLetters) return false;
  const std::size_t zero = bytes[0] == '\0' ? 0 : 1;
  for (std::size_t i = 0; i < kLetters; ++i) {
    if (bytes[2 * i + zero] != '\0' || bytes[2 * i + 1 - zero] == '\0') return false;
  }
  return true;
}

void reject_utf16(const std::filesystem::path& path, std::string_view text) {
  if (is_utf16(text)) reject(path, "the text is encoded in UTF-16; only ASCII and UTF-8 are read");
}

void reject_zero_bytes(const std::filesystem::path& path, std::string_view text) {
  reject_utf16(path, text);
  const std::size_t zero = text.find('\0');
  if (zero == std::string_view::npos) return;
  LineScanner lines(text.substr(0, zero + 1));
  while (lines.next()) {
  }
  const auto count = std::count(text.begin(), text.end(), '\0');
  reject(path, lines.where() + ": " +
                   (count == 1 ? "a zero byte" : std::to_string(count) + " zero bytes from here on") +
                   " in a text: the file is damaged");
}

}  // namespace glissade::geometry
