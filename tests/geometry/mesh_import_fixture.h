#pragma once

/// A tetrahedron in every format, and the fixture of the tests of mesh import: a temporary folder for files, and the
/// message of a failing import.

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glissade/geometry/mesh_import.h>

#include "mesh_files.h"

namespace glissade::geometry {

using Files = std::vector<std::pair<std::string, std::string>>;

/// The tetrahedron in all formats and dialects: name and content.
inline Files tetrahedra() {
  return {{"lf.obj", kObj},
          {"crlf.obj", with_crlf(kObj)},
          {"upper_case_extension.OBJ", kObj},
          {"no_last_newline.obj", kObj.substr(0, kObj.size() - 1)},
          {"continued.obj", with(kObj, "f 1 3 2", "f 1 \\\n3 \\\n 2")},
          {"relative.obj", with(kObj, "f 1 3 2", "f -4 -2 -3")},
          {"attributes.obj", with(with(kObj, "f 1 3 2", "vt 0 0\nvn 0 0 1\ng group\nusemtl steel\nf 1/1/1 3//1 2/1"),
                                  "v 0 0 0", "mtllib no_such.mtl\no name\nv 0 0 0 0.5 0.5 0.5\nl 1 2")},
          {"looks.obj", "s off\nmg 1 0.1\nlod 3\nbevel on\ncstype bezier\ndeg 3\nvp 0 0\np 1\n" + kObj},
          {"comment_that_ends_in_a_backslash.obj", "# C:\\parts\\\n" + kObj},
          {"byte_order_mark.obj", kByteOrderMark + kObj},
          {"byte_order_mark.ply", kByteOrderMark + kAsciiPly},
          {"byte_order_mark.stl", kByteOrderMark + kAsciiStl},
          {"ascii.ply", kAsciiPly},
          {"crlf.ply", with_crlf(kAsciiPly)},
          {"little.ply", binary_ply(false)},
          {"big.ply", binary_ply(true)},
          {"binary_crlf.ply", with_crlf(binary_ply(false).substr(0, binary_ply(false).find("end_header\n") + 11)) +
                                  binary_ply(false).substr(binary_ply(false).find("end_header\n") + 11)},
          {"ascii.stl", kAsciiStl},
          {"crlf.stl", with_crlf(kAsciiStl)},
          {"binary.stl", binary_stl("made by a test")},
          {"solid.stl", binary_stl("solid but binary")},
          {"embedded.gltf", gltf(R"({"byteLength":4,"uri":"data:application/octet-stream;base64,AAAAAA=="},)"
                                 R"({"byteLength":72,"uri":"tetrahedron%20data.bin"})")},
          {"byte_order_mark.gltf", kByteOrderMark + gltf(R"({"byteLength":72,"uri":"tetrahedron%20data.bin"})")},
          {"binary.glb", tetrahedron_glb()}};
}

class MeshImport : public testing::Test {
 protected:
  MeshImport() { folder_.write("tetrahedron data.bin", gltf_binary()); }

  /// The message the import of this file fails with.
  std::string error_of(const std::string& name, const std::string& content) const {
    return error_of(folder_.write(name, content));
  }
  static std::string error_of(const std::filesystem::path& path, double scale = 1) {
    try {
      import_mesh(path, scale);
    } catch (const std::invalid_argument& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr(path.string()));
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << "one line only";
      EXPECT_THAT(error.what(), testing::Not(testing::StartsWith(path.string() + ": The")))
          << "what follows a file's name begins with a small letter";
      return error.what();
    }
    ADD_FAILURE() << path << " was imported";
    return {};
  }

  TemporaryFolder folder_;
};

}  // namespace glissade::geometry
