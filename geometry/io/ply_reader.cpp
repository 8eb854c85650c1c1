#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <glissade/base/byte_order.h>

#include "io/mesh_validation.h"
#include "io/polygon_triangulation.h"
#include "io/text_scanner.h"

namespace glissade::geometry {
namespace {

enum class Scalar { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };

struct Property {
  std::string name;
  Scalar type;
  std::optional<Scalar> count_type;  // for lists
};

struct Element {
  std::string name;
  std::int64_t count;
  std::vector<Property> properties;
};

std::optional<Scalar> scalar_named(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, Scalar>, 16> kNames{{{"char", Scalar::kInt8},
                                                                        {"uchar", Scalar::kUint8},
                                                                        {"short", Scalar::kInt16},
                                                                        {"ushort", Scalar::kUint16},
                                                                        {"int", Scalar::kInt32},
                                                                        {"uint", Scalar::kUint32},
                                                                        {"float", Scalar::kFloat},
                                                                        {"double", Scalar::kDouble},
                                                                        {"int8", Scalar::kInt8},
                                                                        {"uint8", Scalar::kUint8},
                                                                        {"int16", Scalar::kInt16},
                                                                        {"uint16", Scalar::kUint16},
                                                                        {"int32", Scalar::kInt32},
                                                                        {"uint32", Scalar::kUint32},
                                                                        {"float32", Scalar::kFloat},
                                                                        {"float64", Scalar::kDouble}}};
  for (const auto& [known, scalar] : kNames) {
    if (known == name) return scalar;
  }
  return std::nullopt;
}

bool is_integer(Scalar type) {
  return type != Scalar::kFloat && type != Scalar::kDouble;
}

/// The content of the header, up to "end_header", and the rest of the file.
struct Header {
  std::optional<std::endian> byte_order;  // empty for text
  std::vector<Element> elements;
  std::string_view body;
  std::int64_t lines = 0;
};

class HeaderReader {
 public:
  HeaderReader(const std::filesystem::path& path, std::string_view bytes) : path_(path), lines_(bytes) {}

