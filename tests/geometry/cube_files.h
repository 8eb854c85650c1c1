#pragma once

/// The unit cube in text formats, and the fixture of the tests of their dialects: a file is that cube, with certain
/// warnings.

#include <array>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glissade/geometry/mesh_import.h>
#include <glissade/geometry/mesh_topology.h>

#include "mesh_import_fixture.h"

namespace glissade::geometry {

/// Corner i is at (i & 1, i >> 1 & 1, i >> 2).
inline constexpr std::array<std::array<int, 3>, 12> kCubeFaces{{{0, 2, 3},
                                                                {0, 3, 1},
                                                                {4, 5, 7},
                                                                {4, 7, 6},
                                                                {0, 1, 5},
                                                                {0, 5, 4},
                                                                {2, 6, 7},
                                                                {2, 7, 3},
                                                                {0, 4, 6},
                                                                {0, 6, 2},
                                                                {1, 3, 7},
                                                                {1, 7, 5}}};

inline std::string cube_corner(int i) {
  return std::to_string(i & 1) + " " + std::to_string(i >> 1 & 1) + " " + std::to_string(i >> 2);
}

/// Lines 1 to 8 are the corners, lines 9 to 20 the faces.
inline std::string cube_obj() {
  std::string file;
  for (int i = 0; i < 8; ++i)
    file += "v " + cube_corner(i) + "\n";
  for (const auto& [a, b, c] : kCubeFaces)
    file += "f " + std::to_string(a + 1) + " " + std::to_string(b + 1) + " " + std::to_string(c + 1) + "\n";
  return file;
}

/// Seven lines for each facet, from line 2 on; the last line is 86.
inline std::string cube_stl() {
  std::string file = "solid cube\n";
  for (const auto& [a, b, c] : kCubeFaces) {
    file += "facet normal 0 0 1\nouter loop\nvertex " + cube_corner(a) + "\nvertex " + cube_corner(b) + "\nvertex " +
            cube_corner(c) + "\nendloop\nendfacet\n";
  }
  return file + "endsolid cube\n";
}

/// The header has nine lines, the corners are lines 10 to 17, and the faces lines 18 to 29.
inline std::string cube_ply_header() {
  return "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n"
         "element face 12\nproperty list uchar int vertex_indices\nend_header\n";
}

inline std::string cube_ply_corners() {
  std::string lines;
  for (int i = 0; i < 8; ++i)
    lines += cube_corner(i) + "\n";
  return lines;
}

inline std::string cube_ply_faces() {
  std::string lines;
  for (const auto& [a, b, c] : kCubeFaces)
    lines += "3 " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(c) + "\n";
  return lines;
}

inline std::string cube_ply() {
  return cube_ply_header() + cube_ply_corners() + cube_ply_faces();
}

/// `text` with every `from` replaced by `to`.
inline std::string with_all(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

class Dialect : public MeshImport {
 protected:
  ImportedMesh import(const std::string& name, const std::string& content) const {
    return import_mesh(folder_.write(name, content));
  }

  void expect_cube(const std::string& name, const std::string& content,
                   const std::vector<std::string>& warnings = {}) const {
    SCOPED_TRACE(content.substr(0, 2000));
    ASSERT_NO_THROW(import(name, content));
    const ImportedMesh imported = import(name, content);
    const MeshReport r = report(imported.mesh);
    EXPECT_EQ(r.vertices, 8);
    EXPECT_EQ(r.triangles, 12);
    EXPECT_TRUE(r.is_watertight);
    EXPECT_EQ(r.inconsistent_edges, 0);
    EXPECT_EQ(r.area, 6.0);
    EXPECT_EQ(r.bounds.min(), Eigen::Vector3d::Zero());
    EXPECT_EQ(imported.degenerate_triangles, 0);
    EXPECT_EQ(imported.warnings, warnings);
  }
};

}  // namespace glissade::geometry
