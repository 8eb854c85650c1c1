#pragma once

/// The header of a PLY file.

#include <bit>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/mesh_file.h"

namespace glissade::geometry {

enum class PlyScalar { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };

/// In bytes.
double size_of(PlyScalar type);

struct PlyProperty {
  std::string name;
  PlyScalar type;
  std::optional<PlyScalar> count_type;  // for lists

  /// Whether it lists the corners of faces or strips.
  bool is_corner_list() const { return count_type && (name == "vertex_indices" || name == "vertex_index"); }
};

struct PlyElement {
  std::string name;
  std::int64_t count;
  std::vector<PlyProperty> properties;

  bool holds_faces() const { return name == "face"; }
  bool holds_strips() const { return name == "tristrips"; }
};

/// The content of the header, up to the end of the line "end_header".
struct PlyHeader {
  std::optional<std::endian> byte_order;  // empty for text
  std::vector<PlyElement> elements;
  std::size_t bytes = 0;
  std::int64_t lines = 0;
};

/// Reads the header from the beginning of a file. The element `vertex` has x, y and z, once each; the elements `face`
/// and `tristrips` have one list of corners, each if there is one. Throws std::invalid_argument for a header that is
/// malformed, truncated or longer than 1 MiB.
PlyHeader read_ply_header(MeshFile& file);

/// Rejects a binary file whose size the header rules out.
void check_ply_size(const MeshFile& file, const PlyHeader& header);

}  // namespace glissade::geometry
