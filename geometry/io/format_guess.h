#pragma once

/// What a mesh file seems to be, whatever its name says, for the message that it cannot be read.

#include <cstdint>
#include <string_view>

namespace glissade::geometry {

/// The format by the file's first bytes, of which some thousand suffice: "OBJ", "STL", "PLY" or "glTF"; empty if they
/// look like none. `size` is that of the whole file.
std::string_view format_guess(std::string_view beginning, std::uint64_t size);

}  // namespace glissade::geometry
