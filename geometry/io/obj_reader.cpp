#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/mesh_readers.h"
#include "io/mesh_warnings.h"
#include "io/plain_text.h"
#include "io/polygon_triangulation.h"
#include "io/text_scanner.h"

namespace glissade::geometry {
namespace {

/// Statements of the format that hold no surface: vectors for looks, lines and points, groups, materials, rendering,
/// and the types of curves.
constexpr std::array<std::string_view, 26> kSkipped{
    "vt",     "vn",     "vp",     "p",      "l",          "g",         "s",     "mg",       "o",
    "usemtl", "mtllib", "usemap", "maplib", "shadow_obj", "trace_obj", "bevel", "c_interp", "d_interp",
    "lod",    "ctech",  "stech",  "cstype", "deg",        "bmat",      "step",  "res"};

/// Statements of the format for curves, and for the bodies of curves and surfaces.
constexpr std::array<std::string_view, 10> kCurves{"curv", "curv2", "parm", "trim", "hole",
                                                   "scrv", "sp",    "end",  "con",  "cdc"};

/// Statements of the format for surfaces in another form than polygons, and for other files, which may hold some.
constexpr std::array<std::string_view, 5> kSurfaces{"surf", "bsp", "bzp", "cdp", "call"};

constexpr WarningKind kUnknown{"unknown statement is skipped", "unknown statements are skipped"};
constexpr WarningKind kCurve{"statement of a free-form curve is skipped", "statements of free-form curves are skipped"};
constexpr WarningKind kSmallFace{"face has fewer than 3 corners and is left out",
                                 "faces have fewer than 3 corners and are left out"};
constexpr WarningKind kVertexTail{"vertex is followed by more than a weight and a colour, which is skipped",
                                  "vertices are followed by more than a weight and a colour, which is skipped"};

template <std::size_t size>
bool is_among(const std::array<std::string_view, size>& statements, std::string_view word) {
  return std::find(statements.begin(), statements.end(), word) != statements.end();
}

bool is_face(std::string_view keyword) {
  return keyword == "f" || keyword == "fo";  // an older name
}

/// Whether the arguments of the statement are read.
bool is_read(std::string_view keyword) {
  return keyword == "v" || is_face(keyword);
}

bool is_keyword(std::string_view word) {
  return is_read(word) || is_among(kSkipped, word) || is_among(kCurves, word) || is_among(kSurfaces, word);
}

/// Cuts off a comment, which may follow every statement. Returns whether there was one.
bool cut_comment(std::vector<std::string_view>& words) {
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::size_t begin = words[i].find('#');
    if (begin == std::string_view::npos || is_old_nan(words[i])) continue;
    words[i] = words[i].substr(0, begin);
    words.resize(begin == 0 ? i : i + 1);
    return true;
  }
  return false;
}

/// Reads an OBJ file statement by statement.
class ObjReader {
 public:
  ObjReader(const MeshFile& file, std::string_view text)
      : file_(file), path_(file.path()), lines_(without_byte_order_mark(text)) {}

  TriangleSoup read() {
    while (next_statement()) {
      if (!words_.empty() && !is_continuation_) read_statement();
    }
    if (face_begins_.empty()) reject(path_, "the file has no faces of 3 corners or more");
    if (largest_index_ >= std::ssize(soup_.mesh.vertices)) {
      reject(path_, "line " + std::to_string(line_of_largest_) + ": the face uses vertex " +
                        std::to_string(largest_index_ + 1) + ", but the file has " +
                        std::to_string(soup_.mesh.vertices.size()));
    }
    add_faces();
    soup_.warnings = warnings_.sentences();
    return std::move(soup_);
  }

 private:
  std::string where() const { return "line " + std::to_string(line_); }

  /// Reads the words of the next line without its comment, and whether it ends in a backslash, which is no word.
  bool read_line(std::vector<std::string_view>& words) {
    ends_in_backslash_ = false;
    if (!lines_.next()) return false;
    split(lines_.line(), words);
    ends_in_backslash_ = !cut_comment(words) && !words.empty() && words.back().ends_with('\\');
    if (ends_in_backslash_) words.back().remove_suffix(1);
    if (!words.empty() && words.back().empty()) words.pop_back();
    return true;
  }

  /// Reads the words of the next statement; false at the end of the file. A vertex or a face goes on in the next line
  /// after a backslash. After any other statement, the backslash may also be the last letter of a name (of a folder),
  /// and the next line a statement. As such a statement is skipped, it does not matter which, unless that line begins
  /// with a keyword.
  bool next_statement() {
    const bool may_go_on = ends_in_backslash_;
    if (!read_line(words_)) return false;
    line_ = lines_.number();
    is_continuation_ = may_go_on && !words_.empty() && !is_keyword(words_[0]);
    if (words_.empty() || !is_read(words_[0])) return true;
    while (ends_in_backslash_) {
      if (!read_line(more_words_)) reject(path_, where() + ": the file ends where the line should go on");
      words_.insert(words_.end(), more_words_.begin(), more_words_.end());
    }
    return true;
  }

