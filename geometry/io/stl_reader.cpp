#include <algorithm>
#include <cctype>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include <glissade/base/byte_order.h>

#include "io/mesh_readers.h"
#include "io/text_scanner.h"

namespace glissade::geometry {
namespace {

constexpr std::size_t kHeaderSize = 84;
constexpr std::size_t kTriangleSize = 50;

/// As much of the file as shows whether it is text.
constexpr std::uint64_t kBeginning = 4096;

/// Adds a triangle of the three newest vertices.
void add_triangle_of_newest_vertices(TriangleMesh& mesh) {
  const auto count = static_cast<std::int32_t>(mesh.vertices.size());
  mesh.triangles.push_back({count - 3, count - 2, count - 1});
}

bool equal_ignoring_case(std::string_view a, std::string_view lower_case) {
  return std::equal(a.begin(), a.end(), lower_case.begin(), lower_case.end(),
                    [](char x, char y) { return std::tolower(static_cast<unsigned char>(x)) == y; });
}

/// The size of a binary file with as many triangles as the header says; 0 without a whole header.
std::uint64_t binary_size(std::string_view beginning) {
  if (beginning.size() < kHeaderSize) return 0;
  return kHeaderSize + kTriangleSize * std::uint64_t{base::number_at<std::uint32_t>(beginning, 80)};
}

/// Binary files may begin with "solid" too. So the exact size of a binary file is tested first, and zero bytes, which
/// no text has, second.
bool is_text(std::string_view beginning, std::uint64_t file_size) {
  if (file_size == binary_size(beginning)) return false;
  const std::string_view text = without_byte_order_mark(beginning);
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  if (begin == std::string_view::npos || text.find('\0') != std::string_view::npos) return false;
  return equal_ignoring_case(text.substr(begin, 5), "solid");
}

void check_binary_size(const MeshFile& file, std::string_view beginning) {
  const std::string size = std::to_string(file.size());
  if (beginning.size() < kHeaderSize) {
    reject(file.path(), "The file is truncated: it has " + size + " bytes, an STL header has 84");
  }
  const std::uint64_t expected = binary_size(beginning);
  const std::uint32_t count = base::number_at<std::uint32_t>(beginning, 80);
  if (file.size() != expected) {
    reject(file.path(), std::string(file.size() < expected ? "The file is truncated" : "The file is too long") +
                            ": it has " + size + " bytes, but " + std::to_string(count) + " triangles take " +
                            std::to_string(expected));
  }
  if (count == 0) reject(file.path(), "The file has no triangles");
}

TriangleMesh read_binary(const MeshFile& file, std::string_view bytes) {
  const std::size_t count = (bytes.size() - kHeaderSize) / kTriangleSize;
  TriangleMesh mesh;
  mesh.vertices.reserve(3 * count);
  mesh.triangles.reserve(count);
  for (std::size_t t = 0; t < count; ++t) {
    const std::size_t begin = kHeaderSize + kTriangleSize * t + 12;  // after the normal
    for (std::size_t corner = 0; corner < 3; ++corner) {
      Eigen::Vector3d& vertex = mesh.vertices.emplace_back();
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto value = static_cast<double>(base::number_at<float>(bytes, begin + 12 * corner + 4 * axis));
        if (!is_coordinate(value)) reject_coordinate(file.path(), "triangle " + std::to_string(t), value);
        vertex[static_cast<Eigen::Index>(axis)] = value;
      }
    }
    add_triangle_of_newest_vertices(mesh);
  }
  return mesh;
}

/// Reads a text STL file word by word.
class TextStlReader {
 public:
  TextStlReader(const std::filesystem::path& path, std::string_view text)
      : path_(path), words_(without_byte_order_mark(text)) {}

  TriangleMesh read() {
    while (words_.has_word()) {
      read_solid();
    }
    if (mesh_.triangles.empty()) reject(path_, "The file has no triangles");
    return std::move(mesh_);
  }

 private:
  std::string where() const { return words_.lines().where(); }

  std::string_view word(std::string_view expected) {
    if (!words_.has_word()) {
      reject(path_, where() + ": the file is truncated, '" + std::string(expected) + "' should follow");
    }
    return words_.word();
  }

  void expect(std::string_view expected) {
    if (!equal_ignoring_case(word(expected), expected)) {
      reject(path_, where() + ": '" + std::string(expected) + "' should stand here");
    }
  }

  void read_solid() {
    expect("solid");
    words_.skip_line();  // the rest of the line is a name
    while (true) {
      const std::string_view keyword = word("endsolid");
      if (equal_ignoring_case(keyword, "endsolid")) break;
      if (!equal_ignoring_case(keyword, "facet")) {
        reject(path_, where() + ": 'facet' or 'endsolid' should stand here");
      }
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
      Eigen::Vector3d& vertex = mesh_.vertices.emplace_back();
      for (double& coordinate : vertex) {
        const auto value = parse_number(word("a coordinate"));
        if (!value) reject(path_, where() + ": a coordinate is not a number");
        if (!is_coordinate(*value)) reject_coordinate(path_, where(), *value);
        coordinate = *value;
      }
    }
    expect("endloop");
    expect("endfacet");
    add_triangle_of_newest_vertices(mesh_);
  }

  const std::filesystem::path& path_;
  WordScanner words_;
  TriangleMesh mesh_;
};

}  // namespace

TriangleSoup read_stl(MeshFile& file) {
  const std::string beginning = file.beginning(kBeginning);
  const bool as_text = is_text(beginning, file.size());
  if (!as_text) check_binary_size(file, beginning);
  const std::string content = file.content();
  return {as_text ? TextStlReader(file.path(), content).read() : read_binary(file, content)};
}

}  // namespace glissade::geometry
