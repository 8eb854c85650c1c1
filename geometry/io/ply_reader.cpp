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
#include "io/mesh_warnings.h"
#include "io/plain_text.h"
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
  double next(PlyScalar type, const Place& where) {
    if (byte_order_) return next_binary(type, where);
    const std::string_view word = next_word(where);
    const auto value = parse_number(word);
    if (!value) reject(path_, this->where(where) + ": '" + printable(word) + "' is not a number");
    return *value;
  }

  /// Skips numbers that are not needed, and need not be any in a text.
  void skip(PlyScalar type, double count, const Place& where) {
    if (byte_order_) {
      const double bytes = count * size_of(type);
      if (bytes > static_cast<double>(bytes_.size() - offset_)) reject_truncated(where);
      offset_ += static_cast<std::size_t>(bytes);
    } else {
      for (double i = 0; i < count; ++i)
        next_word(where);
    }
  }

  /// The element that has just been read, and in a text its line.
  std::string where(const Place& place) const {
    if (byte_order_) return place.text();
    return "line " + std::to_string(header_lines_ + words_.lines().number()) + ", " + place.text();
  }

  /// Rejects any remaining content other than blanks.
  void expect_end() {
    const std::string_view rest = bytes_.substr(offset_);
    if (byte_order_ && rest.find_first_not_of(" \t\r\n") != std::string_view::npos) {
      reject(path_, "the file is longer than its header says: " + std::to_string(rest.size()) +
                        " bytes follow the last element");
    }
    if (!byte_order_ && has_word()) {
      reject(path_, "line " + std::to_string(header_lines_ + words_.lines().number()) +
                        ": the file is longer than its header says");
    }
  }

 private:
  template <class Number>
  double number(const Place& where) {
    if (bytes_.size() - offset_ < sizeof(Number)) reject_truncated(where);
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

  /// Whether there is another word in a text; comments, which belong into the header, are skipped.
  bool has_word() {
    while (words_.has_word()) {
      const std::string_view rest = words_.rest_of_line();
      if (!rest.starts_with("comment") && !rest.starts_with("obj_info")) return true;
      words_.skip_line();
    }
    return false;
  }

  std::string_view next_word(const Place& where) {
    if (!has_word()) reject_truncated(where);
    return words_.word();
  }

  [[noreturn]] void reject_truncated(const Place& place) const {
    reject(path_, where(place) + ": the file ends here: it is truncated, or not as its header says");
  }

  const std::filesystem::path& path_;
  std::optional<std::endian> byte_order_;
  std::string_view bytes_;
  std::size_t offset_ = 0;
  WordScanner words_;
  std::int64_t header_lines_;
};

constexpr WarningKind kFewCorners{"face has fewer than 3 corners and is left out",
                                  "faces have fewer than 3 corners and are left out"};
constexpr WarningKind kShortStrip{"strip has fewer than 3 corners and is left out",
                                  "strips have fewer than 3 corners and are left out"};
constexpr WarningKind kOtherElement{"element other than a face or strip lists vertices and is left out",
                                    "elements other than faces and strips list vertices and are left out"};