  void read_statement() {
    const std::string_view keyword = words_[0];
    if (keyword == "v") {
      read_vertex();
    } else if (is_face(keyword)) {
      read_face();
    } else if (is_among(kSurfaces, keyword)) {
      reject(path_,
             where() + ": the statement '" + std::string(keyword) + "' is not supported, only points and polygons are");
    } else if (is_among(kCurves, keyword)) {
      warnings_.add(kCurve, where() + ", '" + std::string(keyword) + "'");
    } else if (!is_among(kSkipped, keyword)) {
      warnings_.add(kUnknown, where() + ", '" + printable(lines_.line()) + "'");
    }
  }

  void read_vertex() {
    if (words_.size() < 4) {
      reject(path_, where() + ": a vertex needs 3 coordinates, but has " + std::to_string(words_.size() - 1));
    }
    Eigen::Vector3d point;
    for (std::size_t i = 1; i < 4; ++i) {
      const auto value = parse_number(words_[i]);
      if (!value) reject(path_, where() + ": '" + printable(words_[i]) + "' is not a number");
      point[static_cast<Eigen::Index>(i - 1)] = *value;
    }
    // A weight, or a colour and its opacity, may follow.
    constexpr std::size_t kMostNumbers = 7;
    const auto is_number = [](std::string_view word) { return parse_number(word).has_value(); };
    if (words_.size() > 1 + kMostNumbers || !std::all_of(words_.begin() + 4, words_.end(), is_number)) {
      warnings_.add(kVertexTail, where());
    }
    if (bad_coordinate(point)) line_of_bad_vertex_[std::ssize(soup_.mesh.vertices)] = line_;
    soup_.mesh.vertices.push_back(point);
  }

  void read_face() {
    const std::size_t count = words_.size() - 1;
    if (count > kMostCorners) {
      reject(path_, where() + ": a face of " + std::to_string(count) + " corners, at most " +
                        std::to_string(kMostCorners) + " are supported");
    }
    const std::size_t begin = corners_.size();
    for (std::size_t i = 1; i < words_.size(); ++i) {
      const std::int64_t index = index_of_corner(words_[i]);
      if (count >= 3) corners_.push_back(counted_from_0(index));
    }
    if (count < 3) {
      warnings_.add(kSmallFace, where());
      return;
    }
    face_begins_.push_back(begin);
    const std::int32_t largest =
        *std::max_element(corners_.begin() + static_cast<std::ptrdiff_t>(begin), corners_.end());
    if (largest > largest_index_) {
      largest_index_ = largest;
      line_of_largest_ = line_;
    }
  }

  void add_faces() {
    const std::span<const std::int32_t> corners(corners_);
    for (std::size_t f = 0; f < face_begins_.size(); ++f) {
      const std::size_t end = f + 1 < face_begins_.size() ? face_begins_[f + 1] : corners_.size();
      const std::span<const std::int32_t> polygon = corners.subspan(face_begins_[f], end - face_begins_[f]);
      for (const std::int32_t corner : polygon) {
        const std::optional<double> bad = bad_coordinate(soup_.mesh.vertices[static_cast<std::size_t>(corner)]);
        if (!bad) continue;
        const std::string line = std::to_string(line_of_bad_vertex_.at(corner));
        reject_coordinate(path_, "line " + line + ", a vertex of a face", *bad);
      }
      add_polygon(file_, polygon, soup_);
    }
  }

  /// The vertex index of a corner `vertex`, `vertex/texture`, `vertex//normal` or `vertex/texture/normal`.
  std::int64_t index_of_corner(std::string_view word) const {
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
    return *index;
  }

  /// Negative indices count backwards from the newest vertex.
  std::int32_t counted_from_0(std::int64_t index) const {
    const std::int64_t count = std::ssize(soup_.mesh.vertices);
    const std::int64_t absolute = index < 0 ? count + 1 + index : index;
    if (index == 0 || absolute < 1 || absolute > std::numeric_limits<std::int32_t>::max()) {
      reject(path_, where() + ": the vertex index " + std::to_string(index) + " is out of range, with " +
                        std::to_string(count) + " vertices before it");
    }
    return static_cast<std::int32_t>(absolute - 1);
  }

  const MeshFile& file_;
  const std::filesystem::path& path_;
  LineScanner lines_;
  std::int64_t line_ = 0;  // where the statement begins
  std::vector<std::string_view> words_;
  std::vector<std::string_view> more_words_;  // of a line that continues a statement
  bool ends_in_backslash_ = false;            // the line read last
  bool is_continuation_ = false;              // the line of words_, of a skipped statement
  std::vector<std::int32_t> corners_;         // of all faces, counted from 0
  std::vector<std::size_t> face_begins_;      // within corners_
  // Positive indices may point forward, so they are checked at the end.
  std::int32_t largest_index_ = -1;
  std::int64_t line_of_largest_ = 0;
  std::map<std::int64_t, std::int64_t> line_of_bad_vertex_;
  MeshWarnings warnings_;
  TriangleSoup soup_;
};

}  // namespace

TriangleSoup read_obj(MeshFile& file) {
  const std::string text = file.content();
  reject_utf16(file.path(), text);
  return ObjReader(file, text).read();
}

}  // namespace glissade::geometry
