#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <vector>

#include "mesh_validation.h"
#include "text_scanner.h"

namespace glissade::collision {
namespace {

// Statements of the format that carry no polygons.
constexpr std::array<std::string_view, 38> kIgnored{
    "vt",   "vn",   "vp",     "l",    "p",    "g",    "o",    "s",        "mg",       "usemtl",     "mtllib",     "usemap", "maplib",
    "deg",  "bmat", "step",   "cstype", "curv", "curv2", "surf", "parm",  "trim",     "hole",       "scrv",       "sp",     "end",
    "con",  "bevel", "c_interp", "d_interp", "lod", "shadow_obj", "trace_obj", "ctech", "stech", "call", "csh", "fo"};

/// Reads an OBJ file statement by statement and writes its vertices and faces anew.
class ObjReader {
 public:
  ObjReader(const std::filesystem::path& path, std::string_view bytes) : path_(path), lines_(bytes) {}

  std::string clean() {
    while (next_statement()) {
      if (words_.empty() || words_[0].starts_with('#')) continue;
      if (words_[0] == "v") {
        read_vertex();
      } else if (words_[0] == "f") {
        read_face();
      } else if (std::find(kIgnored.begin(), kIgnored.end(), words_[0]) == kIgnored.end()) {
        reject(path_, where_ + ": unknown statement '" + printable(words_[0]) + "'");
      }
    }
    if (!has_face_) reject(path_, "The file has no faces");
    if (largest_index_ > vertices_) {
      reject(path_, where_of_largest_ + ": the face uses vertex " + std::to_string(largest_index_) +
                        ", but the file has " + std::to_string(vertices_));
    }
    return std::move(output_);
  }

 private:
  /// The words of the next line, joined with the lines that a backslash at its end adds.
  bool next_statement() {
    if (!lines_.next()) return false;
    where_ = lines_.where();
    if (!lines_.line().ends_with('\\')) {
      split(lines_.line(), words_);
      return true;
    }
    joined_ = lines_.line();
    while (joined_.ends_with('\\')) {
      joined_.back() = ' ';
      if (!lines_.next()) reject(path_, where_ + ": the file ends where the line should go on");
      joined_ += lines_.line();
    }
    split(joined_, words_);
    return true;
  }

  static std::string printable(std::string_view word) {
    std::string text(word.substr(0, 40));
    std::replace_if(text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
    return text;
  }

  void read_vertex() {
    if (words_.size() < 4 || words_.size() > 8) {
      reject(path_, where_ + ": a vertex needs 3 coordinates, but has " + std::to_string(words_.size() - 1));
    }
    std::array<double, 3> point{};
    for (std::size_t i = 1; i < words_.size(); ++i) {
      const auto value = parse_number(words_[i]);
      if (!value) reject(path_, where_ + ": '" + printable(words_[i]) + "' is not a number");
      if (i <= 3) {  // what follows is a weight or a colour
        check_coordinate(path_, where_, *value);
        point[i - 1] = *value;
      }
    }
    std::array<char, 96> line{};
    const int length = std::snprintf(line.data(), line.size(), "v %.9g %.9g %.9g\n", point[0], point[1], point[2]);
    output_.append(line.data(), static_cast<std::size_t>(length));
    ++vertices_;
  }

  void read_face() {
    if (words_.size() < 4) {
      reject(path_, where_ + ": a face needs at least 3 corners, but has " + std::to_string(words_.size() - 1));
    }
    output_ += 'f';
    for (std::size_t i = 1; i < words_.size(); ++i) {
      const std::int64_t index = corner(words_[i]);
      if (index > largest_index_) {
        largest_index_ = index;
        where_of_largest_ = where_;
      }
      output_ += ' ' + std::to_string(index);
    }
    output_ += '\n';
    has_face_ = true;
  }

  /// The vertex of `vertex`, `vertex/texture`, `vertex//normal` or `vertex/texture/normal`, counted from 1.
  std::int64_t corner(std::string_view word) const {
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
    if (!is_good) reject(path_, where_ + ": '" + printable(word) + "' is not a corner of a face");
    // Negative indices count backwards from the newest vertex.
    const std::int64_t absolute = *index < 0 ? vertices_ + 1 + *index : *index;
    if (*index == 0 || absolute < 1 || absolute > std::numeric_limits<std::int32_t>::max()) {
      reject(path_, where_ + ": the vertex index " + std::to_string(*index) + " is out of range, with " +
                        std::to_string(vertices_) + " vertices before it");
    }
    return absolute;
  }

  const std::filesystem::path& path_;
  LineScanner lines_;
  std::string joined_;
  std::string where_;
  std::vector<std::string_view> words_;
  std::int64_t vertices_ = 0;
  // Positive indices may point forward, so they are checked at the end.
  std::int64_t largest_index_ = 0;
  std::string where_of_largest_;
  bool has_face_ = false;
  std::string output_;
};

}  // namespace

std::string vetted_obj(const std::filesystem::path& path, std::string_view bytes) {
  return ObjReader(path, bytes).clean();
}

}  // namespace glissade::collision
