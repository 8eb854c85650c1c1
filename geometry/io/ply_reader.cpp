#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <glissade/base/byte_order.h>

#include "io/mesh_readers.h"
#include "io/ply_header.h"
#include "io/polygon_triangulation.h"
#include "io/text_scanner.h"

namespace glissade::geometry {
namespace {

/// An element, for messages.
struct Place {
  const PlyElement& element;
  std::int64_t index;

  std::string text() const { return element.name + " " + std::to_string(index); }
};

/// Reads the numbers after the header, in text or binary form.
class PlyBodyReader {
 public:
  /// `bytes` is what follows the header.
  PlyBodyReader(const std::filesystem::path& path, const PlyHeader& header, std::string_view bytes)
      : path_(path), byte_order_(header.byte_order), bytes_(bytes), words_(bytes), header_lines_(header.lines) {}

  /// The next number. That of a text is read as a double, whatever its type.
  double next(PlyScalar type, const Place& where) { return byte_order_ ? next_binary(type, where) : next_word(where); }

  /// Rejects any remaining content other than blanks.
  void expect_end() {
    const bool has_more =
        byte_order_ ? bytes_.find_first_not_of(" \t\r\n", offset_) != std::string_view::npos : words_.has_word();
    if (has_more) reject(path_, "The file is longer than its header says");
  }

 private:
  template <class Number>
  double number(const Place& where) {
    if (bytes_.size() - offset_ < sizeof(Number)) reject(path_, where.text() + ": the file is truncated here");
    const auto value = base::number_at<Number>(bytes_, offset_, *byte_order_);
    offset_ += sizeof(Number);
    return static_cast<double>(value);
  }

  double next_binary(PlyScalar type, const Place& where) {
    switch (type) {
      case PlyScalar::kInt8:
        return number<std::int8_t>(where);
      case PlyScalar::kUint8:
        return number<std::uint8_t>(where);
      case PlyScalar::kInt16:
        return number<std::int16_t>(where);
      case PlyScalar::kUint16:
        return number<std::uint16_t>(where);
      case PlyScalar::kInt32:
        return number<std::int32_t>(where);
      case PlyScalar::kUint32:
        return number<std::uint32_t>(where);
      case PlyScalar::kFloat:
        return number<float>(where);
      case PlyScalar::kDouble:
        break;
    }
    return number<double>(where);
  }

  double next_word(const Place& where) {
    if (!words_.has_word()) reject(path_, where.text() + ": the file is truncated here");
    const auto value = parse_number(words_.word());
    if (!value) {
      reject(path_, "line " + std::to_string(header_lines_ + words_.lines().number()) + ", " + where.text() +
                        ": this is not a number");
    }
    return *value;
  }

  const std::filesystem::path& path_;
  std::optional<std::endian> byte_order_;
  std::string_view bytes_;
  std::size_t offset_ = 0;
  WordScanner words_;
  std::int64_t header_lines_;
};

/// Collects the vertices and faces of a PLY file.
class PlyReader {
 public:
  PlyReader(const MeshFile& file, const PlyHeader& header, std::string_view bytes)
      : file_(file), path_(file.path()), header_(header), body_(path_, header, bytes) {}

  TriangleSoup read() {
    for (const PlyElement& element : header_.elements) {
      if (element.name == "vertex") vertex_count_ = element.count;
    }
    for (const PlyElement& element : header_.elements) {
      // Elements without properties take no room in the file, however many there are.
      if (element.properties.empty()) continue;
      for (std::int64_t i = 0; i < element.count; ++i) {
        read_element({element, i});
      }
    }
    body_.expect_end();
    if (face_corners_.empty()) reject(path_, "The file has no faces");
    add_faces();
    return std::move(soup_);
  }

 private:
  void read_element(const Place& where) {
    const bool is_vertex = where.element.name == "vertex";
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    for (const PlyProperty& property : where.element.properties) {
      if (property.count_type) {
        read_list(property, where);
        continue;
      }
      const double value = body_.next(property.type, where);
      const Eigen::Index axis = property.name == "x" ? 0 : property.name == "y" ? 1 : property.name == "z" ? 2 : 3;
      if (is_vertex && axis < 3) {
        if (!is_coordinate(value)) reject_coordinate(path_, where.text(), value);
        point[axis] = value;
      }
    }
    if (is_vertex) soup_.mesh.vertices.push_back(point);
  }

  void read_list(const PlyProperty& property, const Place& where) {
    const double count = body_.next(*property.count_type, where);
    if (!(count >= 0) || count > std::numeric_limits<std::int32_t>::max() || count != std::floor(count)) {
      reject(path_, where.text() + ": a list cannot have this many entries");
    }
    const bool is_face = where.element.name == "face" && property.is_corner_list();
    if (is_face && count < 3) {
      reject(path_,
             where.text() + ": a face needs at least 3 corners, but has " + std::to_string(static_cast<int>(count)));
    }
    if (is_face && count > static_cast<double>(kMostCorners)) {
      reject(path_, where.text() + ": a face of " + std::to_string(static_cast<std::int64_t>(count)) +
                        " corners, at most " + std::to_string(kMostCorners) + " are supported");
    }
    for (double k = 0; k < count; ++k) {
      const double value = body_.next(property.type, where);
      if (is_face) corners_.push_back(checked_index(value, where));
    }
    if (is_face) face_corners_.push_back(static_cast<std::uint16_t>(count));
  }

  std::int32_t checked_index(double index, const Place& where) const {
    if (index >= 0 && index < static_cast<double>(vertex_count_) && index == std::floor(index)) {
      return static_cast<std::int32_t>(index);
    }
    // In a text file the index may be a fraction, beyond every integer, or not a number at all.
    std::array<char, 32> digits{};
    const char* end = std::to_chars(digits.data(), digits.data() + digits.size(), index).ptr;
    reject(path_, where.text() + ": the vertex index " +
                      std::string(digits.begin(), digits.begin() + (end - digits.data())) +
                      " is out of range, the file has " + std::to_string(vertex_count_) + " vertices");
  }

  /// Runs after all elements have been read, because faces may precede the vertices.
  void add_faces() {
    const std::span<const std::int32_t> corners(corners_);
    std::size_t begin = 0;
    for (const std::uint16_t count : face_corners_) {
      add_polygon(file_, corners.subspan(begin, count), soup_);
      begin += count;
    }
  }

  const MeshFile& file_;
  const std::filesystem::path& path_;
  const PlyHeader& header_;
  PlyBodyReader body_;
  std::int64_t vertex_count_ = 0;
  std::vector<std::uint16_t> face_corners_;  // number of corners of each face
  std::vector<std::int32_t> corners_;        // of all faces
  TriangleSoup soup_;
};

}  // namespace

TriangleSoup read_ply(MeshFile& file) {
  const PlyHeader header = read_ply_header(file);
  check_ply_size(file, header);
  const std::string content = file.content();
  return PlyReader(file, header, std::string_view(content).substr(header.bytes)).read();
}

}  // namespace glissade::geometry