/// Collects the vertices, faces and strips of a PLY file.
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
    if (face_corners_.empty()) reject(path_, "the file has no faces of 3 corners or more");
    add_faces();
    soup_.warnings = warnings_.sentences();
    return std::move(soup_);
  }

 private:
  void read_element(const Place& where) {
    const bool is_vertex = where.element.name == "vertex";
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    for (const PlyProperty& property : where.element.properties) {
      const Eigen::Index axis = property.name == "x" ? 0 : property.name == "y" ? 1 : property.name == "z" ? 2 : 3;
      if (property.count_type) {
        read_list(property, where);
      } else if (is_vertex && axis < 3) {
        point[axis] = body_.next(property.type, where);
      } else {
        body_.skip(property.type, 1, where);
      }
    }
    if (is_vertex) soup_.mesh.vertices.push_back(point);
  }

  void read_list(const PlyProperty& property, const Place& where) {
    const double count = body_.next(*property.count_type, where);
    if (!(count >= 0) || count > std::numeric_limits<std::int32_t>::max() || count != std::floor(count)) {
      reject(path_, body_.where(where) + ": a list cannot have this many entries");
    }
    if (property.is_corner_list() && where.element.holds_faces()) {
      read_face(property.type, static_cast<std::int32_t>(count), where);
    } else if (property.is_corner_list() && where.element.holds_strips()) {
      read_strips(property.type, static_cast<std::int32_t>(count), where);
    } else {
      const bool may_hold_surface = property.is_corner_list() && where.element.name != "vertex";
      if (may_hold_surface) warnings_.add(kOtherElement, body_.where(where));
      body_.skip(property.type, count, where);
    }
  }

  void read_face(PlyScalar type, std::int32_t count, const Place& where) {
    if (count < 3) {
      warnings_.add(kFewCorners, body_.where(where));
      body_.skip(type, count, where);
      return;
    }
    if (count > static_cast<std::int32_t>(kMostCorners)) {
      reject(path_, body_.where(where) + ": a face of " + std::to_string(count) + " corners, at most " +
                        std::to_string(kMostCorners) + " are supported");
    }
    for (std::int32_t k = 0; k < count; ++k)
      corners_.push_back(checked_index(body_.next(type, where), where));
    face_corners_.push_back(static_cast<std::uint16_t>(count));
  }

  /// Strips, each but the last one ended by -1: a corner makes a triangle with the two before it, and every second
  /// triangle is turned round.
  void read_strips(PlyScalar type, std::int32_t count, const Place& where) {
    std::int32_t length = 0;
    std::array<std::int32_t, 2> last{};
    const auto end_strip = [&] {
      if (length == 1 || length == 2) warnings_.add(kShortStrip, body_.where(where));
      length = 0;
    };
    for (std::int32_t k = 0; k < count; ++k) {
      const double index = body_.next(type, where);
      if (index == -1) {
        end_strip();
        continue;
      }
      const std::int32_t corner = checked_index(index, where);
      if (length >= 2) {
        const std::size_t odd = static_cast<std::size_t>(length) % 2;
        corners_.insert(corners_.end(), {last[odd], last[1 - odd], corner});
        face_corners_.push_back(3);
      }
      last = {last[1], corner};
      ++length;
    }
    end_strip();
  }

  std::int32_t checked_index(double index, const Place& where) const {
    if (index >= 0 && index < static_cast<double>(vertex_count_) && index == std::floor(index)) {
      return static_cast<std::int32_t>(index);
    }
    // In a text file the index may be a fraction, beyond every integer, or not a number at all.
    std::array<char, 32> digits{};
    const char* end = std::to_chars(digits.data(), digits.data() + digits.size(), index).ptr;
    reject(path_, body_.where(where) + ": the vertex index " +
                      std::string(digits.begin(), digits.begin() + (end - digits.data())) +
                      " is out of range, the file has " + std::to_string(vertex_count_) + " vertices");
  }

  /// Runs after all elements have been read, because faces may precede the vertices.
  void add_faces() {
    const std::span<const std::int32_t> corners(corners_);
    std::size_t begin = 0;
    for (const std::uint16_t count : face_corners_) {
      const std::span<const std::int32_t> polygon = corners.subspan(begin, count);
      for (const std::int32_t corner : polygon) {
        const std::optional<double> bad = bad_coordinate(soup_.mesh.vertices[static_cast<std::size_t>(corner)]);
        if (bad) reject_coordinate(path_, "vertex " + std::to_string(corner) + ", of a face", *bad);
      }
      add_polygon(file_, polygon, soup_);
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
  MeshWarnings warnings_;
  TriangleSoup soup_;
};

}  // namespace

TriangleSoup read_ply(MeshFile& file) {
  const PlyHeader header = read_ply_header(file);
  check_ply_size(file, header);
  const std::string content = file.content();
  if (!header.byte_order) reject_zero_bytes(file.path(), content);
  return PlyReader(file, header, std::string_view(content).substr(header.bytes)).read();
}

}  // namespace glissade::geometry