  Header read() {
    if (!lines_.next() || lines_.line() != "ply") reject(path_, "line 1: a PLY file begins with 'ply'");
    bool has_format = false;
    while (true) {
      if (!lines_.next()) reject(path_, lines_.where() + ": the file is truncated, 'end_header' is missing");
      split(lines_.line(), words_);
      if (words_.empty() || words_[0] == "comment" || words_[0] == "obj_info") continue;
      if (words_[0] == "end_header") break;
      if (words_[0] == "format") {
        read_format();
        has_format = true;
      } else if (words_[0] == "element") {
        read_element();
      } else if (words_[0] == "property") {
        read_property();
      } else {
        fail("a header line begins with format, element, property, comment or end_header");
      }
    }
    if (!has_format) fail("the header names no format");
    header_.body = lines_.rest();
    header_.lines = lines_.number();
    return std::move(header_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { reject(path_, lines_.where() + ": " + what); }

  void read_format() {
    if (words_.size() != 3 || words_[2] != "1.0") fail("the format must be 'format <kind> 1.0'");
    if (words_[1] == "binary_little_endian") {
      header_.byte_order = std::endian::little;
    } else if (words_[1] == "binary_big_endian") {
      header_.byte_order = std::endian::big;
    } else if (words_[1] != "ascii") {
      fail("the format must be ascii, binary_little_endian or binary_big_endian");
    }
  }

  void read_element() {
    if (words_.size() != 3) fail("an element needs a name and a count");
    const auto count = parse_integer(words_[2]);
    if (!count || *count < 0 || *count > std::numeric_limits<std::int32_t>::max()) {
      fail("the count of an element must be from 0 to 2147483647");
    }
    header_.elements.push_back({std::string(words_[1]), *count, {}});
  }

  void read_property() {
    if (header_.elements.empty()) fail("a property must follow an element");
    const bool is_list = words_.size() == 5 && words_[1] == "list";
    if (!is_list && words_.size() != 3) fail("a property needs a type and a name");
    const auto type = scalar_named(words_[is_list ? 3 : 1]);
    const auto count_type = is_list ? scalar_named(words_[2]) : std::nullopt;
    if (!type || (is_list && (!count_type || !is_integer(*count_type)))) fail("the type of the property is not known");
    header_.elements.back().properties.push_back({std::string(words_.back()), *type, count_type});
  }

  const std::filesystem::path& path_;
  LineScanner lines_;
  std::vector<std::string_view> words_;
  Header header_;
};

/// Reads the numbers after the header, in text or binary form.
class BodyReader {
 public:
  BodyReader(const std::filesystem::path& path, const Header& header)
      : path_(path),
        byte_order_(header.byte_order),
        bytes_(header.body),
        words_(header.body),
        header_lines_(header.lines) {}

  /// The next number; `where` names its element in messages.
  double next(Scalar type, const std::string& where) {
    return byte_order_ ? next_binary(type, where) : next_word(where);
  }

  /// Rejects any remaining content other than blanks.
  void expect_end() {
    const bool has_more =
        byte_order_ ? bytes_.find_first_not_of(" \t\r\n", offset_) != std::string_view::npos : words_.has_word();
    if (has_more) reject(path_, "The file is longer than its header says");
  }

 private:
  template <class Number>
  double number(const std::string& where) {
    if (bytes_.size() - offset_ < sizeof(Number)) reject(path_, where + ": the file is truncated here");
    const auto value = base::number_at<Number>(bytes_, offset_, *byte_order_);
    offset_ += sizeof(Number);
    return static_cast<double>(value);
  }

  double next_binary(Scalar type, const std::string& where) {
    switch (type) {
      case Scalar::kInt8:
        return number<std::int8_t>(where);
      case Scalar::kUint8:
        return number<std::uint8_t>(where);
      case Scalar::kInt16:
        return number<std::int16_t>(where);
      case Scalar::kUint16:
        return number<std::uint16_t>(where);
      case Scalar::kInt32:
        return number<std::int32_t>(where);
      case Scalar::kUint32:
        return number<std::uint32_t>(where);
      case Scalar::kFloat:
        return number<float>(where);
      case Scalar::kDouble:
        break;
    }
    return number<double>(where);
  }

  double next_word(const std::string& where) {
    if (!words_.has_word()) reject(path_, where + ": the file is truncated here");
    const auto value = parse_number(words_.word());
    if (!value) {
      reject(path_, "line " + std::to_string(header_lines_ + words_.lines().number()) + ", " + where +
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
  PlyReader(const std::filesystem::path& path, std::string_view bytes)
      : path_(path), header_(HeaderReader(path, bytes).read()), body_(path, header_) {}

  VettedFile clean() {
    check_layout();
    for (const Element& element : header_.elements) {
      // Elements without properties take no room in the file, however many there are.
      if (element.properties.empty()) continue;
      for (std::int64_t i = 0; i < element.count; ++i) {
        read(element, i);
      }
    }
    body_.expect_end();
    if (face_corners_.empty()) reject(path_, "The file has no faces");
    check_indices();
    return written();
  }

 private:
  static bool is_corner_list(const Property& property) {
    return property.count_type && (property.name == "vertex_indices" || property.name == "vertex_index");
  }

  void check_layout() const {
    int axes = 0;
    int lists = 0;
    for (const Element& element : header_.elements) {
      for (const Property& property : element.properties) {
        const bool is_axis = property.name == "x" || property.name == "y" || property.name == "z";
        if (element.name == "vertex" && is_axis && !property.count_type) ++axes;
        if (element.name == "face" && is_corner_list(property)) {
          ++lists;
          if (!is_integer(property.type))
            reject(path_, "The property " + property.name + " must be a list of integers");
        }
      }
    }
    if (axes != 3) reject(path_, "The header must give the element vertex the properties x, y and z, once each");
    if (lists != 1) reject(path_, "The header must give the element face one list vertex_indices: there are no faces");
  }

  void read(const Element& element, std::int64_t i) {
    const std::string where = element.name + " " + std::to_string(i);
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    for (const Property& property : element.properties) {
      if (property.count_type) {
        read_list(element, property, where);
        continue;
      }
      const double value = body_.next(property.type, where);
      const Eigen::Index axis = property.name == "x" ? 0 : property.name == "y" ? 1 : property.name == "z" ? 2 : 3;
      if (element.name == "vertex" && axis < 3) {
        check_coordinate(path_, where, value);
        point[axis] = value;
      }
    }
    if (element.name == "vertex") vertices_.push_back(point);
  }

  void read_list(const Element& element, const Property& property, const std::string& where) {
    const double count = body_.next(*property.count_type, where);
    if (!(count >= 0) || count > std::numeric_limits<std::int32_t>::max() || count != std::floor(count)) {
      reject(path_, where + ": a list cannot have this many entries");
    }
    const bool is_face = element.name == "face" && is_corner_list(property);
    if (is_face && count < 3) {
      reject(path_, where + ": a face needs at least 3 corners, but has " + std::to_string(static_cast<int>(count)));
    }
    if (is_face && count > static_cast<double>(kMostCorners)) {
      reject(path_, where + ": a face of " + std::to_string(static_cast<std::int64_t>(count)) + " corners, at most " +
                        std::to_string(kMostCorners) + " are supported");
    }
    for (double k = 0; k < count; ++k) {
      const double value = body_.next(property.type, where);
      if (is_face) corners_.push_back(value);
    }
    if (is_face) face_corners_.push_back(static_cast<std::uint32_t>(count));
  }

  /// Runs after all elements have been read, because faces may precede the vertices.
  void check_indices() const {
    std::size_t next = 0;
    for (std::size_t face = 0; face < face_corners_.size(); ++face) {
      for (std::uint32_t k = 0; k < face_corners_[face]; ++k) {
        const double index = corners_[next++];
        if (index >= 0 && index < static_cast<double>(vertices_.size()) && index == std::floor(index)) continue;
        // In a text file the index may be a fraction, beyond every integer, or not a number at all.
        std::array<char, 32> digits{};
        const char* end = std::to_chars(digits.data(), digits.data() + digits.size(), index).ptr;
        reject(path_, "face " + std::to_string(face) + ": the vertex index " +
                          std::string(digits.begin(), digits.begin() + (end - digits.data())) +
                          " is out of range, the file has " + std::to_string(vertices_.size()) + " vertices");
      }
    }
  }

  VettedFile written() const {
    VettedFile file;
    std::string faces;
    std::int64_t count = 0;
    std::vector<Eigen::Vector3d> points;
    std::size_t begin = 0;
    for (const std::uint32_t corners : face_corners_) {
      points.clear();
      for (std::uint32_t k = 0; k < corners; ++k) {
        points.push_back(vertices_[static_cast<std::size_t>(corners_[begin + k])]);
      }
      if (corners > 3) ++file.polygons_triangulated;
      for (const auto& triangle : triangulated(points)) {
        base::append_number(faces, std::uint8_t{3});
        for (const std::size_t corner : triangle) {
          base::append_number(faces, static_cast<std::int32_t>(corners_[begin + corner]));
        }
        ++count;
      }
      begin += corners;
    }
    file.bytes = "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(vertices_.size()) +
                 "\nproperty float x\nproperty float y\nproperty float z\nelement face " + std::to_string(count) +
                 "\nproperty list uchar int vertex_indices\nend_header\n";
    for (const Eigen::Vector3d& vertex : vertices_) {
      for (const double coordinate : vertex) {
        base::append_number(file.bytes, static_cast<float>(coordinate));
      }
    }
    file.bytes += faces;
    return file;
  }

  const std::filesystem::path& path_;
  Header header_;
  BodyReader body_;
  std::vector<Eigen::Vector3d> vertices_;
  std::vector<std::uint32_t> face_corners_;
  std::vector<double> corners_;
};

}  // namespace

VettedFile vetted_ply(const std::filesystem::path& path, std::string_view bytes) {
  return PlyReader(path, bytes).clean();
}

}  // namespace glissade::geometry
