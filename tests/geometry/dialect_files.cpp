#include "dialect_files.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <vector>

#include "mesh_files.h"
#include "random_numbers.h"

namespace glissade::geometry {
namespace {

/// What the writers of all formats choose: numbers, blanks and ends of lines.
class DialectWriter {
 public:
  DialectWriter(const TriangleMesh& mesh, std::uint64_t seed) : mesh_(mesh), random_(seed) {
    number_format_ = one_of({"%.17g", "%.17e", "%+.17g", "%.20f"});
    line_end_ = one_of({"\n", "\n", "\r\n", "\r", " \n"});
    blank_ = one_of({" ", "  ", "\t"});
    indent_ = one_of({"", "", "  ", "\t"});
  }

 protected:
  bool maybe(double chance = 0.3) { return random_.chance(chance); }

  std::string one_of(std::initializer_list<const char*> texts) {
    return texts.begin()[random_.integer(0, static_cast<int>(texts.size()) - 1)];
  }

  /// One of the texts, and thereby a warning.
  std::string warned(std::initializer_list<const char*> texts) {
    file_.has_warning = true;
    return one_of(texts);
  }

  std::string number(double value) const {
    std::array<char, 64> text{};
    const int length = std::snprintf(text.data(), text.size(), number_format_.c_str(), value);
    return {text.data(), static_cast<std::size_t>(length)};
  }

  std::string point(const Eigen::Vector3d& p) const {
    return number(p.x()) + blank_ + number(p.y()) + blank_ + number(p.z());
  }

  void line(const std::string& text) { file_.content += indent_ + text + line_end_; }

  void finish(const char* extension, bool is_text) {
    file_.name = std::string("a") + extension;
    file_.is_text = is_text;
    if (is_text && maybe()) file_.content.erase(file_.content.find_last_not_of(" \r\n") + 1);
  }

  const TriangleMesh& mesh_;
  test_support::RandomNumbers random_;
  std::string number_format_;
  std::string line_end_;
  std::string blank_;
  std::string indent_;
  DialectFile file_{};
};

class ObjWriter : DialectWriter {
 public:
  using DialectWriter::DialectWriter;

  DialectFile write() {
    if (maybe(0.1)) line(warned({"8 12", "OBJ", "version 1.0", "F 1 2 3"}));
    corner_tail_ = one_of({"", "", "/1", "//1", "/1/1"});
    vertex_tail_ = one_of({"", "", " 1", " 0.5 0.5 0.5", " 1 nan nan 1"});
    counts_backwards_ = maybe();
    line("mtllib " + one_of({"a.mtl", "C:\\parts\\", "a b.mtl # c"}));
    for (const Eigen::Vector3d& p : mesh_.vertices)
      statement("v" + blank_ + point(p) + vertex_tail_);
    vertices_ = std::ssize(mesh_.vertices);
    if (maybe()) {
      line("v nan nan nan");
      ++vertices_;
    }
    if (!corner_tail_.empty()) line("vt 0 0" + line_end_ + "vn 0 0 1");
    for (const Triangle& triangle : mesh_.triangles)
      face(triangle);
    finish(".obj", true);
    return file_;
  }

 private:
  void statement(const std::string& text) {
    if (maybe(0.02)) line(one_of({"", "# v 1 2 3", "g a", "o b#c", "s off", "usemtl C:\\textures\\", "l 1 2", "p 1"}));
    if (maybe(0.005)) line(warned({"end", "weight 3", "0 0 0"}));
    line(text + (maybe(0.05) ? one_of({" # comment", "# 1", " #"}) : ""));
  }

  void face(const Triangle& triangle) {
    std::string text = "f";
    for (const std::int32_t i : triangle) {
      text += maybe(0.02) ? " \\" + line_end_ : blank_;
      text += std::to_string(counts_backwards_ ? i - vertices_ : i + 1) + corner_tail_;
    }
    statement(text);
    if (maybe(0.005)) line(warned({"f 1", "f 1 2", "f"}));
  }

  std::string corner_tail_;
  std::string vertex_tail_;
  bool counts_backwards_ = false;
  std::int64_t vertices_ = 0;
};

class StlWriter : DialectWriter {
 public:
  using DialectWriter::DialectWriter;

  DialectFile write() {
    if (maybe()) return write_binary();
    if (maybe(0.2)) line_end_ = " ";
    const std::string end_loop = one_of({"endloop", "endloop", "end loop", "ENDLOOP"});
    const std::string normal = one_of({"0 0 1", "nan nan nan", "-1.#IND 0 0"});
    line("solid" + one_of({"", " part", " a facet"}));
    if (line_end_ != " " && maybe(0.1)) line(warned({"solid", "color 1 0 0"}));
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      if (t > 0 && maybe(0.01)) line(one_of({"endsolid", "endsolid part", "endsolidpart"}) + line_end_ + "solid other");
      line("facet normal" + blank_ + normal);
      line("outer loop");
      for (const std::int32_t i : mesh_.triangles[t])
        line("vertex" + blank_ + point(mesh_.vertices[static_cast<std::size_t>(i)]));
      line(end_loop);
      line("endfacet");
    }
    if (maybe(0.9)) {
      line(one_of({"endsolid", "endsolid part", "endsolidPart"}));
    } else {
      file_.has_warning = true;
    }
    finish(".stl", true);
    return file_;
  }

