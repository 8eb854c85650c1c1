#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <vector>

#include "io/mesh_validation.h"
#include "io/polygon_triangulation.h"
#include "io/text_scanner.h"

namespace glissade::geometry {
namespace {

/// Reads an OBJ file statement by statement and writes its vertices and faces anew.
class ObjReader {
 public:
  ObjReader(const std::filesystem::path& path, std::string_view bytes) : path_(path), lines_(bytes) {}

  VettedFile clean() {
    while (next_statement()) {
      if (words_.empty() || words_[0].starts_with('#')) continue;
      if (words_[0] == "v") {
        read_vertex();
      } else if (words_[0] == "f") {
        read_face();
      } else if (std::any_of(words_[0].begin(), words_[0].end(), [](char c) { return c >= 0 && c < ' '; })) {
        reject(path_, where_ + ": this is not text");
      }
      // All other statements are skipped, because they hold no polygons: normals, groups, materials, curves, and
      // extensions of exporters.
    }
    if (face_begins_.empty()) reject(path_, "The file has no faces");
    if (largest_index_ > static_cast<std::int64_t>(vertices_.size())) {
      reject(path_, where_of_largest_ + ": the face uses vertex " + std::to_string(largest_index_) +
                        ", but the file has " + std::to_string(vertices_.size()));
    }
    write_faces();
    return std::move(output_);
  }

 private:
  /// Reads the words of the next line, joined with its continuations after a backslash; false at the end of the file.
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
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
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
      if (i <= 3) {  // further values are a weight or a colour
        check_coordinate(path_, where_, *value);
        point[i - 1] = *value;
      }
    }
    std::array<char, 96> line{};
    const int length = std::snprintf(line.data(), line.size(), "v %.9g %.9g %.9g\n", point[0], point[1], point[2]);
    output_.bytes.append(line.data(), static_cast<std::size_t>(length));
    vertices_.emplace_back(point[0], point[1], point[2]);
  }

  void read_face() {
    if (words_.size() < 4) {
      reject(path_, where_ + ": a face needs at least 3 corners, but has " + std::to_string(words_.size() - 1));
    }
    if (words_.size() - 1 > kMostCorners) {
      reject(path_, where_ + ": a face of " + std::to_string(words_.size() - 1) + " corners, at most " +
                        std::to_string(kMostCorners) + " are supported");
    }
    face_begins_.push_back(corners_.size());
    for (std::size_t i = 1; i < words_.size(); ++i) {
      const std::int64_t index = corner(words_[i]);
      if (index > largest_index_) {
        largest_index_ = index;
        where_of_largest_ = where_;
      }
      corners_.push_back(index);
    }
  }

  void write_faces() {
    std::vector<Eigen::Vector3d> points;
    for (std::size_t f = 0; f < face_begins_.size(); ++f) {
      const std::size_t begin = face_begins_[f];
      const std::size_t end = f + 1 < face_begins_.size() ? face_begins_[f + 1] : corners_.size();
      points.clear();
      for (std::size_t i = begin; i < end; ++i) {
        points.push_back(vertices_[static_cast<std::size_t>(corners_[i] - 1)]);
      }
      if (points.size() > 3) ++output_.polygons_triangulated;
      for (const auto& triangle : triangulated(points)) {
        output_.bytes += 'f';
        for (const std::size_t corner : triangle) {
          output_.bytes += ' ' + std::to_string(corners_[begin + corner]);
        }
        output_.bytes += '\n';
      }
    }
  }

  /// The vertex index, counted from 1, of a corner `vertex`, `vertex/texture`, `vertex//normal` or
  /// `vertex/texture/normal`.
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
    const auto count = static_cast<std::int64_t>(vertices_.size());
    const std::int64_t absolute = *index < 0 ? count + 1 + *index : *index;
    if (*index == 0 || absolute < 1 || absolute > std::numeric_limits<std::int32_t>::max()) {
      reject(path_, where_ + ": the vertex index " + std::to_string(*index) + " is out of range, with " +
                        std::to_string(count) + " vertices before it");
    }
    return absolute;
  }

  const std::filesystem::path& path_;
  LineScanner lines_;
  std::string joined_;
  std::string where_;
  std::vector<std::string_view> words_;
  std::vector<Eigen::Vector3d> vertices_;
  std::vector<std::int64_t> corners_;     // of all faces, counted from 1
  std::vector<std::size_t> face_begins_;  // within corners_
  // Positive indices may point forward, so they are checked at the end.
  std::int64_t largest_index_ = 0;
  std::string where_of_largest_;
  VettedFile output_;
};

}  // namespace

VettedFile vetted_obj(const std::filesystem::path& path, std::string_view bytes) {
  return ObjReader(path, bytes).clean();
}

}  // namespace glissade::geometry
