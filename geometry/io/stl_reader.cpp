#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include <glissade/base/byte_order.h>

#include "io/mesh_readers.h"
#include "io/mesh_warnings.h"
#include "io/plain_text.h"
#include "io/text_scanner.h"

namespace glissade::geometry {
namespace {

constexpr std::size_t kHeaderSize = 84;
constexpr std::size_t kTriangleSize = 50;

/// As much of the file as shows whether it is text.
constexpr std::uint64_t kBeginning = 4096;

constexpr WarningKind kTail{"byte after the last triangle is skipped", "bytes after the last triangle are skipped"};
constexpr WarningKind kUnknownLine{"unknown statement is skipped", "unknown statements are skipped"};
constexpr WarningKind kOutside{"facet is outside of every solid", "facets are outside of every solid"};
constexpr WarningKind kOpenFacet{"facet lacks its 'endloop' or 'endfacet'", "facets lack 'endloop' or 'endfacet'"};
constexpr WarningKind kOpenSolid{"solid begins before the one before it has ended",
                                 "solids begin before the ones before them have ended"};
constexpr WarningKind kNoEnd{"'endsolid' is missing at the end of the file, which may have been cut off", ""};

/// Adds a triangle of the three newest vertices.
void add_triangle_of_newest_vertices(TriangleMesh& mesh) {
  const auto count = static_cast<std::int32_t>(mesh.vertices.size());
  mesh.triangles.push_back({count - 3, count - 2, count - 1});
}

char lower_case(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(), [](char c) { return lower_case(c); });
  return lower;
}

bool equal_ignoring_case(std::string_view a, std::string_view lower) {
  return std::equal(a.begin(), a.end(), lower.begin(), lower.end(), [](char x, char y) { return lower_case(x) == y; });
}

/// The size of a binary file of so many triangles.
std::uint64_t binary_size(std::uint64_t triangles) {
  return kHeaderSize + kTriangleSize * triangles;
}

std::uint32_t count_in_header(std::string_view beginning) {
  return base::number_at<std::uint32_t>(beginning, kHeaderSize - 4);
}

/// Binary files may begin with "solid" too. So the exact size of a binary file is tested first. One of a wrong size has
/// a zero byte at the latest in its count of triangles, if this is below 16 million. A text that zero bytes have
/// damaged is known by its keywords.
bool is_text(std::string_view beginning, std::uint64_t file_size) {
  if (beginning.size() >= kHeaderSize && file_size == binary_size(count_in_header(beginning))) return false;
  if (beginning.find('\0') == std::string_view::npos || is_utf16(beginning)) return true;
  const std::string text = lower_case(beginning);
  return text.find("facet") != std::string::npos && text.find("vertex") != std::string::npos;
}

/// Rejects a binary file that is too short for its count of triangles, or has room for more.
void check_binary_size(const MeshFile& file, std::string_view beginning) {
  const std::string size = std::to_string(file.size()) + " bytes";
  if (beginning.size() < kHeaderSize) {
    reject(file.path(),
           "the file is not text, and as a binary STL it is truncated: it has " + size + ", the header alone has 84");
  }
  const std::uint32_t count = count_in_header(beginning);
  const std::uint64_t room = (file.size() - kHeaderSize) / kTriangleSize;
  const std::string promise = "its header says " + std::to_string(count) + " triangles, which take " +
                              std::to_string(binary_size(count)) + " bytes, but it has " + size + ", enough for " +
                              std::to_string(room);
  if (room < count) reject(file.path(), "the file is not text, and as a binary STL it is truncated: " + promise);
  if (room > count) reject(file.path(), "the file is too long for a binary STL: " + promise);
  if (count == 0) reject(file.path(), "the file has no triangles");
}

TriangleSoup read_binary(const MeshFile& file, std::string_view bytes) {
  const std::size_t count = count_in_header(bytes);
  TriangleSoup soup;
  TriangleMesh& mesh = soup.mesh;
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
  MeshWarnings warnings;
  const std::uint64_t end = binary_size(count);
  if (bytes.size() > end) {
    warnings.add(kTail, "byte " + std::to_string(end), static_cast<std::int64_t>(bytes.size() - end));
  }
  soup.warnings = warnings.sentences();
  return soup;
}

/// Reads a text STL file word by word: its facets, wherever lines end. Nothing else in it holds surface.
class TextStlReader {
 public:
  TextStlReader(const std::filesystem::path& path, std::string_view text)
      : path_(path), words_(without_byte_order_mark(text)) {}

  TriangleSoup read() {
    while (words_.has_word()) {
      read_statement();
    }
    if (soup_.mesh.triangles.empty()) reject(path_, "the file has no triangles");
    if (is_in_solid_) warnings_.add(kNoEnd, where());
    soup_.warnings = warnings_.sentences();
    return std::move(soup_);
  }