 private:
  DialectFile write_binary() {
    std::string header = one_of({"solid part", "COLOR=", "facet", "binary"});
    header.resize(80, maybe() ? '\0' : ' ');
    file_.content = header + bytes_of<std::uint32_t>({static_cast<std::uint32_t>(mesh_.triangles.size())});
    const std::string attribute = one_of({"\x1f\x7c", "ab"});
    for (const Triangle& triangle : mesh_.triangles) {
      file_.content += bytes_of<float>({0, 0, NAN});
      for (const std::int32_t i : triangle) {
        for (const double coordinate : mesh_.vertices[static_cast<std::size_t>(i)])
          file_.content += bytes_of<float>({static_cast<float>(coordinate)});
      }
      file_.content += attribute;
    }
    if (maybe(0.2)) file_.content += warned({"\n", "tail of the file"});
    finish(".stl", false);
    return file_;
  }
};

class PlyWriter : DialectWriter {
 public:
  using DialectWriter::DialectWriter;

  DialectFile write() {
    is_text_ = maybe(0.5);
    is_big_endian_ = maybe(0.5);
    has_normals_ = maybe();
    has_edges_ = maybe();
    strips_ = maybe() ? mesh_.triangles.size() / static_cast<std::size_t>(random_.integer(1, 3)) : 0;
    small_faces_ = maybe(0.1) ? 2 : 0;
    if (small_faces_ > 0) file_.has_warning = true;
    blank_ = is_text_ ? blank_ : " ";
    indent_ = "";
    write_header();
    if (has_edges_) {
      integers({1, 2});
      end_of_element();
    }
    for (const Eigen::Vector3d& p : mesh_.vertices) {
      for (const double coordinate : p)
        real(number(coordinate), coordinate);
      if (has_normals_) real(nan_, std::nan(""));
      end_of_element();
    }
    for (std::int64_t corners = 0; corners < small_faces_; ++corners)
      face(std::vector<std::int32_t>(static_cast<std::size_t>(corners), 1));
    for (std::size_t t = strips_; t < mesh_.triangles.size(); ++t)
      face({mesh_.triangles[t].begin(), mesh_.triangles[t].end()});
    write_strips();
    finish(".ply", is_text_);
    return file_;
  }

 private:
  void write_header() {
    line("ply");
    line("format " +
         std::string(is_text_         ? "ascii"
                     : is_big_endian_ ? "binary_big_endian"
                                      : "binary_little_endian") +
         " 1.0");
    if (maybe()) line("comment made by " + one_of({"hand", "end_header", "C:\\"}));
    if (has_edges_) line("element edge 1" + line_end_ + "property int a" + line_end_ + "property int b");
    line("element vertex " + std::to_string(mesh_.vertices.size()));
    for (const char* axis : {"x", "y", "z"})
      line("property " + std::string(is_text_ ? "float " : "double ") + axis);
    if (has_normals_) line("property " + std::string(is_text_ ? "float" : "double") + " nx");
    if (maybe()) line("obj_info a b");
    line("element face " + std::to_string(mesh_.triangles.size() - strips_ + static_cast<std::size_t>(small_faces_)));
    line("property list uchar int " + one_of({"vertex_indices", "vertex_index"}));
    if (strips_ > 0) line("element tristrips 1" + line_end_ + "property list int int vertex_indices");
    line("end_header");
  }

  /// Each triangle as a strip of its own.
  void write_strips() {
    if (strips_ == 0) return;
    std::vector<std::int32_t> corners;
    for (std::size_t t = 0; t < strips_; ++t) {
      const auto& [a, b, c] = mesh_.triangles[t];
      corners.insert(corners.end(), {a, b, c});
      if (t + 1 < strips_ || maybe()) corners.push_back(-1);
    }
    integers({static_cast<std::int32_t>(corners.size())});
    integers(corners);
    end_of_element();
  }

  void real(const std::string& text, double value) {
    file_.content += is_text_ ? text + blank_ : bytes_of<double>({value}, is_big_endian_);
  }

  void integers(const std::vector<std::int32_t>& values) {
    for (const std::int32_t value : values)
      file_.content += is_text_ ? std::to_string(value) + blank_ : bytes_of<std::int32_t>({value}, is_big_endian_);
  }

  void face(const std::vector<std::int32_t>& corners) {
    const auto count = static_cast<char>(corners.size());
    file_.content += is_text_ ? std::to_string(count) + blank_ : std::string(1, count);
    integers(corners);
    end_of_element();
  }

  void end_of_element() {
    if (is_text_) file_.content += line_end_;
  }

  bool is_text_ = false;
  bool is_big_endian_ = false;
  bool has_normals_ = false;
  bool has_edges_ = false;
  std::size_t strips_ = 0;
  std::int64_t small_faces_ = 0;
  std::string nan_ = one_of({"nan", "-1.#IND", "1.#QNAN0"});
};

}  // namespace

DialectFile dialect_file(const TriangleMesh& mesh, std::uint64_t number) {
  if (number % 3 == 0) return ObjWriter(mesh, number).write();
  if (number % 3 == 1) return StlWriter(mesh, number).write();
  return PlyWriter(mesh, number).write();
}

}  // namespace glissade::geometry
