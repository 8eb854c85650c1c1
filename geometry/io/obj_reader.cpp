#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "io/mesh_readers.h"
#include "io/polygon_triangulation.h"
#include "io/text_scanner.h"

namespace glissade::geometry {
namespace {

/// Statements of the format that hold no polygons: vectors for looks, lines and points, groups, materials, rendering,
/// and the types of curves.
constexpr std::array<std::string_view, 26> kSkipped{
    "vt",     "vn",     "vp",     "p",      "l",          "g",         "s",     "mg",       "o",
    "usemtl", "mtllib", "usemap", "maplib", "shadow_obj", "trace_obj", "bevel", "c_interp", "d_interp",
    "lod",    "ctech",  "stech",  "cstype", "deg",        "bmat",      "step",  "res"};

/// Statements of the format that hold geometry in another form than points and polygons: curves and surfaces with their
/// bodies, other files and commands, and the superseded forms of patches and faces.
constexpr std::array<std::string_view, 17> kNotSupported{"curv", "curv2", "surf", "parm", "trim", "hole",
                                                         "scrv", "sp",    "end",  "con",  "call", "csh",
                                                         "bsp",  "bzp",   "cdc",  "cdp",  "fo"};

template <std::size_t size>
bool is_among(const std::array<std::string_view, size>& statements, std::string_view word) {
  return std::find(statements.begin(), statements.end(), word) != statements.end();
}

/// Reads an OBJ file statement by statement.
class ObjReader {
 public:
  ObjReader(const MeshFile& file, std::string_view text)
      : file_(file), path_(file.path()), lines_(without_byte_order_mark(text)) {}

  TriangleSoup read() {
    while (next_statement()) {
      if (words_.empty() || words_[0].starts_with('#') || is_among(kSkipped, words_[0])) continue;
      if (words_[0] == "v") {
        read_vertex();
      } else if (words_[0] == "f") {
        read_face();
      } else if (is_among(kNotSupported, words_[0])) {
        reject(path_, where() + ": the statement '" + std::string(words_[0]) +
                          "' is not supported, only points and polygons are");
      } else if (parse_number(words_[0])) {
        // To skip it might lose a vertex whose keyword was lost.
        reject(path_,
               where() + ": the line begins with the number " + printable(words_[0]) +
                   ", but a statement of the format begins with a keyword such as v or f; if it is a count, remove "
                   "the line");
      } else {
        reject(path_, where() + ": '" + printable(words_[0]) + "' is not a statement of the format");
      }
    }
    if (face_begins_.empty()) reject(path_, "The file has no faces");
    if (largest_index_ >= std::ssize(soup_.mesh.vertices)) {
      reject(path_, "line " + std::to_string(line_of_largest_) + ": the face uses vertex " +
                        std::to_string(largest_index_ + 1) + ", but the file has " +
                        std::to_string(soup_.mesh.vertices.size()));
    }
    add_faces();
    return std::move(soup_);
  }

 private:
  std::string where() const { return "line " + std::to_string(line_); }

  /// Reads the words of the next line, joined with its continuations after a backslash; false at the end of the file.
  /// A comment has no continuation: it may end in the name of a folder.
  bool next_statement() {
    if (!lines_.next()) return false;
    line_ = lines_.number();
    split(lines_.line(), words_);
    if (!lines_.line().ends_with('\\') || words_[0].starts_with('#')) return true;
    joined_ = lines_.line();
    while (joined_.ends_with('\\')) {
      joined_.back() = ' ';
      if (!lines_.next()) reject(path_, where() + ": the file ends where the line should go on");
      joined_ += lines_.line();
    }
    split(joined_, words_);
    return true;
  }

  static std::string printable(std::string_view word) {
    std::string text(word.substr(0, 40));
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
    return text;
  }

  void read_vertex() {
    if (words_.size() < 4 || words_.size() > 8) {
      reject(path_, where() + ": a vertex needs 3 coordinates, but has " + std::to_string(words_.size() - 1));
    }
    std::array<double, 3> point{};
    for (std::size_t i = 1; i < words_.size(); ++i) {
      const auto value = parse_number(words_[i]);
      if (!value) reject(path_, where() + ": '" + printable(words_[i]) + "' is not a number");
      if (i <= 3) {  // further values are a weight or a colour
        if (!is_coordinate(*value)) reject_coordinate(path_, where(), *value);
        point[i - 1] = *value;
      }
    }
    soup_.mesh.vertices.emplace_back(point[0], point[1], point[2]);
  }

  void read_face() {
    if (words_.size() < 4) {
      reject(path_, where() + ": a face needs at least 3 corners, but has " + std::to_string(words_.size() - 1));
    }
    if (words_.size() - 1 > kMostCorners) {
      reject(path_, where() + ": a face of " + std::to_string(words_.size() - 1) + " corners, at most " +
                        std::to_string(kMostCorners) + " are supported");
    }
    face_begins_.push_back(corners_.size());
    for (std::size_t i = 1; i < words_.size(); ++i) {
      const std::int32_t index = corner(words_[i]);
      if (index > largest_index_) {
        largest_index_ = index;
        line_of_largest_ = line_;
      }
      corners_.push_back(index);
    }
  }

  void add_faces() {
    const std::span<const std::int32_t> corners(corners_);
    for (std::size_t f = 0; f < face_begins_.size(); ++f) {
      const std::size_t end = f + 1 < face_begins_.size() ? face_begins_[f + 1] : corners_.size();
      add_polygon(file_, corners.subspan(face_begins_[f], end - face_begins_[f]), soup_);
    }
  }

  /// The vertex index, counted from 0, of a corner `vertex`, `vertex/texture`, `vertex//normal` or
  /// `vertex/texture/normal`.
  std::int32_t corner(std::string_view word) const {
    const std::size_t end = std::min(word.find('/'), word.size());
    const auto index = parse_integer(word.substr(0, end));
    bool is_good = index.has_value();
    int slashes = 0;
    for (std::size_t begin = end; begin < word.size();) {
      const std::size_t next = std::min(word.find('/', begin + 1), word.size());
      const std::string_view part = word.substr(begin + 1, next - begin - 1);
      is_good = is_good && ++slashes <= 2 && (part.empty() || parse_integer(part).has_value());
      begin = next;
    }
    if (!is_good) reject(path_, where() + ": '" + printable(word) + "' is not a corner of a face");
    // Negative indices count backwards from the newest vertex.
    const std::int64_t count = std::ssize(soup_.mesh.vertices);
    const std::int64_t absolute = *index < 0 ? count + 1 + *index : *index;
    if (*index == 0 || absolute < 1 || absolute > std::numeric_limits<std::int32_t>::max()) {
      reject(path_, where() + ": the vertex index " + std::to_string(*index) + " is out of range, with " +
                        std::to_string(count) + " vertices before it");
    }
    return static_cast<std::int32_t>(absolute - 1);
  }

  const MeshFile& file_;
  const std::filesystem::path& path_;
  LineScanner lines_;
  std::int64_t line_ = 0;  // where the statement begins
  std::string joined_;
  std::vector<std::string_view> words_;
  std::vector<std::int32_t> corners_;     // of all faces, counted from 0
  std::vector<std::size_t> face_begins_;  // within corners_
  // Positive indices may point forward, so they are checked at the end.
  std::int32_t largest_index_ = -1;
  std::int64_t line_of_largest_ = 0;
  TriangleSoup soup_;
};

}  // namespace

TriangleSoup read_obj(MeshFile& file) {
  const std::string text = file.content();
  return ObjReader(file, text).read();
}

}  // namespace glissade::geometry