 private:
  std::string where() const { return words_.lines().where(); }

  /// The next word, in lower case; "end loop" is one.
  static std::string keyword(WordScanner& words) {
    std::string keyword = lower_case(words.word());
    if (keyword == "end" && words.has_word_in_line()) keyword += lower_case(words.word());
    return keyword;
  }

  /// Reads the letters, which may stand in several words; false, and nothing is read, if others follow.
  bool take(std::string_view letters) {
    WordScanner ahead = words_;
    while (!letters.empty()) {
      if (!ahead.has_word()) return false;
      const std::string_view word = ahead.word();
      if (!equal_ignoring_case(word, letters.substr(0, word.size()))) return false;
      letters.remove_prefix(word.size());
    }
    words_ = ahead;
    return true;
  }

  [[noreturn]] void reject_instead_of(const std::string& expected) {
    if (!words_.has_word()) reject(path_, where() + ": the file is truncated, '" + expected + "' should follow");
    reject(path_, where() + ": '" + expected + "' should stand here");
  }

  void read_statement() {
    const std::string word(words_.rest_of_line().substr(0, words_.rest_of_line().find_first_of(kBlanks)));
    const std::string keyword = this->keyword(words_);
    if (keyword.starts_with("facet")) {
      if (!is_in_solid_) warnings_.add(kOutside, where());
      read_facet();
    } else if (keyword.starts_with("endsolid")) {  // the name may follow without a blank
      skip_name();
      is_in_solid_ = words_.has_word_in_line();  // another one has begun in the same line
    } else if (keyword.starts_with("solid")) {
      if (is_in_solid_) warnings_.add(kOpenSolid, where());
      is_in_solid_ = true;
      skip_name();
    } else if (keyword == "outer" || keyword == "vertex" || keyword == "endloop" || keyword == "endfacet") {
      reject(path_, where() + ": '" + word + "' stands outside of a facet");
    } else {
      warnings_.add(kUnknownLine, where() + ", '" + printable(word) + "'");
      skip_name();
    }
  }

  /// Skips the rest of the line, or the words before the next facet if the file has no lines.
  void skip_name() {
    while (words_.has_word_in_line()) {
      WordScanner ahead = words_;
      if (equal_ignoring_case(ahead.word(), "facet") && ahead.has_word() && equal_ignoring_case(ahead.word(), "normal"))
        return;
      words_.word();
    }
  }

  /// After "facet". The normal is not needed, and often not a number for slivers.
  void read_facet() {
    while (!take("outerloop")) {
      WordScanner ahead = words_;
      const std::string word = ahead.has_word() ? keyword(ahead) : "";
      if (word.empty() || word == "vertex" || is_end_of_facet(word)) reject_instead_of("outer loop");
      words_ = ahead;
    }
    for (int i = 0; i < 3; ++i) {
      if (!take("vertex")) reject_instead_of("vertex");
      read_vertex();
    }
    bool is_closed = true;
    for (const char* end : {"endloop", "endfacet"}) {
      if (take(end)) continue;
      WordScanner ahead = words_;
      if (!ahead.has_word() || !is_end_of_facet(keyword(ahead))) reject_instead_of(end);
      is_closed = false;
    }
    if (!is_closed) warnings_.add(kOpenFacet, where());
    add_triangle_of_newest_vertices(soup_.mesh);
  }

  static bool is_end_of_facet(std::string_view keyword) {
    return keyword == "endloop" || keyword == "endfacet" || keyword.starts_with("facet") ||
           keyword.starts_with("endsolid") || keyword.starts_with("solid");
  }

  void read_vertex() {
    Eigen::Vector3d& vertex = soup_.mesh.vertices.emplace_back();
    for (double& coordinate : vertex) {
      if (!words_.has_word()) reject_instead_of("a coordinate");
      const auto value = parse_number(words_.word());
      if (!value) reject(path_, where() + ": a coordinate is not a number");
      if (!is_coordinate(*value)) reject_coordinate(path_, where(), *value);
      coordinate = *value;
    }
  }

  const std::filesystem::path& path_;
  WordScanner words_;
  bool is_in_solid_ = false;
  MeshWarnings warnings_;
  TriangleSoup soup_;
};

}  // namespace

TriangleSoup read_stl(MeshFile& file) {
  const std::string beginning = file.beginning(kBeginning);
  const bool as_text = is_text(beginning, file.size());
  if (!as_text) check_binary_size(file, beginning);
  const std::string content = file.content();
  if (!as_text) return read_binary(file, content);
  reject_zero_bytes(file.path(), content);
  return TextStlReader(file.path(), content).read();
}

}  // namespace glissade::geometry
