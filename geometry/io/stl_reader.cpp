#include <algorithm>
#include <cctype>
#include <cstdint>
#include <limits>
#include <vector>

#include <glissade/base/byte_order.h>

#include "io/mesh_validation.h"
#include "io/text_scanner.h"

namespace glissade::geometry {
namespace {

constexpr std::size_t kHeaderSize = 84;
constexpr std::size_t kTriangleSize = 50;

std::string binary_stl(const std::vector<float>& coordinates) {
  std::string output(80, '\0');
  base::append_number(output, static_cast<std::uint32_t>(coordinates.size() / 9));
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    if (i % 9 == 0) output.append(12, '\0');  // the normal
    base::append_number(output, coordinates[i]);
    if (i % 9 == 8) output.append(2, '\0');  // the attribute
  }
  return output;
}

std::string vetted_binary(const std::filesystem::path& path, std::string_view bytes) {
  if (bytes.size() < kHeaderSize) {
    reject(path, "The file is truncated: it has " + std::to_string(bytes.size()) + " bytes, an STL header has 84");
  }
  const std::uint64_t count = base::number_at<std::uint32_t>(bytes, 80);
  const std::uint64_t expected = kHeaderSize + kTriangleSize * count;
  if (bytes.size() != expected) {
    reject(path, std::string(bytes.size() < expected ? "The file is truncated" : "The file is too long") + ": it has " +
                     std::to_string(bytes.size()) + " bytes, but " + std::to_string(count) + " triangles take " +
                     std::to_string(expected));
  }
  if (count == 0) reject(path, "The file has no triangles");
  std::vector<float> coordinates;
  coordinates.reserve(9 * count);
  for (std::size_t t = 0; t < count; ++t) {
    for (std::size_t i = 0; i < 9; ++i) {
      const float value = base::number_at<float>(bytes, kHeaderSize + kTriangleSize * t + 12 + 4 * i);
      check_coordinate(path, "triangle " + std::to_string(t), static_cast<double>(value));
      coordinates.push_back(value);
    }
  }
  return binary_stl(coordinates);
}

/// Reads a text STL file word by word.
class TextStlReader {
 public:
  TextStlReader(const std::filesystem::path& path, std::string_view bytes) : path_(path), words_(bytes) {}

  std::string clean() {
    while (words_.has_word()) {
      read_solid();
    }
    if (coordinates_.empty()) reject(path_, "The file has no triangles");
    return binary_stl(coordinates_);
  }

 private:
  std::string_view word(const std::string& expected) {
    if (!words_.has_word()) {
      reject(path_, words_.lines().where() + ": the file is truncated, '" + expected + "' should follow");
    }
    return words_.word();
  }

  static bool equal(std::string_view a, std::string_view lower_case) {
    return std::equal(a.begin(), a.end(), lower_case.begin(), lower_case.end(), [](char x, char y) {
      return std::tolower(static_cast<unsigned char>(x)) == static_cast<unsigned char>(y);
    });
  }

  void expect(const std::string& expected) {
    if (!equal(word(expected), expected))
      reject(path_, words_.lines().where() + ": '" + expected + "' should stand here");
  }

  void read_solid() {
    expect("solid");
    words_.skip_line();  // the rest of the line is a name
    while (true) {
      const std::string_view keyword = word("endsolid");
      if (equal(keyword, "endsolid")) break;
      if (!equal(keyword, "facet")) reject(path_, words_.lines().where() + ": 'facet' or 'endsolid' should stand here");
      read_facet();
    }
    words_.skip_line();
  }

  void read_facet() {
    expect("normal");
    for (int i = 0; i < 3; ++i) {
      word("the normal");  // not needed, and often not a number for slivers
    }
    expect("outer");
    expect("loop");
    for (int i = 0; i < 3; ++i) {
      expect("vertex");
      for (int k = 0; k < 3; ++k) {
        const std::string_view text = word("a coordinate");
        const auto value = parse_number(text);
        if (!value) reject(path_, words_.lines().where() + ": a coordinate is not a number");
        check_coordinate(path_, words_.lines().where(), *value);
        coordinates_.push_back(static_cast<float>(*value));
      }
    }
    expect("endloop");
    expect("endfacet");
  }

  const std::filesystem::path& path_;
  WordScanner words_;
  std::vector<float> coordinates_;
};

/// Binary files may begin with "solid" too. So the exact size of a binary file is tested first, and zero bytes, which
/// no text has, second.
bool is_text(std::string_view bytes) {
  if (bytes.size() >= kHeaderSize &&
      bytes.size() == kHeaderSize + kTriangleSize * std::uint64_t{base::number_at<std::uint32_t>(bytes, 80)}) {
    return false;
  }
  const std::size_t begin = bytes.find_first_not_of(" \t\r\n");
  if (begin == std::string_view::npos || bytes.find('\0') != std::string_view::npos) return false;
  const std::string_view first = bytes.substr(begin, 5);
  constexpr std::string_view kSolid = "solid";
  return std::equal(first.begin(), first.end(), kSolid.begin(), kSolid.end(), [](char x, char y) {
    return std::tolower(static_cast<unsigned char>(x)) == static_cast<unsigned char>(y);
  });
}

}  // namespace

VettedFile vetted_stl(const std::filesystem::path& path, std::string_view bytes) {
  return {is_text(bytes) ? TextStlReader(path, bytes).clean() : vetted_binary(path, bytes)};
}

}  // namespace glissade::geometry
