#pragma once

/// Texts in an encoding that the readers do not understand.

#include <filesystem>
#include <string_view>

namespace glissade::geometry {

/// Whether the bytes begin as a text in UTF-16 does, with a byte-order mark or without.
bool is_utf16(std::string_view bytes);

/// Throws std::invalid_argument if a text is in UTF-16.
void reject_utf16(const std::filesystem::path& path, std::string_view text);

/// The same, and for zero bytes, which no text has.
void reject_zero_bytes(const std::filesystem::path& path, std::string_view text);

}  // namespace glissade::geometry
