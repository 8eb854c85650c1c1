#include "io/ply_header.h"

#include <algorithm>
#include <array>
#include <limits>
#include <set>
#include <utility>

#include "io/plain_text.h"
#include "io/polygon_triangulation.h"
#include "io/text_scanner.h"

namespace glissade::geometry {
namespace {

constexpr std::uint64_t kLongestHeader = std::uint64_t{1} << 20U;

std::optional<PlyScalar> scalar_named(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, PlyScalar>, 16> kNames{{{"char", PlyScalar::kInt8},
                                                                           {"uchar", PlyScalar::kUint8},
                                                                           {"short", PlyScalar::kInt16},
                                                                           {"ushort", PlyScalar::kUint16},
                                                                           {"int", PlyScalar::kInt32},
                                                                           {"uint", PlyScalar::kUint32},
                                                                           {"float", PlyScalar::kFloat},
                                                                           {"double", PlyScalar::kDouble},
                                                                           {"int8", PlyScalar::kInt8},
                                                                           {"uint8", PlyScalar::kUint8},
                                                                           {"int16", PlyScalar::kInt16},
                                                                           {"uint16", PlyScalar::kUint16},
                                                                           {"int32", PlyScalar::kInt32},
                                                                           {"uint32", PlyScalar::kUint32},
                                                                           {"float32", PlyScalar::kFloat},
                                                                           {"float64", PlyScalar::kDouble}}};
  for (const auto& [known, scalar] : kNames) {
    if (known == name) return scalar;
  }
  return std::nullopt;
}

double largest_count(PlyScalar type) {
  constexpr double kLarge = 2147483647;
  constexpr std::array<double, 8> kLargest{127, 255, 32767, 65535, kLarge, kLarge, kLarge, kLarge};
  return kLargest.at(static_cast<std::size_t>(type));
}

/// Reads the header from the first bytes of a file.
class PlyHeaderReader {
 public:
  PlyHeaderReader(const std::filesystem::path& path, std::string_view bytes)
      : path_(path), bytes_(bytes), lines_(without_byte_order_mark(bytes)) {}

  PlyHeader read() {
    reject_utf16(path_, bytes_);
    if (lines_.next()) split(lines_.line(), words_);
    if (words_.size() != 1 || words_[0] != "ply") reject(path_, "line 1: a PLY file begins with 'ply'");
    bool has_format = false;
    while (true) {
      if (!lines_.next()) fail_without_end();
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
    check_layout();
    header_.bytes = bytes_.size() - lines_.rest().size();
    // Where lines end in CR alone, a line feed after the last one is a byte of the body.
    const std::string_view header = bytes_.substr(0, header_.bytes);
    if (header.ends_with("\r\n") && header.find('\n') == header.size() - 1) --header_.bytes;
    if (header_.bytes == kLongestHeader) fail_without_end();  // its last line may go on
    header_.lines = lines_.number();
    return std::move(header_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { reject(path_, lines_.where() + ": " + what); }

  [[noreturn]] void fail_without_end() const {
    if (bytes_.size() < kLongestHeader) fail("the file is truncated, 'end_header' is missing");
    reject(path_, "the header does not end within its first " + std::to_string(kLongestHeader) + " bytes");
  }

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
    if (!names_.insert(words_[1]).second) fail("the element " + std::string(words_[1]) + " has been named before");
    header_.elements.push_back({std::string(words_[1]), *count, {}});
  }

  void read_property() {
    if (header_.elements.empty()) fail("a property must follow an element");
    const bool is_list = words_.size() == 5 && words_[1] == "list";
    if (!is_list && words_.size() != 3) fail("a property needs a type and a name");
    const auto type = scalar_named(words_[is_list ? 3 : 1]);
    const auto count_type = is_list ? scalar_named(words_[2]) : std::nullopt;
    if (!type || (is_list && !count_type)) fail("the type of the property is not known");
    header_.elements.back().properties.push_back({std::string(words_.back()), *type, count_type});
  }

  void check_layout() const {
    std::string axes;
    for (const PlyElement& element : header_.elements) {
      if (element.name != "vertex") continue;
      for (const PlyProperty& property : element.properties) {
        const bool is_axis = property.name == "x" || property.name == "y" || property.name == "z";
        if (is_axis && !property.count_type) axes += property.name;
      }
    }
    std::sort(axes.begin(), axes.end());
    if (axes != "xyz") reject(path_, "the header must give the element vertex the properties x, y and z, once each");
    const bool has_surface = std::any_of(header_.elements.begin(), header_.elements.end(),
                                         [](const PlyElement& element) { return has_corners(element); });
    if (!has_surface) reject(path_, "the file has no faces: the header names neither an element face nor tristrips");
    for (const PlyElement& element : header_.elements) {
      const auto lists = std::count_if(element.properties.begin(), element.properties.end(),
                                       [](const PlyProperty& property) { return property.is_corner_list(); });
      if (has_corners(element) && lists != 1) {
        reject(path_, "the header must give the element " + element.name + " one list vertex_indices or vertex_index");
      }
    }
  }

  static bool has_corners(const PlyElement& element) {
    return (element.holds_faces() || element.holds_strips()) && element.count > 0;
  }

  const std::filesystem::path& path_;
  std::string_view bytes_;
  LineScanner lines_;
  std::vector<std::string_view> words_;
  std::set<std::string_view> names_;  // of elements
  PlyHeader header_;
};

/// Bounds of the bytes that one element takes.
struct Bounds {
  double least = 0;
  double most = 0;
};

Bounds bytes_of_one(const PlyElement& element) {
  Bounds bounds;
  for (const PlyProperty& property : element.properties) {
    const double size = size_of(property.type);
    const double fewest = property.count_type ? 0 : 1;
    double most = property.count_type ? largest_count(*property.count_type) : 1;
    if (element.holds_faces() && property.is_corner_list()) most = std::min(most, static_cast<double>(kMostCorners));
    const double count_size = property.count_type ? size_of(*property.count_type) : 0.0;
    bounds.least += count_size + fewest * size;
    bounds.most += count_size + most * size;
  }
  return bounds;
}

std::string whole(double number) {
  return std::to_string(static_cast<std::int64_t>(number));
}

}  // namespace

double size_of(PlyScalar type) {
  constexpr std::array<double, 8> kSizes{1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes.at(static_cast<std::size_t>(type));
}

PlyHeader read_ply_header(MeshFile& file) {
  const std::string beginning = file.beginning(kLongestHeader);
  return PlyHeaderReader(file.path(), beginning).read();
}

void check_ply_size(const MeshFile& file, const PlyHeader& header) {
  if (!header.byte_order) return;  // the numbers of a text have any length
  const auto body = static_cast<double>(file.size() - header.bytes);
  Bounds taken;
  for (const PlyElement& element : header.elements) {
    if (element.count == 0) continue;
    const auto count = static_cast<double>(element.count);
    const Bounds one = bytes_of_one(element);
    if (taken.least + count * one.least > body) {
      const std::string last = element.count == 1 ? "" : " to " + std::to_string(element.count - 1);
      reject(file.path(), element.name + " 0" + last + ": the file is truncated: there are " +
                              whole(std::max(0.0, body - taken.least)) + " bytes for at least " +
                              whole(count * one.least));
    }
    taken.least += count * one.least;
    taken.most += count * one.most;
  }
  constexpr double kMostBlanks = 4096;  // which some programs write after the numbers
  if (body > taken.most + kMostBlanks) {
    reject(file.path(), "the file is longer than its header says: " + whole(body) +
                            " bytes follow the header, but at most " + whole(taken.most) + " should");
  }
}

}  // namespace glissade::geometry
